// What glTF files do besides skins: morph targets, sparse accessors, repeated primitives, packings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "absl/strings/escaping.h"
#include "core/formats/read_mesh.h"
#include "tests/core/formats/gltf_maker.h"
#include "tests/support/bodies.h"

namespace capfit::formats {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(GltfFeaturesTest, MorphTargetsCountWithTheirDefaultWeights) {
  GltfMaker file;
  const auto first =
      file.AddAccessor(PackedBytes<float>({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2}), 5126, 4, "VEC3");
  const auto second =
      file.AddAccessor(PackedBytes<float>({0, 4, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0}), 5126, 4, "VEC3");
  file.gltf["meshes"][0]["primitives"][0]["targets"] = {
      {{"POSITION", first}, {"NORMAL", 99}}, {{"POSITION", second}}, {{"NORMAL", 99}}};
  EXPECT_EQ(file.Read()->positions[0], Vector3d(0, 0, 0));
  file.gltf["meshes"][0]["weights"] = {0.5, 0.25, 1};
  EXPECT_THAT(file.Read()->positions, ElementsAre(Vector3d(0.5, 1, 0), Vector3d(1, 1, 0),
                                                  Vector3d(0, 1, 0), Vector3d(0, 0, 2)));
  file.gltf["nodes"][0]["weights"] = {0, 1};  // the node's word counts before the mesh's
  EXPECT_THAT(file.Read()->positions, ElementsAre(Vector3d(0, 4, 0), Vector3d(1, 4, 0),
                                                  Vector3d(0, 1, 0), Vector3d(0, 0, 1)));
  file.gltf["accessors"][second]["count"] = 3;
  EXPECT_THAT(file.ToldOf(), HasSubstr("COUNT_MISMATCH [value=3, limit=4"));
}

TEST(GltfFeaturesTest, SparseAccessorsReplaceSomeElements) {
  GltfMaker file;
  const auto indices = file.AddView(PackedBytes<std::uint8_t>({1, 3}));
  const auto values = file.AddView(PackedBytes<float>({7, 8, 9, -1, -2, -3}));
  json& accessor = file.gltf["accessors"][0];
  accessor["sparse"] = {{"count", 2},
                        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                        {"values", {{"bufferView", values}}}};
  EXPECT_THAT(file.Read()->positions, ElementsAre(Vector3d(0, 0, 0), Vector3d(7, 8, 9),
                                                  Vector3d(0, 1, 0), Vector3d(-1, -2, -3)));
  accessor.erase("bufferView");  // then the others are zero
  EXPECT_THAT(file.Read()->positions, ElementsAre(Vector3d(0, 0, 0), Vector3d(7, 8, 9),
                                                  Vector3d(0, 0, 0), Vector3d(-1, -2, -3)));
  file.binary[file.gltf["bufferViews"][indices]["byteOffset"].get<std::size_t>()] = 4;
  EXPECT_THAT(file.ToldOf(), HasSubstr("accessor 0: its sparse index 0 is 4, must be in [0, 4)"));
  accessor["sparse"]["count"] = 5;
  EXPECT_THAT(file.ToldOf(), HasSubstr("count is 5, must be in [0, 5)"));
  accessor["sparse"]["count"] = 4;
  EXPECT_THAT(file.ToldOf(), HasSubstr("it needs 4 bytes of buffer view"));
}

// Few bytes of JSON must not take much memory.
TEST(GltfFeaturesTest, RefusesToUnpackWithoutEnd) {
  GltfMaker file;
  const auto view = file.AddView(PackedBytes<std::uint32_t>({0, 0, 0, 0}));
  json& accessor = file.gltf["accessors"][0];
  accessor = {{"componentType", 5126}, {"count", 4000000000u}, {"type", "VEC3"}};
  EXPECT_THAT(file.ToldOf(), HasSubstr("brings the file to 4000000000 vertices"));
  accessor["sparse"] = {{"count", 1},
                        {"indices", {{"bufferView", view}, {"componentType", 5125}}},
                        {"values", {{"bufferView", view}}}};
  EXPECT_THAT(file.ToldOf(), HasSubstr("brings the file to 48000000000 unpacked bytes, must have "
                                       "at most 268435456"));
}

// As exporters of several materials write it.
TEST(GltfFeaturesTest, ARepeatedPrimitiveIsAPartWithoutFaces) {
  GltfMaker file;
  json& primitives = file.gltf["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[1]["material"] = 0;
  file.gltf["materials"] = {{{"name", "shine"}}};
  const auto soup = file.Read();
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->face_count(), 4u);
  ASSERT_EQ(soup->parts.size(), 2u);
  EXPECT_EQ(soup->parts[1].material, "shine");
  EXPECT_EQ(soup->parts[1].first_face, 4u);
  EXPECT_EQ(soup->parts[1].face_count, 0u);
}

TEST(GltfFeaturesTest, ReadsTextWithItsBuffersInside) {
  GltfMaker file;
  std::string base64;
  absl::Base64Escape(file.binary, &base64);
  file.gltf["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64;
  file.gltf["images"] = {{{"uri", "data:image/png;base64," + std::string(9 << 20, 'A')}}};
  const auto read = [&] {
    const std::string text = file.gltf.dump();
    return ReadMesh(std::as_bytes(std::span(text)));
  };
  const auto soup = read();
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->positions, file.Read()->positions);
  EXPECT_EQ(soup->face_vertices, file.Read()->face_vertices);
  file.gltf["buffers"][0]["uri"] = "data:application/octet-stream;base64,#" + base64;
  EXPECT_THAT(Told(read().status()), HasSubstr("buffer 0: its data is no base64"));
  file.gltf["buffers"][0]["uri"] = "body.bin";
  EXPECT_THAT(Told(read().status()), HasSubstr("not in the file but in 'body.bin'"));
  file.gltf["nodes"] = std::vector<std::string>(1 << 20, "12345678");
  EXPECT_THAT(Told(read().status()), HasSubstr("bytes of JSON, must have at most 8388608"));
}

TEST(GltfFeaturesTest, UnpacksExponents) {
  GltfMaker file;
  const std::vector<float> positions = {0.5F, -3.25F, 100.0F, 1e-3F, 0.0F, 7.0F,
                                        2.0F, 4.0F,   8.0F,   1.0F,  1.0F, -1.0F};
  std::string filtered(48, '\0');
  meshopt_encodeFilterExp(filtered.data(), 4, 12, 20, positions.data());
  std::string packed(meshopt_encodeVertexBufferBound(4, 12), '\0');
  packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
                                           packed.size(), filtered.data(), 4, 12));
  const auto view = file.AddView(packed);
  json extension = file.gltf["bufferViews"][view];
  extension.update(
      {{"mode", "ATTRIBUTES"}, {"filter", "EXPONENTIAL"}, {"count", 4}, {"byteStride", 12}});
  file.gltf["bufferViews"][0] = {{"buffer", 1}, {"byteLength", 48}};
  file.gltf["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = extension;
  const auto soup = file.Read();
  ASSERT_TRUE(soup.ok()) << soup.status();
  for (std::size_t i = 0; i < 12; ++i) {  // a vertex shares its exponent: 19 bits of its largest
    const double largest = soup->positions[i / 3].cwiseAbs().maxCoeff();
    EXPECT_NEAR(soup->positions[i / 3][static_cast<int>(i % 3)], positions[i],
                std::ldexp(largest, -18));
  }
  json& stored = file.gltf["bufferViews"][0]["extensions"]["EXT_meshopt_compression"];
  stored["count"] = 1'000'000'000;
  EXPECT_THAT(file.ToldOf(), HasSubstr("claims to unpack to 12000000000 bytes, which"));
  stored["count"] = 4;
  stored["filter"] = "COLOR";
  EXPECT_THAT(file.ToldOf(), HasSubstr("UNSUPPORTED_FILE"));
  stored["filter"] = "OCTAHEDRAL";  // takes strides of 4 and 8 only
  EXPECT_THAT(file.ToldOf(), HasSubstr("has a count, stride or filter that cannot be"));
}

