#include "core/formats/read_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <string>

namespace capfit::formats {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

absl::StatusOr<PolygonSoup> Read(const std::string& bytes, MeshFormat format,
                                 const MeshLimits& limits = {}) {
  return ReadMesh(std::as_bytes(std::span(bytes)), format, limits);
}

template <typename Value>
std::string Bytes(Value value, bool big_endian = false) {
  std::string bytes(sizeof(Value), '\0');
  std::memcpy(bytes.data(), &value, sizeof(Value));
  return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

TEST(FormatTest, ComesFromTheFileNamesEnding) {
  EXPECT_EQ(FormatFromFileName("a/b.c/body.OBJ"), MeshFormat::kObj);
  EXPECT_EQ(FormatFromFileName("body.ply"), MeshFormat::kPly);
  EXPECT_EQ(FormatFromFileName("body.obj.Stl"), MeshFormat::kStl);
  EXPECT_EQ(FormatFromFileName("body.off"), MeshFormat::kOff);
  EXPECT_EQ(FormatFromFileName("body.glb"), MeshFormat::kGlb);
  EXPECT_EQ(FormatFromFileName("body.gltf"), MeshFormat::kGlb);
  EXPECT_EQ(FormatFromFileName("avatar.vrm"), MeshFormat::kGlb);
  EXPECT_EQ(FormatFromFileName("body.fbx"), MeshFormat::kUnknown);
  EXPECT_EQ(FormatFromFileName("obj"), MeshFormat::kUnknown);
}

MeshFormat FormatOf(const std::string& bytes) {
  return FormatFromBytes(std::as_bytes(std::span(bytes)));
}

TEST(FormatTest, ComesFromTheFirstBytes) {
  EXPECT_EQ(FormatOf("ply\nformat ascii 1.0\n"), MeshFormat::kPly);
  EXPECT_EQ(FormatOf("glTF\2\0\0\0"), MeshFormat::kGlb);
  EXPECT_EQ(FormatOf("\xEF\xBB\xBF \n{\"asset\": {}}"), MeshFormat::kGlb);
  EXPECT_EQ(FormatOf("solid x\nfacet normal 0 0 1\n"), MeshFormat::kStl);
  EXPECT_EQ(FormatOf("solid, but binary" + std::string(63, ' ') + Bytes(1u) + std::string(50, 1)),
            MeshFormat::kStl);
  EXPECT_EQ(FormatOf("# made by hand\nSTOFF\n1 0 0\n"), MeshFormat::kOff);
  EXPECT_EQ(FormatOf("# Blender\nmtllib a.mtl\no body\nv 0 0 0\n"), MeshFormat::kObj);
  EXPECT_EQ(FormatOf("This is no mesh.\n"), MeshFormat::kUnknown);
  EXPECT_EQ(FormatOf(""), MeshFormat::kUnknown);
}

// (What has none: refusals_test.cc.)
TEST(ReadMeshTest, FindsTheFormat) { EXPECT_TRUE(Read("v 0 0 0\n", MeshFormat::kUnknown).ok()); }

TEST(ReadMeshTest, TakesFacesUpToTheLimits) {
  MeshLimits limits;
  limits.max_vertices = 3;
  limits.max_faces = 2;  // four triangles
  limits.max_corners_per_face = 6;
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 1 2 3\n";
  EXPECT_TRUE(Read(obj, MeshFormat::kObj, limits).ok());
}

TEST(ReadObjTest, ReadsWhatExportersWrite) {
  const auto soup = Read(
      "# exported\r\nmtllib none.mtl\r\no body\r\nv 10000.123456789 -0.5 1e-3 1.0\r\n"
      "v\t1 +2 3 0.5 0.5 0.5\r\nv 4 5 6\r\nvt 0 0\r\nvn 0 0 1\r\ng left\r\ns off\r\n"
      "f 1/1/1 2/1/1 3/1/1\r\nv 7 8 9\r\nf -1 -2//1 -3/1 -4\r\nusemtl skin\r\nf 1 2 \\\r\n4 3\r\n"
      "f 4 5 1 # forward\nv 0 0 0",
      MeshFormat::kObj);
  ASSERT_TRUE(soup.ok()) << soup.status();
  ASSERT_EQ(soup->positions.size(), 5u);
  EXPECT_EQ(soup->positions[0], Eigen::Vector3d(10000.123456789, -0.5, 1e-3));
  EXPECT_EQ(soup->positions[1], Eigen::Vector3d(1, 2, 3));
  EXPECT_THAT(soup->face_sizes, ElementsAre(3, 4, 4, 3));
  EXPECT_THAT(soup->face_vertices, ElementsAre(0, 1, 2, 3, 2, 1, 0, 0, 1, 3, 2, 3, 4, 0));
}

constexpr char kPlyBody[] =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string PlyHeader(const std::string& format, const std::string& body = kPlyBody) {
  return "ply\nformat " + format + " 1.0\ncomment by hand\n" + body;
}

TEST(ReadPlyTest, ReadsText) {
  const auto soup = Read(PlyHeader("ascii") + "0 0 0.1\n1 0 0\n0 1 0\n3 0 1 2", MeshFormat::kPly);
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->positions[0], Eigen::Vector3d(0, 0, 0.1));
  EXPECT_THAT(soup->face_sizes, IsEmpty());
  EXPECT_THAT(soup->face_vertices, ElementsAre(0, 1, 2));
}

// Other elements and properties, of every kind, before, between and behind those that count.
TEST(ReadPlyTest, ReadsBinaryOfBothByteOrdersPastWhatItDoesNotKnow) {
  for (const bool big : {false, true}) {
    std::string file =
        PlyHeader(big ? "binary_big_endian" : "binary_little_endian",
                  "obj_info x\nelement camera 2\nproperty short a\nproperty list char double b\n"
                  "element vertex 3\nproperty uchar red\nproperty double z\nproperty double x\n"
                  "property double y\nelement face 1\nproperty list uchar float uv\n"
                  "property list ushort uint vertex_index\nproperty int8 flag\nelement nothing 7\n"
                  "end_header\n");
    for (int camera = 0; camera < 2; ++camera) {
      file += Bytes<std::int16_t>(5, big) + Bytes<std::int8_t>(1, big) + Bytes(2.0, big);
    }
    for (int v = 0; v < 3; ++v) {
      file += Bytes<std::uint8_t>(9) + Bytes(v + 0.125, big) + Bytes(v + 0.25, big) +
              Bytes(0.1 * v, big);
    }
    file += Bytes<std::uint8_t>(1) + Bytes(0.5f, big) + Bytes<std::uint16_t>(3, big);
    for (const std::uint32_t v : {2u, 1u, 0u}) file += Bytes(v, big);
    file += Bytes<std::int8_t>(1);
    const auto soup = Read(file, MeshFormat::kPly);
    ASSERT_TRUE(soup.ok()) << soup.status();
    EXPECT_EQ(soup->positions[2], Eigen::Vector3d(2.25, 0.2, 2.125));
    EXPECT_THAT(soup->face_vertices, ElementsAre(2, 1, 0));
  }
}

std::string StlTriangle(const std::array<std::array<float, 3>, 3>& corners) {
  std::string bytes(12, '\0');
  for (const auto& corner : corners) {
    for (const float coordinate : corner) bytes += Bytes(coordinate);
  }
  return bytes + std::string(2, '\0');
}

TEST(ReadStlTest, ReadsBinaryAndMergesEqualCorners) {
  const std::string header = "solid is allowed here" + std::string(59, ' ');
  const std::string triangles = StlTriangle({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}) +
                                StlTriangle({{{0, 1, 0}, {1, 0, -0.0f}, {1, 1, 0.1f}}});
  const auto soup = Read(header + Bytes(2u) + triangles, MeshFormat::kStl);
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->positions.size(), 4u);
  EXPECT_EQ(soup->positions[3].z(), static_cast<double>(0.1f));
  EXPECT_THAT(soup->face_sizes, IsEmpty());
  EXPECT_THAT(soup->face_vertices, ElementsAre(0, 1, 2, 2, 1, 3));
}

