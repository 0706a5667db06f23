// Skins, joints, parts and what VRM says of them, held against glTF's own formula.
#include "core/formats/gltf_skins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "tests/core/formats/gltf_maker.h"

namespace capfit::formats {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using testing::HasSubstr;

json MatrixOf(const Affine3d& transform) {
  return std::vector<double>(transform.matrix().data(), transform.matrix().data() + 16);
}

std::string FloatsOf(const std::vector<Affine3d>& matrices) {
  std::vector<float> floats;
  for (const Affine3d& m : matrices) {
    for (int k = 0; k < 16; ++k) floats.push_back(static_cast<float>(m.matrix().data()[k]));
  }
  return PackedBytes(floats);
}

// Some place, turn and scale; the same on every run.
Affine3d SomeTransform(std::mt19937& rng) {
  std::uniform_real_distribution<double> some(-1.0, 1.0);
  Affine3d transform = Affine3d::Identity();
  transform.translate(Vector3d(some(rng), some(rng), some(rng)));
  transform.rotate(Eigen::AngleAxisd(some(rng), Vector3d(some(rng), 1, some(rng)).normalized()));
  transform.scale(1.0 + 0.5 * some(rng));
  return transform;
}

// The tetrahedron (node 0) on a chain of joints (nodes 1, 2, ...), each the child of the one
// before, with any transforms and inverse binds.
struct SkinnedTetrahedron : GltfMaker {
  std::vector<Affine3d> to_world;
  std::vector<Affine3d> inverse_binds;

  explicit SkinnedTetrahedron(std::size_t joints) {
    std::mt19937 rng(20240607);
    gltf["scenes"][0]["nodes"] = {0, 1};
    gltf["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {9, 9, 9}}}};
    Affine3d above = Affine3d::Identity();
    for (std::size_t j = 0; j < joints; ++j) {
      const Affine3d to_parent = SomeTransform(rng);
      above = above * to_parent;
      to_world.push_back(above);
      inverse_binds.push_back(SomeTransform(rng));
      gltf["nodes"].push_back(
          {{"name", "joint " + std::to_string(j)}, {"matrix", MatrixOf(to_parent)}});
      if (j + 1 < joints) gltf["nodes"][j + 1]["children"] = {j + 2};
      gltf["skins"][0]["joints"].push_back(j + 1);
    }
    gltf["skins"][0]["inverseBindMatrices"] =
        AddAccessor(FloatsOf(inverse_binds), 5126, joints, "MAT4");
  }

  [[nodiscard]] Vector3d Placed(const Vector3d& stored,
                                const std::vector<std::pair<std::size_t, double>>& held) const {
    Vector3d sum = Vector3d::Zero();
    for (const auto& [j, weight] : held) sum += weight * (to_world[j] * inverse_binds[j] * stored);
    return sum;
  }
};

const std::vector<Vector3d> kStored = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(GltfSkinTest, PlacesVerticesAsTheFormulaSaysWithUpToEightJoints) {
  SkinnedTetrahedron file(9);
  file.attributes()["JOINTS_0"] = file.AddAccessor(
      PackedBytes<std::uint8_t>({0, 1, 2, 3, 4, 0, 0, 0, 5, 6, 0, 0, 8, 7, 6, 5}), 5121, 4, "VEC4");
  file.attributes()["WEIGHTS_0"] = file.AddAccessor(
      PackedBytes<std::uint8_t>({51, 51, 51, 0, 255, 0, 0, 0, 153, 102, 0, 0, 51, 51, 51, 51}),
      5121, 4, "VEC4", true);
  file.attributes()["JOINTS_1"] = file.AddAccessor(
      PackedBytes<std::uint16_t>({3, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 999, 0, 0}), 5123, 4,
      "VEC4");
  file.attributes()["WEIGHTS_1"] = file.AddAccessor(
      PackedBytes<std::uint16_t>({13107, 13107, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 13107, 0, 0, 0}),
      5123, 4, "VEC4", true);
  const auto soup = file.Read();
  ASSERT_TRUE(soup.ok()) << soup.status();
  const std::vector<std::vector<std::pair<std::size_t, double>>> held = {
      {{0, .2}, {1, .2}, {2, .2}, {3, .2}, {4, .2}},
      {{4, 1.0}},
      {{5, .6}, {6, .4}},
      {{8, .2}, {7, .2}, {6, .2}, {5, .2}, {4, .2}}};
  ASSERT_EQ(soup->influences.size(), 4u);
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_LE((soup->positions[v] - file.Placed(kStored[v], held[v])).norm(), 1e-5) << v;
    const JointInfluences& influences = soup->influences[v];
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      sum += influences.weight[k];
      if (influences.weight[k] == 0.0F) continue;
      EXPECT_TRUE(std::any_of(held[v].begin(), held[v].end(),
                              [&](const auto& h) { return h.first == influences.joint[k]; }));
    }
    EXPECT_NEAR(sum, 1.0, 1e-6) << v;
  }
  EXPECT_NEAR(soup->influences[3].weight[0], 0.25, 1e-6);  // four of five, as strong as each other
  for (std::size_t j = 0; j < 9; ++j) {
    EXPECT_EQ(soup->joints[j].parent, static_cast<int>(j) - 1);
    EXPECT_LE((soup->joints[j].position - file.to_world[j].translation()).norm(), 1e-9);
  }
}

