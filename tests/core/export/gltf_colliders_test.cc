#include "core/export/gltf_colliders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>

#include "core/base/random.h"
#include "core/base/status.h"
#include "tests/core/export/rigged_sample.h"

namespace capfit::exports {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using Vec3 = Eigen::Vector3d;

Exported Write(const ColliderSet& set, const std::string& original, GltfOptions options = {}) {
  const auto exported = WriteGltf(set, BytesOf(original), options);
  EXPECT_TRUE(exported.ok()) << exported.status();
  return exported.ok() ? *exported : Exported{{{"", ""}}, {}};
}

const std::string& FileOf(const Exported& exported) { return exported.files[0].bytes; }

std::vector<std::string> CodesOf(const Exported& exported) {
  std::vector<std::string> codes;
  for (const Warning& warning : exported.warnings) codes.push_back(warning.code);
  return codes;
}

// The node that the collider of that name is.
json NodeJson(const json& gltf, const std::string& name) {
  for (const json& node : gltf["nodes"]) {
    if (node.value("name", "") == name) return node;
  }
  ADD_FAILURE() << "no node " << name;
  return {};
}

json ShapeOfNode(const json& gltf, const std::string& name) {
  const std::size_t shape = NodeJson(
      gltf, name)["extensions"]["KHR_physics_rigid_bodies"]["collider"]["geometry"]["shape"];
  return gltf["extensions"]["KHR_implicit_shapes"]["shapes"][shape];
}

TEST(GltfColliders, StandWhereTheResultIsOnJointsOfEveryKind) {
  const std::string original = GlbOf(RiggedGltf());
  const ColliderSet set = SetOn(original, {0, 1, 2, 3, 5});
  const std::string glb = FileOf(Write(set, original));
  const json gltf = JsonOf(glb);
  for (std::size_t k = 0; k < set.capsule_count(); ++k) {
    const std::string name = CapsuleNames(set)[k];
    const geometry::TaperedCapsule capsule = set.primitives.Capsule(k);
    const Eigen::Affine3d to_scene = NodeNamed(glb, name);
    const json shape = ShapeOfNode(gltf, name)["capsule"];
    const double half = 0.5 * shape["height"].get<double>();
    EXPECT_TRUE((to_scene * Vec3(0, -half, 0)).isApprox(capsule.a().center_m, 1e-12)) << name;
    EXPECT_TRUE((to_scene * Vec3(0, half, 0)).isApprox(capsule.b().center_m, 1e-12)) << name;
    EXPECT_EQ(shape["radiusBottom"], capsule.a().radius_m);
    EXPECT_EQ(shape["radiusTop"], capsule.b().radius_m);
    // Neither scaled nor mirrored, whatever is above.
    const Eigen::Matrix3d linear = to_scene.linear();
    EXPECT_TRUE((linear.transpose() * linear).isIdentity(1e-12)) << name << "\n" << linear;
    EXPECT_GT(linear.determinant(), 0.0) << name;
  }
  for (const std::size_t i : LoneSpheres(set)) {
    const std::string& name = set.sphere_names[i];
    EXPECT_TRUE(
        NodeNamed(glb, name).translation().isApprox(set.primitives.spheres[i].center_m, 1e-12));
    EXPECT_EQ(ShapeOfNode(gltf, name)["sphere"]["radius"], set.primitives.spheres[i].radius_m);
  }
}

TEST(GltfColliders, HangOnTheirJoints) {
  const std::string original = GlbOf(RiggedGltf());
  const json gltf = JsonOf(FileOf(Write(SetOn(original, {1}), original)));
  for (const std::size_t child : gltf["nodes"][1]["children"]) {
    EXPECT_THAT(gltf["nodes"][child]["name"], testing::AnyOf("a0__b0", "lone0"));
  }
  EXPECT_EQ(gltf["nodes"][1]["children"].size(), 2);
}

TEST(GltfColliders, AJointThatFlattensHandsThemToTheOneAbove) {
  const std::string original = GlbOf(RiggedGltf());
  const Exported exported = Write(SetOn(original, {4}), original);
  EXPECT_THAT(CodesOf(exported), testing::ElementsAre("JOINT_FLATTENS"));
  EXPECT_EQ(JsonOf(FileOf(exported))["nodes"][0]["children"].size(), 4 + 2);
}

TEST(GltfColliders, KeepAllThatTheFileHolds) {
  const std::string original = GlbOf(RiggedGltf());
  for (const bool has_preview : {false, true}) {
    const std::string glb = FileOf(Write(SetOn(original, {1, 2}), original, {has_preview}));
    json gltf = JsonOf(glb);
    const json before = JsonOf(original);
    for (const char* key : {"asset", "images", "animations", "scene"}) {
      EXPECT_EQ(gltf[key], before[key]) << key;
    }
    EXPECT_EQ(gltf["extras"]["own"], before["extras"]["own"]);
    EXPECT_EQ(gltf["extensions"]["CALLER_words"], before["extensions"]["CALLER_words"]);
    EXPECT_EQ(gltf["extensionsUsed"][0], "CALLER_words");
    EXPECT_EQ(gltf["nodes"][0], before["nodes"][0]);
    const auto chunks = formats::SplitGltf(BytesOf(glb));
    EXPECT_EQ(chunks->binary.size() > 8, has_preview);
    EXPECT_EQ(std::memcmp(chunks->binary.data(), "12345678", 8), 0);
    EXPECT_EQ(gltf.contains("meshes"), has_preview);
  }
}

TEST(GltfColliders, SayInWordsWhatTheyAre) {
  const std::string original = GlbOf(RiggedGltf());
  const json gltf = JsonOf(FileOf(Write(SetOn(original, {1}), original)));
  const json& own = gltf["extras"]["capfit"];
  EXPECT_EQ(own["spheres"][2]["name"], "lone0");
  EXPECT_EQ(own["spheres"][1]["radius"], 0.15);
  EXPECT_EQ(own["capsules"], json::parse("[[0, 1]]"));
  EXPECT_EQ(NodeJson(gltf, "a0__b0")["extras"]["capfit"],
            json::parse(R"({"capsule": 0, "spheres": [0, 1]})"));
  EXPECT_EQ(NodeJson(gltf, "lone0")["extras"]["capfit"], json::parse(R"({"spheres": [2]})"));
}

TEST(GltfColliders, AContainedEndMakesASphere) {
  const std::string original = GlbOf(RiggedGltf());
  ColliderSet set = SetOn(original, {1});
  set.primitives.spheres[1].radius_m = 2.0;
  const json shape = ShapeOfNode(JsonOf(FileOf(Write(set, original))), "a0__b0");
  EXPECT_EQ(shape["type"], "sphere");
  EXPECT_EQ(shape["sphere"]["radius"], 2.0);
}

TEST(GltfColliders, ComeAfterShapesThatAreThere) {
  json gltf = RiggedGltf();
  gltf["extensionsUsed"].push_back("KHR_implicit_shapes");
  gltf["extensions"]["KHR_implicit_shapes"]["shapes"] = {{{"type", "box"}}};
  const std::string original = GlbOf(gltf);
  const json now = JsonOf(FileOf(Write(SetOn(original, {1}), original)));
  EXPECT_EQ(now["extensions"]["KHR_implicit_shapes"]["shapes"][0]["type"], "box");
  EXPECT_EQ(ShapeOfNode(now, "lone0")["type"], "sphere");
  EXPECT_EQ(now["extensionsUsed"],
            json::parse(R"(["CALLER_words", "KHR_implicit_shapes", "KHR_physics_rigid_bodies"])"));
}

TEST(GltfColliders, AMeshOfAnotherFormatGivesAFileInMetresStoodUp) {
  ColliderSet set = SetOn(GlbOf(RiggedGltf()), {1});
  set.joints.clear();
  set.sphere_joints.clear();
  set.capsule_joints.clear();
  set.body_from_mesh.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // Z up, in centimetres
  set.body_from_mesh.scale = 0.01;
  set.source = "body";
  const Exported exported = Write(set, "v 0 0 0\n");
  EXPECT_EQ(exported.files[0].name, "body_colliders.glb");
  EXPECT_TRUE(exported.warnings.empty());
  const Vec3 in_mesh = set.primitives.spheres[2].center_m;
  EXPECT_TRUE(NodeNamed(FileOf(exported), "lone0")
                  .translation()
                  .isApprox(0.01 * Vec3(in_mesh.x(), in_mesh.z(), -in_mesh.y()), 1e-12));
}

TEST(GltfColliders, TellAUnitThatIsNotMetresAndASecondExport) {
  const std::string original = GlbOf(RiggedGltf());
  ColliderSet set = SetOn(original, {1});
  set.body_from_mesh.scale = 0.01;
  const Exported first = Write(set, original);
  EXPECT_THAT(CodesOf(first), testing::ElementsAre("UNIT_NOT_METRES"));
  set.body_from_mesh.scale = 1.0;
  EXPECT_THAT(CodesOf(Write(set, FileOf(first))), testing::ElementsAre("COLLIDERS_REPEATED"));
}

TEST(GltfColliders, RefuseJointsOfAnotherFileAndUnsoundSets) {
  const std::string original = GlbOf(RiggedGltf());
  ColliderSet set = SetOn(original, {1});
  set.joints[0].node = 6;
  EXPECT_EQ(FieldOf(WriteGltf(set, BytesOf(original)).status()).value_or(""), "joints[0].node");
  set.joints[0].node = 1;
  set.primitives.spheres[0].radius_m = -1.0;
  EXPECT_EQ(WriteGltf(set, BytesOf(original)).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(GltfColliders, RefuseDescriptionsTheyCannotAddTo) {
  const ColliderSet set = SetOn(GlbOf(RiggedGltf()), {1});
  const auto told = [&](const json& change) {
    json gltf = RiggedGltf();
    gltf.merge_patch(change);
    return WriteGltf(set, BytesOf(GlbOf(gltf))).status();
  };
  for (const char* change : {R"({"extensionsUsed": {}})", R"({"extensions": []})",
                             R"({"scenes": 3})", R"({"nodes": [{}, {}, 7]})",
                             R"({"nodes": [{}, {"children": 1}]})", R"({"buffers": [0]})"}) {
    EXPECT_THAT(told(json::parse(change)).ToString(), HasSubstr("mesh.file")) << change;
  }
  const std::string levels = std::string(300, '[') + std::string(300, ']');
  json nested = json::parse(R"({"asset": {"version": "2.0"}, "nodes": [{}, {}]})");
  nested["extras"] = json::parse(levels);
  EXPECT_THAT(WriteGltf(set, BytesOf(GlbOf(nested))).status().ToString(), HasSubstr("levels"));
}

// Whatever is wrong in the text: an error or a file, never a crash.
TEST(GltfColliders, SurviveDamagedFiles) {
  const std::string original = GlbOf(RiggedGltf());
  const ColliderSet set = SetOn(original, {1, 2, 3});
  Random random(7);
  int refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string damaged = original;
    for (int k = 0; k < 3; ++k) {
      const auto at = 20 + random.NextBelow(damaged.size() - 20);
      damaged[at] = static_cast<char>(random.NextBelow(128));
    }
    refused += WriteGltf(set, BytesOf(damaged), {true}).ok() ? 0 : 1;
  }
  EXPECT_GT(refused, 100);
  EXPECT_LT(refused, 3000);
}

TEST(GltfColliders, AreTheSameBitsEachTime) {
  const std::string original = GlbOf(RiggedGltf());
  const ColliderSet set = SetOn(original, {0, 1, 2, 3, 5});
  EXPECT_EQ(FileOf(Write(set, original, {true})), FileOf(Write(set, original, {true})));
}

}  // namespace
}  // namespace capfit::exports
