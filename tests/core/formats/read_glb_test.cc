#include "core/formats/read_glb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/formats/gltf_json.h"
#include "tests/core/formats/gltf_maker.h"
#include "tests/support/told.h"

namespace capfit::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ReadGlbTest, ReadsPositionsAndIndices) {
  const auto soup = ReadGltf(TetrahedronGltf());
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->positions.size(), 4u);
  EXPECT_EQ(soup->positions[3], Eigen::Vector3d(0, 0, 1));
  EXPECT_THAT(soup->face_vertices, ElementsAre(0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3));
}

TEST(ReadGlbTest, ReadsIndicesOfAllSizesAndNone) {
  json gltf = TetrahedronGltf();
  gltf["accessors"][1]["componentType"] = 5121;
  gltf["accessors"][1]["count"] = 6;
  EXPECT_THAT(
      ReadGltf(gltf, kTetrahedronBytes.substr(0, 48) +
                         PackedBytes<std::uint8_t>({0, 2, 1, 0, 1, 3}) + std::string(18, '\0'))
          ->face_vertices,
      ElementsAre(0, 2, 1, 0, 1, 3));
  gltf["accessors"][1]["componentType"] = 5125;
  EXPECT_THAT(ReadGltf(gltf, kTetrahedronBytes.substr(0, 48) +
                                 PackedBytes<std::uint32_t>({0, 2, 1, 0, 1, 3}))
                  ->face_vertices,
              ElementsAre(0, 2, 1, 0, 1, 3));
  gltf["meshes"][0]["primitives"][0].erase("indices");
  EXPECT_THAT(ReadGltf(gltf)->face_vertices, ElementsAre(0, 1, 2));  // the fourth has no company
}

TEST(ReadGlbTest, ReadsStripsAndFansAndSharedPositionsOnce) {
  json gltf = TetrahedronGltf();
  gltf["accessors"][1]["count"] = 4;
  json& primitives = gltf["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives.push_back(primitives[0]);
  primitives[0]["mode"] = 5;
  primitives[1]["mode"] = 6;
  primitives[2]["mode"] = 1;  // lines
  const auto soup =
      ReadGltf(gltf, kTetrahedronBytes.substr(0, 48) + PackedBytes<std::uint16_t>({0, 1, 2, 3}) +
                         std::string(16, '\0'));
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->positions.size(), 4u);
  EXPECT_THAT(soup->face_vertices, ElementsAre(0, 1, 2, 1, 3, 2, 0, 1, 2, 0, 2, 3));
}

TEST(ReadGlbTest, ScalesNormalizedIntegersAndSkipsStrides) {
  json gltf = TetrahedronGltf();
  gltf["bufferViews"][0] = {{"buffer", 0}, {"byteLength", 32}, {"byteStride", 8}};
  gltf["accessors"][0]["componentType"] = 5122;
  gltf["accessors"][0]["normalized"] = true;
  std::vector<std::int16_t> positions(16, 99);
  for (int v = 0; v < 4; ++v) {
    for (int axis = 0; axis < 3; ++axis) positions[4 * v + axis] = v == axis + 1 ? 32767 : 0;
  }
  positions[0] = -32768;
  const auto soup =
      ReadGltf(gltf, PackedBytes(positions) + std::string(16, '\0') + kTetrahedronBytes.substr(48));
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->positions[0], Eigen::Vector3d(-1, 0, 0));
  EXPECT_EQ(soup->positions[2], Eigen::Vector3d(0, 1, 0));
}

