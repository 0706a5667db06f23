#include "core/export/vrm_colliders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/status.h"
#include "tests/core/export/rigged_sample.h"

namespace capfit::exports {
namespace {

using nlohmann::json;
using Vec3 = Eigen::Vector3d;

// Two chains of two: one through where the lone sphere of SetOn stands, one far away.
json WithChains() {
  json gltf = RiggedGltf();
  gltf["nodes"][0]["scale"] = {1, 1, 1};
  gltf["nodes"][0]["children"] = {1, 2, 3, 4, 6, 8};
  for (const double x : {0.0, 50.0}) {
    const std::size_t first = gltf["nodes"].size();
    gltf["nodes"].push_back({{"translation", {x + 1.0, 1.2, 1.5}}, {"children", {first + 1}}});
    gltf["nodes"].push_back({{"translation", {0, 0, -0.5}}});
  }
  return gltf;
}

json SecondVrm() {
  json gltf = WithChains();
  gltf["extensions"]["VRMC_vrm"] = {{"specVersion", "1.0"}};
  gltf["extensions"]["VRMC_springBone"] = {
      {"specVersion", "1.0"},
      {"colliders", {{{"node", 0}, {"shape", {{"sphere", {{"radius", 0.1}}}}}}}},
      {"colliderGroups", {{{"name", "own"}, {"colliders", {0}}}}},
      {"springs",
       {{{"joints", {{{"node", 6}, {"hitRadius", 0.02}}, {{"node", 7}}}}},
        {{"joints", {{{"node", 8}}, {{"node", 9}}}}, {"colliderGroups", {0}}},
        "no spring"}}};
  return gltf;
}

json FirstVrm() {
  json gltf = WithChains();
  gltf["extensions"]["VRM"]["secondaryAnimation"] = {
      {"colliderGroups", {{{"node", 0}, {"colliders", json::array()}}}},
      {"boneGroups",
       {{{"bones", {6}}, {"hitRadius", 0.02}}, {{"bones", {8}}, {"colliderGroups", {0}}}}}};
  return gltf;
}

json Written(const json& vrm, const std::vector<std::int32_t>& nodes, VrmOptions options = {}) {
  const std::string original = GlbOf(vrm);
  const auto exported = WriteVrm(SetOn(original, nodes), BytesOf(original), options);
  EXPECT_TRUE(exported.ok()) << exported.status();
  return exported.ok() ? JsonOf(exported->files[0].bytes) : json();
}

TEST(VrmColliders, ComeInAGroupBehindTheAuthors) {
  const json extension = Written(SecondVrm(), {1})["extensions"]["VRMC_springBone"];
  EXPECT_EQ(extension["colliders"][0],
            SecondVrm()["extensions"]["VRMC_springBone"]["colliders"][0]);
  EXPECT_EQ(extension["colliderGroups"][0]["name"], "own");
  const json& group = extension["colliderGroups"][1];
  EXPECT_EQ(group["name"], "capfit");
  // 0.1 and 0.15 at steps of 5 mm: ten pieces, and the lone sphere.
  EXPECT_EQ(group["colliders"].size(), 11);
  EXPECT_EQ(group["colliders"][0], 1);
  EXPECT_EQ(extension["colliders"].size(), 12);
}

TEST(VrmColliders, SpringsAreJoinedToThoseTheyDoNotLieIn) {
  const json extension = Written(SecondVrm(), {1})["extensions"]["VRMC_springBone"];
  const json& groups = extension["colliderGroups"];
  EXPECT_EQ(extension["springs"][1]["colliderGroups"], json({0, 1}));  // all of them
  ASSERT_EQ(extension["springs"][0]["colliderGroups"], json({2}));
  EXPECT_EQ(groups[2]["name"], "capfit_1");
  EXPECT_EQ(groups[2]["colliders"].size(), 10);  // all but the lone sphere
  EXPECT_EQ(extension["springs"][2], "no spring");
}

TEST(VrmColliders, SpringsAreLeftAloneWhenAskedTo) {
  const json extension =
      Written(SecondVrm(), {1}, {.joins_springs = false})["extensions"]["VRMC_springBone"];
  EXPECT_EQ(extension["springs"], SecondVrm()["extensions"]["VRMC_springBone"]["springs"]);
}

TEST(VrmColliders, AFirstVrmHasSpheresWithZTurnedAbout) {
  const json gltf = Written(FirstVrm(), {1});
  const json& animation = gltf["extensions"]["VRM"]["secondaryAnimation"];
  ASSERT_EQ(animation["colliderGroups"].size(), 3);
  const json& lone = animation["colliderGroups"][2];
  EXPECT_EQ(lone["node"], 1);
  const json& offset = lone["colliders"][0]["offset"];
  const Vec3 at = NodeNamed(GlbOf(FirstVrm()), "plain") *
                  Vec3(offset["x"], offset["y"], -offset["z"].get<double>());
  EXPECT_TRUE(at.isApprox(Vec3(1, 1.2, 1), 1e-12)) << at.transpose();
  EXPECT_EQ(animation["boneGroups"][0]["colliderGroups"], json({1}));
  EXPECT_EQ(animation["boneGroups"][1]["colliderGroups"], json({0, 1, 2}));
}

TEST(VrmColliders, AScaledJointGetsANodeThatUndoesIt) {
  for (const std::int32_t node : {2, 3}) {
    const json gltf = Written(SecondVrm(), {node});
    const json& collider = gltf["extensions"]["VRMC_springBone"]["colliders"].back();
    const std::size_t own = collider["node"];
    EXPECT_EQ(gltf["nodes"][own]["name"], "capfit_joint_0");
    const Eigen::Affine3d to_scene = NodeNamed(GlbOf(gltf), "capfit_joint_0");
    EXPECT_TRUE((to_scene.linear().transpose() * to_scene.linear()).isIdentity(1e-12));
    const json& offset = collider["shape"]["sphere"]["offset"];
    EXPECT_TRUE(
        (to_scene * Vec3(offset[0], offset[1], offset[2])).isApprox(Vec3(1, 1.2, 1), 1e-12));
  }
}

TEST(VrmColliders, RefuseWhatIsNoVrmAndOptionsOutOfRange) {
  const std::string original = GlbOf(RiggedGltf());
  const ColliderSet set = SetOn(original, {1});
  EXPECT_EQ(ReasonOf(WriteVrm(set, BytesOf(original)).status()), ErrorReason::kUnsupportedFile);
  EXPECT_EQ(FieldOf(WriteVrm(set, BytesOf(original), {.max_overshoot_m = 0.0}).status()),
            "max_overshoot_m");
}

TEST(VrmColliders, RefuseMoreSpringsThanAnyAvatarHas) {
  json vrm = FirstVrm();
  json& groups = vrm["extensions"]["VRM"]["secondaryAnimation"]["boneGroups"];
  groups = json(1024, json{{"bones", {8}}});
  const ColliderSet set = SetOn(GlbOf(vrm), {1});
  EXPECT_TRUE(WriteVrm(set, BytesOf(GlbOf(vrm))).ok());
  groups.push_back(json::object());
  EXPECT_EQ(ReasonOf(WriteVrm(set, BytesOf(GlbOf(vrm))).status()), ErrorReason::kTooLarge);
  groups = json(1000, json{{"bones", {0}}});  // the whole tree, a thousand times
  EXPECT_EQ(ReasonOf(WriteVrm(set, BytesOf(GlbOf(vrm))).status()), ErrorReason::kTooLarge);
}

TEST(VrmColliders, TakeASpringBoneOfTheWrongKindAsNone) {
  json vrm = SecondVrm();
  vrm["extensions"]["VRMC_springBone"] = 3;
  EXPECT_EQ(Written(vrm, {1})["extensions"]["VRMC_springBone"]["colliderGroups"].size(), 1);
  vrm["extensions"]["VRMC_springBone"] = {{"colliders", "x"}, {"springs", {{"joints", 5}}}};
  EXPECT_EQ(Written(vrm, {1})["extensions"]["VRMC_springBone"]["colliders"].size(), 11);
}

}  // namespace
}  // namespace capfit::exports