std::filesystem::path TubeFolder() { return std::filesystem::path(CAPFIT_TEST_DATA) / "gltf"; }

absl::StatusOr<PolygonSoup> ReadTube(const std::string& name) {
  const std::string bytes = test_support::ReadFile(TubeFolder() / (name + ".glb"));
  return ReadMesh(std::as_bytes(std::span(bytes)));
}

// Each position with its influence of the upper joint, in an order that packing keeps.
std::vector<std::array<double, 4>> SortedVertices(const PolygonSoup& soup) {
  std::vector<std::array<double, 4>> vertices;
  for (std::size_t v = 0; v < soup.positions.size(); ++v) {
    const Vector3d& p = soup.positions[v];
    double upper = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const JointInfluences& i = soup.influences[v];
      if (i.joint[k] < soup.joints.size() && soup.joints[i.joint[k]].name == "upper") {
        upper += i.weight[k];
      }
    }
    // Rings differ in their weight by a tenth, points on them by angles of 36 degrees.
    vertices.push_back({std::round(upper * 11.0), p.x(), p.y(), p.z()});
  }
  std::sort(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) {
    const auto key = [](const auto& v) {
      return std::array{v[0], std::round(20.0 * v[3]), v[1] + v[2]};
    };
    return key(a) < key(b);
  });
  return vertices;
}