TEST(ReadGlbTest, AppliesNodesOfTheSceneFromParentToChild) {
  json gltf = TetrahedronGltf();
  const double half = std::sqrt(0.5);
  gltf["nodes"] = {
      {{"children", {1}}, {"translation", {10, 0, 0}}, {"rotation", {half, 0, 0, half}}},
      {{"mesh", 0}, {"scale", {1, 2, 3}}},
      {{"mesh", 0}}};  // not in the scene
  const auto soup = ReadGltf(gltf);
  ASSERT_TRUE(soup.ok()) << soup.status();
  ASSERT_EQ(soup->positions.size(), 4u);
  EXPECT_TRUE(soup->positions[1].isApprox(Eigen::Vector3d(11, 0, 0), 1e-12));
  EXPECT_TRUE(soup->positions[2].isApprox(Eigen::Vector3d(10, 0, 2), 1e-12));   // y to z
  EXPECT_TRUE(soup->positions[3].isApprox(Eigen::Vector3d(10, -3, 0), 1e-12));  // z to -y
  gltf["nodes"][0] = {{"children", {1}},
                      {"matrix", {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}};  // mirrors
  const auto mirrored = ReadGltf(gltf);
  ASSERT_TRUE(mirrored.ok()) << mirrored.status();
  EXPECT_TRUE(mirrored->positions[1].isApprox(Eigen::Vector3d(5, 7, 7), 1e-12));
  EXPECT_THAT(std::vector(mirrored->face_vertices.begin(), mirrored->face_vertices.begin() + 3),
              ElementsAre(0, 1, 2));
}

TEST(ReadGlbTest, DrawsAllNodesWhereThereIsNoScene) {
  json gltf = TetrahedronGltf();
  gltf.erase("scene");
  gltf.erase("scenes");
  gltf["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 0, 5}}}};
  EXPECT_EQ(ReadGltf(gltf)->positions.size(), 8u);
}

// Two joints; the skeleton is stored in centimetres and lies on its back, as exporters leave it.
TEST(ReadGlbTest, ReadsJointsWhereTheyStand) {
  json gltf = TetrahedronGltf();
  gltf["scenes"][0]["nodes"] = {0, 1};
  gltf["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 100, 100}}},  // must not count
                   {{"name", "armature"}, {"scale", {0.01, 0.01, 0.01}}, {"children", {2}}},
                   {{"name", "hips"}, {"translation", {0, 90, 0}}, {"children", {3}}},
                   {{"name", "head"}, {"translation", {0, 60, 0}}}};
  gltf["skins"] = {{{"joints", {2, 3}}, {"inverseBindMatrices", 2}}};
  gltf["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", 2}, {"type", "MAT4"}});
  gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 72}, {"byteLength", 128}});
  // Bound with the mesh in centimetres: the joints at y = 90 and y = 150.
  const std::string matrices =
      PackedBytes<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -90,  0, 1,
                          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -150, 0, 1});
  const auto soup = ReadGltf(gltf, kTetrahedronBytes + matrices);
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_TRUE(soup->positions[1].isApprox(Eigen::Vector3d(0.01, 0, 0), 1e-9));
  ASSERT_EQ(soup->joints.size(), 2u);
  EXPECT_EQ(soup->joints[0].name, "hips");
  EXPECT_TRUE(soup->joints[0].position.isApprox(Eigen::Vector3d(0, 0.9, 0), 1e-6));
  EXPECT_EQ(soup->joints[1].name, "head");
  EXPECT_TRUE(soup->joints[1].position.isApprox(Eigen::Vector3d(0, 1.5, 0), 1e-6));
  gltf["skins"][0].erase("inverseBindMatrices");
  EXPECT_TRUE(ReadGltf(gltf)->joints[1].position.isApprox(Eigen::Vector3d(0, 1.5, 0), 1e-6));
}

TEST(GltfJsonTest, KeepsNamesOfMaterialsAndVrmsBones) {
  const std::optional<json> parsed = ParseGltfJson(R"({"materials": [
    {"name": "skin", "pbrMetallicRoughness": {"name": "no"}, "extras": {"name": "no"}}, {}],
    "extensions": {"KHR_lights_punctual": {"humanoid": 1}, "VRM": {"meta": {"humanoid": [1]},
      "blendShapeMaster": [{"humanBones": 1}], "humanoid": {"armStretch": 0.05,
      "humanBones": [{"bone": "hips", "node": 3, "extras": 1}]}},
      "VRMC_vrm": {"specVersion": "1.0", "humanoid": {"humanBones": {"head": {"node": 4}}}}}})");
  ASSERT_TRUE(parsed.has_value());
  EXPECT_EQ(*parsed, json::parse(R"({"materials": [{"name": "skin"}, {}], "extensions": {
    "VRM": {"humanoid": {"humanBones": [{"bone": "hips", "node": 3}]}},
    "VRMC_vrm": {"humanoid": {"humanBones": {"head": {"node": 4}}}}}})"));
}

