#include "client/carried_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <sstream>

namespace capfit::client {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

std::string Bytes(const std::vector<float>& numbers) {
  std::string bytes(4 * numbers.size(), '\0');
  if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

CarriedSet OfVertices() {
  CarriedSet set;
  set.weights = skinning::SparseWeights{2, {2}, {0, 1}, {0.5F, 0.5F}};
  set.radii = {0.4};
  set.vertices = {{0, 0, 0}, {2, 0, 0}};
  return set;
}

CarriedSet OfBones() {
  CarriedSet set;
  set.weights = skinning::BoneWeights{1, {1}, {0}, {1.0F}, {Vector3d(0, 1, 0)}};
  set.radii = {0.4};
  set.joints.resize(1);
  return set;
}

absl::StatusOr<CarriedFrames> Carry(const CarriedSet& set, const std::vector<float>& numbers) {
  std::istringstream in(Bytes(numbers));
  return CarryAlong(set, in, ThreadPool(1));
}

TEST(CarryAlongTest, MovesCentresWithTheVerticesAndKeepsRadii) {
  const auto frames = Carry(OfVertices(), {0, 0, 0, 2, 0, 0, 1, 1, 1, 3, 3, 1});
  ASSERT_TRUE(frames.ok()) << frames.status();
  ASSERT_EQ(frames->centers.size(), 2u);
  EXPECT_EQ(frames->centers[0][0], Vector3d(1, 0, 0));
  EXPECT_EQ(frames->centers[1][0], Vector3d(2, 2, 1));
  EXPECT_EQ(frames->radii[1][0], 0.4);
}

TEST(CarryAlongTest, StretchesRadiiWhereAsked) {
  CarriedSet set = OfVertices();
  set.stretches_radii = true;
  const auto frames = Carry(set, {0, 0, 0, 2.2F, 0, 0, 0, 0, 0, 9, 0, 0});
  ASSERT_TRUE(frames.ok()) << frames.status();
  EXPECT_NEAR(frames->radii[0][0], 0.44, 1e-6);
  EXPECT_NEAR(frames->radii[1][0], 0.5, 1e-12);  // the limit
}

TEST(CarryAlongTest, MovesCentresWithTheJoints) {
  // A quarter turn about x, then a move.
  const auto frames = Carry(OfBones(), {1, 0, 0, 5, 0, 0, -1, 6, 0, 1, 0, 7});
  ASSERT_TRUE(frames.ok()) << frames.status();
  EXPECT_EQ(frames->centers[0][0], Vector3d(5, 6, 8));
}

TEST(CarryAlongTest, NamesTheFrameThatIsWrong) {
  const auto error = [](const CarriedSet& set, const std::vector<float>& numbers) {
    return Carry(set, numbers).status().ToString();
  };
  EXPECT_THAT(error(OfVertices(), {}), HasSubstr("frames is empty"));
  EXPECT_THAT(error(OfVertices(), {0, 0, 0, 0, 0, 0, 1}),
              HasSubstr("frames[1] has 4 bytes, must have 24"));
  EXPECT_THAT(error(OfVertices(), {0, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0}),
              HasSubstr("frames[0][1] must be finite"));
  EXPECT_THAT(error(OfBones(), {1, 2}), HasSubstr("must have 48"));
}

}  // namespace
}  // namespace capfit::client