constexpr char kTextTriangle[] =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0.1\n"
    " endloop\nendfacet\n";

TEST(ReadStlTest, ReadsText) {
  const auto soup =
      Read("solid a\n" + std::string(kTextTriangle) + kTextTriangle + "endsolid a\n\n",
           MeshFormat::kStl);
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->positions.size(), 3u);
  EXPECT_EQ(soup->positions[2].z(), 0.1);
  EXPECT_THAT(soup->face_vertices, ElementsAre(0, 1, 2, 0, 1, 2));
}

TEST(ReadOffTest, ReadsCommentsColoursAndPolygons) {
  const auto soup = Read(
      "COFF # colours\n\n# counts\n4 2 0\n0 0 0.1 255 0 0\n1 0 0 255 0 0\n\n1 1 0 0 0 0\n"
      "0 1 0 0 0 0\n4 0 1 2 3 1 1 1\r\n3 2 1 0\r\n",
      MeshFormat::kOff);
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->positions[0], Eigen::Vector3d(0, 0, 0.1));
  EXPECT_THAT(soup->face_sizes, ElementsAre(4, 3));
  EXPECT_THAT(soup->face_vertices, ElementsAre(0, 1, 2, 3, 2, 1, 0));
  EXPECT_TRUE(Read("OFF 1 0 0\n0 0 0\n", MeshFormat::kOff).ok());
}

}  // namespace
}  // namespace capfit::formats