TEST(GltfJsonTest, KeepsJustWhatMeshesNeed) {
  const std::string text = R"({"images": [{"nodes": [1, {"a": [[], {}]}]}, 2], "scene": 0,
    "nodes": [{"extras": {"deep": [{"x": 1}], "name": "no"}, "name": "n", "matrix": [1, -2, 3.5]},
              {"extras": 7, "children": [], "skin": null, "visible": true}],
    "extras": [], "meshes": [{"primitives": [{"extras": [[1]], "mode": 4}, {}]}], "skins": []})";
  const std::optional<json> parsed = ParseGltfJson(text);
  ASSERT_TRUE(parsed.has_value());
  EXPECT_EQ(*parsed, json::parse(R"({"scene": 0,
    "nodes": [{"name": "n", "matrix": [1, -2, 3.5]},
              {"children": [], "skin": null, "visible": true}],
    "meshes": [{"primitives": [{"mode": 4}, {}]}], "skins": []})"));
  for (const char* const bad : {"", "[]", "7", "{", "{\"nodes\":[}", "{} {}", "{\"a\":1e999}"}) {
    EXPECT_FALSE(ParseGltfJson(bad).has_value()) << bad;
  }
}

// Few bytes may ask for much: the same mesh, skin or name again and again.
TEST(ReadGlbTest, RefusesOrSharesWhatRepeatsItself) {
  json gltf = TetrahedronGltf();
  gltf["scenes"][0]["nodes"] = json::array();
  for (int i = 0; i < 400; ++i) {
    gltf["nodes"][i] = {{"mesh", 0}};
    gltf["scenes"][0]["nodes"].push_back(i);
  }
  for (int i = 0; i < 400; ++i) gltf["meshes"][0]["primitives"][i] = {{"mode", 0}};
  EXPECT_THAT(ToldOfGltf(gltf),
              HasSubstr("brings the file to 100400 drawn primitives, must have at most 100000"));
  gltf["meshes"][0] = TetrahedronGltf()["meshes"][0];
  gltf["skins"] = {{{"joints", {0, 0, 0, 1}}}};
  for (int i = 0; i < 400; ++i) gltf["nodes"][i]["skin"] = 0;
  gltf["nodes"][0]["name"] = "hips";
  gltf["nodes"][1]["name"] = std::string(300, 'n');
  const auto soup = ReadGltf(gltf);
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->positions.size(), 1600u);
  ASSERT_EQ(soup->joints.size(), 2u);  // once per node, and no endless name
  EXPECT_EQ(soup->joints[0].name, "hips");
  EXPECT_EQ(soup->joints[1].name, "");
  gltf["nodes"] = json::array();
  for (int i = 0; i <= 100'000; ++i) gltf["nodes"].push_back(json::object());
  EXPECT_THAT(ToldOfGltf(gltf), HasSubstr("has 100001 nodes, must have at most 100000"));
}

// Some exporters leave zeros where they know no bind pose: then the nodes are all there is.
TEST(ReadGlbTest, LeavesTheBodyABodyWhereTheBindPoseIsNone) {
  json gltf = TetrahedronGltf();
  gltf["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {1, 0, 0}}},
                   {{"name", "hips"}, {"translation", {0, 9, 0}}}};
  gltf["skins"] = {{{"joints", {1}}, {"inverseBindMatrices", 2}}};
  gltf["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", 1}, {"type", "MAT4"}});
  gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 72}, {"byteLength", 64}});
  const auto soup = ReadGltf(gltf, kTetrahedronBytes + std::string(64, '\0'));
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->positions[0], Eigen::Vector3d(1, 0, 0));
  ASSERT_EQ(soup->joints.size(), 1u);
  EXPECT_EQ(soup->joints[0].position, Eigen::Vector3d(0, 9, 0));
}

struct BadGltf {
  const char* name;
  const char* pointer;  // where in the JSON
  json value;           // what to put there
  const char* told;
  friend void PrintTo(const BadGltf& bad, std::ostream* os) { *os << bad.name; }
};
class BadGltfTest : public testing::TestWithParam<BadGltf> {};

TEST_P(BadGltfTest, TellsReasonPlaceFiguresAndMessage) {
  json gltf = TetrahedronGltf();
  gltf[json::json_pointer(GetParam().pointer)] = GetParam().value;
  EXPECT_EQ(ToldOfGltf(gltf), GetParam().told);
  EXPECT_EQ(FieldOf(ReadGltf(gltf).status()), "mesh.file");
}

