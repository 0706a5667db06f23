// Real avatars against their ground truth: where the file shows them, not how they were bound.
#include "tests/support/avatars.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "core/formats/read_mesh.h"
#include "tests/support/bodies.h"

namespace capfit::formats {
namespace {

using nlohmann::json;

json Truth() {
  return json::parse(test_support::ReadFile(test_support::AvatarsFolder() / "truth.json"));
}

PolygonSoup ReadAvatar(const json& truth) {
  const std::string bytes =
      test_support::ReadFile(test_support::AvatarsFolder() / truth.at("file").get<std::string>());
  auto soup = ReadMesh(std::as_bytes(std::span(bytes)));
  EXPECT_TRUE(soup.ok()) << soup.status();
  return soup.ok() ? *std::move(soup) : PolygonSoup();
}

Eigen::Vector3d PointOf(const json& numbers) {
  return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

// Truth is rounded to 0.01 mm, dressed_deleted_centimetres to 0.2 mm.
constexpr double kRounding = 0.2e-3;

TEST(AvatarsTest, StandsWhereTheTruthSays) {
  CAPFIT_REQUIRE_AVATARS();
  const json truths = Truth();
  for (const auto& [name, truth] : truths.items()) {
    const PolygonSoup soup = ReadAvatar(truth);
    ASSERT_FALSE(soup.positions.empty()) << name;
    const double metres = truth.at("metres_per_file_unit").get<double>();
    Eigen::Vector3d low = soup.positions[0];
    Eigen::Vector3d high = low;
    for (const Eigen::Vector3d& p : soup.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    EXPECT_LE((metres * low - PointOf(truth.at("box_m").at("min"))).norm(), kRounding) << name;
    EXPECT_LE((metres * high - PointOf(truth.at("box_m").at("max"))).norm(), kRounding) << name;
  }
}

TEST(AvatarsTest, HasItsJointsWhereTheNodesStand) {
  CAPFIT_REQUIRE_AVATARS();
  const json truths = Truth();
  for (const auto& [name, truth] : truths.items()) {
    const PolygonSoup soup = ReadAvatar(truth);
    if (!truth.at("rig").is_object() || !truth.at("rig").contains("joint_nodes")) continue;
    EXPECT_EQ(soup.joints.size(), truth.at("rig").at("joints").get<std::size_t>()) << name;
    std::map<std::string, Eigen::Vector3d> at;
    for (const NamedJoint& joint : soup.joints) at.emplace(joint.name, joint.position);
    const double metres = truth.at("metres_per_file_unit").get<double>();
    for (const auto& [joint, node] : truth.at("rig").at("joint_nodes").items()) {
      ASSERT_TRUE(at.contains(node.get<std::string>())) << name << " " << joint;
      const Eigen::Vector3d want = PointOf(truth.at("joints").at(joint));
      EXPECT_LE((metres * at[node.get<std::string>()] - want).norm(), 2e-5) << name << " " << joint;
    }
  }
}

TEST(AvatarsTest, HasItsPartsEachWithItsFacesAndItsJoint) {
  CAPFIT_REQUIRE_AVATARS();
  const json truths = Truth();
  for (const auto& [name, truth] : truths.items()) {
    const PolygonSoup soup = ReadAvatar(truth);
    std::size_t next_face = 0;
    for (const SoupPart& part : soup.parts) {
      EXPECT_EQ(part.first_face, next_face) << name;
      next_face += part.face_count;
    }
    EXPECT_EQ(next_face, soup.face_count()) << name;
    if (soup.parts.size() == 1) continue;  // of the scan, the truth lists ranges of faces
    ASSERT_EQ(soup.parts.size(), truth.at("parts").size()) << name;
    for (const json& part : truth.at("parts")) {
      const auto found = std::find_if(soup.parts.begin(), soup.parts.end(), [&](const SoupPart& p) {
        return p.name == part.at("node").get<std::string>();
      });
      ASSERT_NE(found, soup.parts.end()) << name << " " << part.at("node");
      EXPECT_EQ(found->face_count, part.at("faces").get<std::size_t>()) << name;
      const bool is_rigid = part.contains("skinned") && part.at("skinned") == false;
      EXPECT_EQ(found->joint >= 0, is_rigid) << name << " " << part.at("node");
    }
  }
}

}  // namespace
}  // namespace capfit::formats
