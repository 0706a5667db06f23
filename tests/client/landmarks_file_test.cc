#include "client/landmarks_file.h"

#include <gtest/gtest.h>

#include "core/base/status.h"

namespace capfit::client {
namespace {

TEST(LandmarksFile, NamesAndPositionsAreTaken) {
  const auto landmarks = ParseLandmarks(R"({"left_wrist": [0.5, 1, -2e-3], "crotch": [0, 0, 0]})");
  ASSERT_TRUE(landmarks.ok()) << landmarks.status();
  EXPECT_EQ(landmarks->size(), 2U);
  EXPECT_EQ(landmarks->at(body::LandmarkId::kLeftWrist), Eigen::Vector3d(0.5, 1, -2e-3));
}

TEST(LandmarksFile, AWholeResultDoesAsWell) {
  const auto landmarks = ParseLandmarks(
      R"({"spheres": [], "landmarks": {"neck": {"position": [1, 2, 3], "method": "ratio"}}})");
  ASSERT_TRUE(landmarks.ok()) << landmarks.status();
  EXPECT_EQ(landmarks->at(body::LandmarkId::kNeck), Eigen::Vector3d(1, 2, 3));
}

TEST(LandmarksFile, MistakesAreNamed) {
  const std::pair<const char*, const char*> cases[] = {
      {"[1, 2]", "landmarks"},
      {"{", "landmarks"},
      {R"({"tail": [1, 2, 3]})", "landmarks.tail"},
      {R"({"neck": [1, 2]})", "landmarks.neck"},
      {R"({"neck": [1, 2, "3"]})", "landmarks.neck"},
      {R"({"neck": {"position": [1, 2]}})", "landmarks.neck"},
      {R"({"neck": {"x": 1}})", "landmarks.neck"},
      {R"({"neck": [1, 2, null]})", "landmarks.neck"},
  };
  for (const auto& [text, field] : cases) {
    EXPECT_EQ(FieldOf(ParseLandmarks(text).status()).value_or("none"), field) << text;
  }
}

}  // namespace
}  // namespace capfit::client