INSTANTIATE_TEST_SUITE_P(
    All, BadGltfTest,
    testing::Values(
        BadGltf{"EmptyScene", "/scenes/0/nodes", json::array(),
                "MISSING mesh.file has no mesh: its scene draws no triangles"},
        BadGltf{"NoPrimitives", "/meshes/0/primitives", 7,
                "MISSING mesh.file has no mesh: its scene draws no triangles"},
        BadGltf{"NoPosition", "/meshes/0/primitives/0/attributes", json::object(),
                "MALFORMED_FILE [element=mesh 0, row=0] mesh.file mesh 0 primitive 0: POSITION is "
                "missing"},
        BadGltf{"PositionOutOfRange", "/meshes/0/primitives/0/attributes/POSITION", 9,
                "OUT_OF_RANGE [value=9, limit=[0, 2), element=mesh 0, row=0] mesh.file mesh 0 "
                "primitive 0: POSITION is 9, must be in [0, 2)"},
        BadGltf{"IndicesOutOfRange", "/meshes/0/primitives/0/indices", 2,
                "OUT_OF_RANGE [value=2, limit=[0, 2), element=mesh 0, row=0] mesh.file mesh 0 "
                "primitive 0: indices is 2, must be in [0, 2)"},
        BadGltf{"UnknownMode", "/meshes/0/primitives/0/mode", 8,
                "OUT_OF_RANGE [value=8, limit=[0, 7), element=mesh 0, row=0] mesh.file mesh 0 "
                "primitive 0: mode is 8, must be in [0, 7)"},
        BadGltf{"Draco",
                "/meshes/0/primitives/0/extensions",
                {{"KHR_draco_mesh_compression", json::object()}},
                "MALFORMED_FILE [element=mesh 0, row=0] mesh.file mesh 0 primitive 0: bufferView "
                "is missing"},
        BadGltf{"Meshopt",
                "/bufferViews/0/extensions",
                {{"EXT_meshopt_compression", json::object()}},
                "MALFORMED_FILE [element=buffer view 0] mesh.file buffer view 0: buffer is "
                "missing"},
        BadGltf{"Sparse", "/accessors/0/sparse", json::object(),
                "MALFORMED_FILE [element=accessor 0] mesh.file accessor 0: count is missing"},
        BadGltf{"RequiredExtension", "/extensionsRequired",
                json::array({"KHR_materials_unlit", "EXT_mesh_gpu_instancing"}),
                "UNSUPPORTED_FILE mesh.file requires the extension EXT_mesh_gpu_instancing, which "
                "is not read: export without it"},
        BadGltf{"OldVersion", "/asset/version", "1.0",
                "UNSUPPORTED_FILE [value=1.0, limit=2] mesh.file is of glTF version 1.0, must be "
                "of version 2"},
        BadGltf{
            "WrongType", "/accessors/0/type", "VEC2",
            "MALFORMED_FILE [element=accessor 0] mesh.file accessor 0: it must be of type VEC3"},
        BadGltf{"WrongComponents", "/accessors/0/componentType", 5130,
                "MALFORMED_FILE [element=accessor 0] mesh.file accessor 0: it has no known "
                "component type"},
        BadGltf{"SignedIndices", "/accessors/1/componentType", 5122,
                "MALFORMED_FILE [element=accessor 1] mesh.file accessor 1: it has indices, which "
                "must be unsigned"},
        BadGltf{"NoBufferView", "/accessors/0/bufferView", -1,
                "OUT_OF_RANGE [value=-1, limit=[0, 2), element=accessor 0] mesh.file accessor 0: "
                "bufferView is -1, must be in [0, 2)"},
        BadGltf{"CountTooHigh", "/accessors/0/count", 5,
                "OUT_OF_RANGE [value=60, limit=48, element=accessor 0] mesh.file accessor 0: it is "
                "out of range: it needs 60 bytes of buffer view 0, which has 48"},
        BadGltf{"CountHuge", "/accessors/0/count", 18446744073709551615u,
                "MALFORMED_FILE [element=accessor 0] mesh.file accessor 0: it has a bad stride, "
                "offset or count"},
        BadGltf{"OffsetTooHigh", "/accessors/1/byteOffset", 1,
                "OUT_OF_RANGE [value=25, limit=24, element=accessor 1] mesh.file accessor 1: it is "
                "out of range: it needs 25 bytes of buffer view 1, which has 24"},
        BadGltf{"OffsetNegative", "/accessors/1/byteOffset", -1,
                "MALFORMED_FILE [element=accessor 1] mesh.file accessor 1: it has a bad stride, "
                "offset or count"},
        BadGltf{"StrideTooSmall", "/bufferViews/0/byteStride", 4,
                "MALFORMED_FILE [element=accessor 0] mesh.file accessor 0: it has a bad stride, "
                "offset or count"},
        BadGltf{"ViewTooLong", "/bufferViews/1/byteLength", 25,
                "OUT_OF_RANGE [value=73, limit=72, element=buffer view 1] mesh.file buffer view 1: "
                "it is out of range: it ends at byte 73 of the 72 in the binary chunk"},
        BadGltf{"ViewTooFar", "/bufferViews/1/byteOffset", 281474976710000u,
                "OUT_OF_RANGE [value=281474976710024, limit=72, element=buffer view 1] mesh.file "
                "buffer view 1: it is out of range: it ends at byte 281474976710024 of the 72 in "
                "the binary chunk"},
        BadGltf{"BufferElsewhere", "/buffers/0/uri", "body.bin",
                "UNSUPPORTED_FILE [element=buffer view 0] mesh.file buffer view 0: its bytes "
                "are not in the file but in 'body.bin', and no other file is opened: export as "
                "GLB, in one file"},
        BadGltf{"UnknownBuffer", "/bufferViews/0/buffer", 1,
                "OUT_OF_RANGE [value=1, limit=[0, 1), element=buffer view 0] mesh.file buffer view "
                "0: buffer is 1, must be in [0, 1)"},
        BadGltf{"RingOfNodes", "/nodes/0/children", json::array({0}),
                "MALFORMED_FILE mesh.file has nodes that are their own ancestors"},
        BadGltf{"TwoParents",
                "/nodes",
                {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}},
                "MALFORMED_FILE [element=node 2] mesh.file node 2: it has two parents"},
        BadGltf{"NodesNoArray", "/nodes", "none",
                "MISSING mesh.file has no mesh: its scene draws no triangles"}),
    [](const auto& test) { return test.param.name; });