TEST(GltfSkinTest, WeightsNeedNotSumToOneAndBadOnesCountAsNone) {
  SkinnedTetrahedron file(2);
  const float nan = std::nanf("");
  file.attributes()["JOINTS_0"] =
      file.AddAccessor(PackedBytes<std::uint16_t>({0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 7, 7, 7, 7}),
                       5123, 4, "VEC4");
  file.attributes()["WEIGHTS_0"] = file.AddAccessor(
      PackedBytes<float>({6, 2, 0, 0, nan, 3, 0, 0, 1, -5, 0, 0, 0, 0, 0, 0}), 5126, 4, "VEC4");
  const auto soup = file.Read();
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_LE((soup->positions[0] - file.Placed(kStored[0], {{0, .75}, {1, .25}})).norm(), 1e-5);
  EXPECT_LE((soup->positions[1] - file.Placed(kStored[1], {{1, 1.0}})).norm(), 1e-5);
  EXPECT_LE((soup->positions[2] - file.Placed(kStored[2], {{1, 1.0}})).norm(), 1e-5);
  // Held by nobody: follows the first joint.
  EXPECT_LE((soup->positions[3] - file.Placed(kStored[3], {{0, 1.0}})).norm(), 1e-5);
  EXPECT_EQ(soup->influences[3].weight, (std::array<float, 4>{}));
}

TEST(GltfSkinTest, AJointWhoseMatrixIsNoneMovesNothing) {
  SkinnedTetrahedron file(3);
  file.inverse_binds[0].matrix().setZero();
  file.gltf["skins"][0]["inverseBindMatrices"] =
      file.AddAccessor(FloatsOf(file.inverse_binds), 5126, 3, "MAT4");
  file.attributes()["JOINTS_0"] = file.AddAccessor(
      PackedBytes<std::uint8_t>({0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0}), 5121, 4, "VEC4");
  file.attributes()["WEIGHTS_0"] = file.AddAccessor(
      PackedBytes<float>({.5, .5, 0, 0, .9, .1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), 5126, 4, "VEC4");
  const auto soup = file.Read();
  ASSERT_TRUE(soup.ok()) << soup.status();
  const std::vector<std::size_t> follows = {1, 2, 1, 2};  // 1: the first that makes sense
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_LE((soup->positions[v] - file.Placed(kStored[v], {{follows[v], 1.0}})).norm(), 1e-5)
        << v;
  }
}

TEST(GltfSkinTest, RefusesAJointThatTheSkinDoesNotHave) {
  SkinnedTetrahedron file(2);
  file.attributes()["JOINTS_0"] = file.AddAccessor(
      PackedBytes<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0}), 5121, 4, "VEC4");
  file.attributes()["WEIGHTS_0"] = file.AddAccessor(
      PackedBytes<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), 5126, 4, "VEC4");
  EXPECT_EQ(file.ToldOf(),
            "OUT_OF_RANGE [value=2, limit=[0, 2), element=mesh 0, row=0] mesh.file mesh 0 "
            "primitive 0: JOINTS_0 of vertex 2 is 2, must be in [0, 2)");
  file.gltf["accessors"][file.attributes()["JOINTS_0"].get<std::size_t>()]["count"] = 3;
  EXPECT_THAT(file.ToldOf(), HasSubstr("COUNT_MISMATCH [value=3, limit=4"));
  file.attributes()["JOINTS_0"] = file.attributes()["WEIGHTS_0"];
  EXPECT_THAT(file.ToldOf(), HasSubstr("JOINTS_0 must be of unsigned numbers"));
}