class PackedTubeTest : public testing::TestWithParam<const char*> {};

// Made by other programs (tests/data/gltf/make_tube.mjs): the same tube, to the 16 bits that
// packing keeps.
TEST_P(PackedTubeTest, UnpacksToTheSameTube) {
  const auto plain = ReadTube("tube");
  ASSERT_TRUE(plain.ok()) << plain.status();
  const auto unpacked = ReadTube(GetParam());
  ASSERT_TRUE(unpacked.ok()) << unpacked.status();
  EXPECT_EQ(unpacked->face_count(), plain->face_count());
  ASSERT_EQ(unpacked->positions.size(), plain->positions.size());
  ASSERT_EQ(unpacked->influences.size(), plain->influences.size());
  const auto want = SortedVertices(*plain);
  const auto have = SortedVertices(*unpacked);
  for (std::size_t v = 0; v < want.size(); ++v) {
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(have[v][k], want[v][k], 5e-5) << v;
  }
  EXPECT_EQ(unpacked->parts.at(0).material, "cloth");
}

INSTANTIATE_TEST_SUITE_P(Packings, PackedTubeTest,
                         testing::Values("tube_draco_edgebreaker", "tube_draco_sequential",
                                         "tube_meshopt"),
                         [](const auto& tested) { return std::string(tested.param); });

// The tube by its formula: bound upright, its upper joint at half the height bent by 90 degrees.
TEST(PackedTubeTest, ThePlainTubeStandsAsItsJointsDo) {
  const auto soup = ReadTube("tube");
  ASSERT_TRUE(soup.ok()) << soup.status();
  for (int ring = 0; ring < 12; ++ring) {
    const double upper = ring / 11.0;
    for (int k = 0; k < 10; ++k) {
      const double angle = 0.2 * 3.14159265358979 * k;
      const Vector3d bound(0.1 * std::cos(angle), upper, 0.1 * std::sin(angle));
      const Vector3d bent(-(bound.y() - 0.5), 0.5 + bound.x(), bound.z());
      const Vector3d want = (1.0 - upper) * bound + upper * bent;
      EXPECT_LE((soup->positions[10 * ring + k] - want).norm(), 1e-6);
    }
  }
}

// Any damage gives an error or a mesh, and no more memory than the limits allow.
TEST_P(PackedTubeTest, SurvivesDamage) {
  const std::string good =
      test_support::ReadFile(TubeFolder() / (std::string(GetParam()) + ".glb"));
  std::size_t refused = 0;
  for (std::size_t i = 12; i < good.size(); ++i) {
    for (const int change : {1, 0x80, 0xFF}) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ change);
      const auto soup = ReadMesh(std::as_bytes(std::span(bad)));
      if (soup.ok()) continue;
      ++refused;
      EXPECT_EQ(FieldOf(soup.status()), "mesh.file");
    }
  }
  EXPECT_GT(refused, good.size() / 10);
}

}  // namespace
}  // namespace capfit::formats