TEST(ReadGlbTest, RefusesIndicesBeyondTheVertices) {
  std::string binary = kTetrahedronBytes;
  binary[48 + 2 * 7] = 4;
  EXPECT_EQ(ToldOfGltf(TetrahedronGltf(), binary),
            "OUT_OF_RANGE [value=4, limit=[0, 4), element=accessor 1, row=7] mesh.file accessor 1 "
            "row 7: the index is 4, must be in [0, 4)");
}

TEST(ReadGlbTest, RefusesCoordinatesThatAreNone) {
  const auto with = [](float y_of_vertex_2) {
    return PackedBytes<float>({0, 0, 0, 1, 0, 0, 0, y_of_vertex_2, 0, 0, 0, 1}) +
           kTetrahedronBytes.substr(48);
  };
  EXPECT_EQ(ToldOfGltf(TetrahedronGltf(), with(std::nanf(""))),
            "NOT_FINITE [value=nan, limit=finite, element=accessor 0, row=2] mesh.file accessor 0 "
            "row 2: y is nan, must be finite");
  EXPECT_EQ(ToldOfGltf(TetrahedronGltf(), with(-2e12F)),
            "OUT_OF_RANGE [value=-2e+12, limit=[-1e+12, 1e+12], element=accessor 0, row=2] "
            "mesh.file accessor 0 row 2: y is -2e+12, must be in [-1e+12, 1e+12]");
  json gltf = TetrahedronGltf();
  gltf["nodes"][0]["translation"] = {0, 0, 1e300};
  EXPECT_EQ(
      ToldOfGltf(gltf),
      "OUT_OF_RANGE [value=1e+300, limit=[-1e+12, 1e+12], element=accessor 0, row=0] "
      "mesh.file accessor 0 row 0, placed by node 0: z is 1e+300, must be in [-1e+12, 1e+12]");
  gltf["nodes"][0] = {{"mesh", 0}, {"scale", {1e-3, 1e-3, 1e-3}}};
  EXPECT_EQ(ToldOfGltf(gltf, with(-2e12F)), "accepted");  // where it is put it can be
}

TEST(ReadGlbTest, RefusesBadSkins) {
  json gltf = TetrahedronGltf();
  gltf["nodes"][0]["skin"] = 0;
  gltf["skins"] = {{{"joints", {0, 7}}}};
  EXPECT_EQ(ToldOfGltf(gltf),
            "OUT_OF_RANGE [value=7, limit=[0, 1), element=skin 0] mesh.file skin 0: a joint is 7, "
            "must be in [0, 1)");
  gltf["skins"][0]["joints"][1] = "hips";
  EXPECT_EQ(ToldOfGltf(gltf),
            "MALFORMED_FILE [element=skin 0] mesh.file skin 0: it has a joint that is no index");
  gltf["skins"][0]["joints"] = std::vector<int>(4097, 0);
  EXPECT_EQ(ToldOfGltf(gltf),
            "TOO_LARGE [value=4097, limit=4096, element=skin 0] mesh.file skin 0: it has 4097 "
            "joints, must have at most 4096");
  gltf["skins"] = {{{"joints", {0, 0}}, {"inverseBindMatrices", 2}}};
  EXPECT_EQ(ToldOfGltf(gltf),
            "OUT_OF_RANGE [value=2, limit=[0, 2), element=skin 0] mesh.file skin 0: "
            "inverseBindMatrices is 2, must be in [0, 2)");
  gltf["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", 1}, {"type", "MAT4"}});
  gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 72}, {"byteLength", 64}});
  EXPECT_EQ(ToldOfGltf(gltf, kTetrahedronBytes + std::string(64, '\0')),
            "COUNT_MISMATCH [value=1, limit=2, element=skin 0] mesh.file skin 0: it has 2 joints "
            "with only 1 matrices");
}