// Two meshes with skins of their own share joint nodes: each node is one joint.
TEST(GltfSkinTest, MergesTheJointsOfSeveralSkins) {
  SkinnedTetrahedron file(3);
  file.gltf["skins"].push_back({{"joints", {3, 2}}});
  file.gltf["nodes"].push_back({{"mesh", 0}, {"skin", 1}, {"name", "second"}});
  file.gltf["scenes"][0]["nodes"].push_back(4);
  file.attributes()["JOINTS_0"] =
      file.AddAccessor(PackedBytes(std::vector<std::uint8_t>(16, 1)), 5121, 4, "VEC4");
  file.attributes()["WEIGHTS_0"] =
      file.AddAccessor(PackedBytes(std::vector<std::uint8_t>(16, 255)), 5121, 4, "VEC4", true);
  const auto soup = file.Read();
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->joints.size(), 3u);
  ASSERT_EQ(soup->influences.size(), 8u);
  EXPECT_EQ(soup->influences[0].joint[0], 1);  // joint 1 of either skin: nodes 2 and 2
  EXPECT_EQ(soup->influences[7].joint[0], 1);
  // Without bind matrices these are identities.
  EXPECT_LE((soup->positions[5] - file.to_world[1] * kStored[1]).norm(), 1e-9);
  EXPECT_EQ(soup->parts[1].name, "second");
}

TEST(GltfSkinTest, AMeshUnderAJointIsARigidPartOfIt) {
  SkinnedTetrahedron file(2);
  file.gltf["nodes"][2]["children"] = {3};
  file.gltf["nodes"].push_back({{"children", {4}}});
  file.gltf["nodes"].push_back({{"mesh", 0}, {"translation", {1, 2, 3}}});
  file.gltf["meshes"][0]["name"] = "sword";
  file.gltf["meshes"][0]["primitives"][0]["material"] = 1;
  file.gltf["materials"] = {{{"name", "skin"}}, {{"name", "steel"}, {"extras", {{"x", 1}}}}};
  const auto soup = file.Read();
  ASSERT_TRUE(soup.ok()) << soup.status();
  ASSERT_EQ(soup->parts.size(), 2u);
  EXPECT_EQ(soup->parts[0].joint, -1);
  EXPECT_EQ(soup->parts[1].joint, 1);
  EXPECT_EQ(soup->parts[1].name, "sword");
  EXPECT_EQ(soup->parts[1].material, "steel");
  EXPECT_EQ(soup->parts[1].first_face, 4u);
  EXPECT_EQ(soup->parts[1].face_count, 4u);
  ASSERT_EQ(soup->influences.size(), 8u);
  EXPECT_EQ(soup->influences[0].weight[0], 0.0F);  // its primitive has no weights
  EXPECT_EQ(soup->influences[4].joint[0], 1);
  EXPECT_EQ(soup->influences[4].weight[0], 1.0F);
  EXPECT_LE((soup->positions[4] - file.to_world[1] * Vector3d(1, 2, 3)).norm(), 1e-9);
}

TEST(GltfSkinTest, VrmSaysWhichBonesAreAHumans) {
  SkinnedTetrahedron file(3);
  file.gltf["nodes"].push_back({{"name", "not in the skin"}, {"translation", {0, 5, 0}}});
  file.gltf["scenes"][0]["nodes"].push_back(4);
  const json second = file.gltf;
  file.gltf["extensions"]["VRM"]["humanoid"]["humanBones"] = {
      {{"bone", "hips"}, {"node", 1}}, {{"bone", "head"}, {"node", 4}}, {{"bone", "jaw"}}, 7};
  const auto soup = file.Read();
  ASSERT_TRUE(soup.ok()) << soup.status();
  ASSERT_EQ(soup->joints.size(), 4u);
  EXPECT_EQ(soup->joints[0].human_bone, "hips");
  EXPECT_EQ(soup->joints[1].human_bone, "");
  EXPECT_EQ(soup->joints[3].human_bone, "head");
  EXPECT_EQ(soup->joints[3].position, Vector3d(0, 5, 0));
  file.gltf = second;
  file.gltf["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"] = {{"leftLowerArm", {{"node", 2}}},
                                                                   {"hips", {{"node", 99}}}};
  EXPECT_EQ(file.Read()->joints[1].human_bone, "leftLowerArm");
  EXPECT_EQ(file.Read()->joints.size(), 3u);
}

TEST(GltfSkinTest, ManySkinsOfManyJointsAreRefused) {
  SkinnedTetrahedron file(1);
  for (int s = 0; s < 17; ++s) {
    file.gltf["skins"][s] = {{"joints", std::vector<int>(4096, 1)}};
    file.gltf["nodes"].push_back({{"mesh", 0}, {"skin", s}});
    file.gltf["scenes"][0]["nodes"].push_back(s + 2);
  }
  EXPECT_THAT(file.ToldOf(), HasSubstr("brings the file to 69632 joints of skins, must have at "
                                       "most 65536"));
}

}  // namespace
}  // namespace capfit::formats