TEST(ReadGlbTest, RefusesMoreThanTheLimits) {
  MeshLimits limits;
  limits.max_vertices = 3;
  EXPECT_EQ(
      ToldOfGltf(TetrahedronGltf(), kTetrahedronBytes, limits),
      "TOO_LARGE [value=4, limit=3, element=accessor 0] mesh.file accessor 0: brings the file "
      "to 4 vertices, must have at most 3");
  limits.max_vertices = 4;
  limits.max_faces = 3;
  EXPECT_EQ(
      ToldOfGltf(TetrahedronGltf(), kTetrahedronBytes, limits),
      "TOO_LARGE [value=4, limit=3, element=accessor 1] mesh.file accessor 1: brings the file "
      "to 4 faces, must have at most 3");
  json strip = TetrahedronGltf();
  strip["meshes"][0]["primitives"][0]["mode"] = 5;
  limits.max_faces = 9;
  EXPECT_EQ(ToldOfGltf(strip, kTetrahedronBytes, limits),
            "TOO_LARGE [value=10, limit=9, element=mesh 0, row=0] mesh.file mesh 0 primitive 0: "
            "brings the file to 10 faces, must have at most 9");
}

TEST(ReadGlbTest, RefusesBadContainers) {
  const std::string good = GlbOf(TetrahedronGltf(), kTetrahedronBytes);
  EXPECT_EQ(ToldOfGlb(good), "accepted");
  EXPECT_THAT(ToldOfGlb("glTF"), HasSubstr("MALFORMED_FILE mesh.file is no GLB file"));
  EXPECT_THAT(
      ToldOfGlb("glTF" + PackedWord(1) + good.substr(8)),
      "UNSUPPORTED_FILE [value=1, limit=2] mesh.file is of glTF version 1, must be of version 2");
  for (const std::size_t size : {good.size() - 1, good.size() / 2, std::size_t{20}}) {
    EXPECT_THAT(ToldOfGlb(good.substr(0, size)), HasSubstr("ends early"));
  }
  std::string long_chunk = good;
  long_chunk.replace(12, 4, PackedWord(0xFFFFFFF0u));
  EXPECT_THAT(ToldOfGlb(long_chunk), HasSubstr("ends early: a chunk claims 4294967280"));
  const auto with_json = [](const std::string& text) {
    const std::string chunk = GlbChunk(0x4E4F534A, text, ' ');
    return "glTF" + PackedWord(2) + PackedWord(static_cast<std::uint32_t>(12 + chunk.size())) +
           chunk;
  };
  EXPECT_THAT(ToldOfGlb(with_json("{\"nodes\":")), HasSubstr("no JSON object"));
  EXPECT_THAT(ToldOfGlb(with_json("[]")), HasSubstr("no JSON object"));
  EXPECT_THAT(
      ToldOfGlb(with_json(std::string(9 << 20, ' '))),
      HasSubstr("TOO_LARGE [value=9437184, limit=8388608] mesh.file has 9437184 bytes of JSON"));
  EXPECT_THAT(ToldOfGlb("glTF" + PackedWord(2) + PackedWord(20) + PackedWord(0) + PackedWord(1)),
              HasSubstr("no JSON chunk"));
  // A million brackets deep: neither parsing nor freeing it may recurse.
  EXPECT_THAT(ToldOfGlb(with_json("{\"nodes\":" + std::string(1 << 20, '['))),
              HasSubstr("no JSON object"));
  EXPECT_THAT(ToldOfGlb(with_json("{\"nodes\":" + std::string(1 << 20, '[') +
                                  std::string(1 << 20, ']') + "}")),
              HasSubstr("no mesh"));
}

}  // namespace
}  // namespace capfit::formats
