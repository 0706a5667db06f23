#include "core/mesh/read_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <string>

#include "core/base/status.h"

namespace capfit::mesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

absl::StatusOr<PolygonSoup> Read(const std::string& bytes, MeshFormat format,
                                 const MeshLimits& limits = {}) {
  return ReadMesh(std::as_bytes(std::span(bytes)), format, limits);
}

// The message of the refusal; the reason must be the file.
std::string ProblemOf(const std::string& bytes, MeshFormat format, const MeshLimits& limits = {}) {
  const absl::StatusOr<PolygonSoup> soup = Read(bytes, format, limits);
  if (soup.ok()) return "accepted";
  EXPECT_EQ(soup.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(FieldOf(soup.status()), "file");
  return std::string(soup.status().message());
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
  EXPECT_EQ(FormatFromFileName("body.gltf"), MeshFormat::kUnknown);
  EXPECT_EQ(FormatFromFileName("obj"), MeshFormat::kUnknown);
}

MeshFormat FormatOf(const std::string& bytes) {
  return FormatFromBytes(std::as_bytes(std::span(bytes)));
}

TEST(FormatTest, ComesFromTheFirstBytes) {
  EXPECT_EQ(FormatOf("ply\nformat ascii 1.0\n"), MeshFormat::kPly);
  EXPECT_EQ(FormatOf("glTF\2\0\0\0"), MeshFormat::kGlb);
  EXPECT_EQ(FormatOf("solid x\nfacet normal 0 0 1\n"), MeshFormat::kStl);
  EXPECT_EQ(FormatOf("solid, but binary" + std::string(63, ' ') + Bytes(1u) + std::string(50, 1)),
            MeshFormat::kStl);
  EXPECT_EQ(FormatOf("# made by hand\nSTOFF\n1 0 0\n"), MeshFormat::kOff);
  EXPECT_EQ(FormatOf("# Blender\nmtllib a.mtl\no body\nv 0 0 0\n"), MeshFormat::kObj);
  EXPECT_EQ(FormatOf("This is no mesh.\n"), MeshFormat::kUnknown);
  EXPECT_EQ(FormatOf(""), MeshFormat::kUnknown);
}

TEST(ReadMeshTest, FindsTheFormatAndRefusesWhatHasNone) {
  EXPECT_TRUE(Read("v 0 0 0\n", MeshFormat::kUnknown).ok());
  EXPECT_THAT(ProblemOf("plain prose", MeshFormat::kUnknown), HasSubstr("has no known format"));
  EXPECT_THAT(ProblemOf("", MeshFormat::kObj), HasSubstr("is empty"));
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

struct BadFile {
  const char* name;
  MeshFormat format;
  std::string bytes;
  const char* problem;
  friend void PrintTo(const BadFile& file, std::ostream* os) { *os << file.name; }
};
class BadFileTest : public testing::TestWithParam<BadFile> {};

TEST_P(BadFileTest, IsRefusedSayingWhereAndWhy) {
  EXPECT_THAT(ProblemOf(GetParam().bytes, GetParam().format), HasSubstr(GetParam().problem));
}

const std::string kObjVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

INSTANTIATE_TEST_SUITE_P(
    Obj, BadFileTest,
    testing::Values(
        BadFile{"Prose", MeshFormat::kObj, "This is not\na mesh.\n", "nothing to read"},
        BadFile{"NoNumber", MeshFormat::kObj, "v 0 0,5 0\n", "line 1: '0,5' is not a coordinate"},
        BadFile{"TooFewNumbers", MeshFormat::kObj, "\nv 0 0\n", "line 2: '' is not a coordinate"},
        BadFile{"TooLargeNumber", MeshFormat::kObj, "v 1e999 0 0\n", "'1e999'"},
        BadFile{"Unprintable", MeshFormat::kObj, "v \x01\x02 0 0\n", "'\?\?' is not"},
        BadFile{"IndexZero", MeshFormat::kObj, kObjVertices + "f 1 2 3\nf 1 0 2\n",
                "line 5: face 1 names vertex 0, OBJ counts from 1"},
        BadFile{"IndexTooHigh", MeshFormat::kObj, kObjVertices + "f 1 2 3\nf 1 2 4\n",
                "line 5: face 1 names vertex 4, but there are only 3"},
        BadFile{"IndexTooLow", MeshFormat::kObj, kObjVertices + "f -1 -2 -4\n",
                "line 4: face 0 names vertex -4, 3 are defined so far"},
        BadFile{"IndexBeyondAnyLimit", MeshFormat::kObj, kObjVertices + "f 1 2 99999999999\n",
                "names vertex 99999999999"},
        BadFile{"IndexNoNumber", MeshFormat::kObj, kObjVertices + "f a b c\n", "the corner 'a'"},
        BadFile{"TwoCorners", MeshFormat::kObj, kObjVertices + "f 1 2\n", "has 2 corners"}),
    [](const auto& test) { return test.param.name; });

TEST(ReadObjTest, RefusesMoreThanTheLimits) {
  MeshLimits limits;
  limits.max_vertices = 2;
  EXPECT_THAT(ProblemOf(kObjVertices, MeshFormat::kObj, limits),
              HasSubstr("line 3: more than 2 vertices"));
  limits.max_vertices = 3;
  limits.max_faces = 1;
  EXPECT_THAT(ProblemOf(kObjVertices + "f 1 2 3\nf 1 3 2\n", MeshFormat::kObj, limits),
              HasSubstr("line 5: more than 1 faces"));
  limits.max_corners_per_face = 3;
  EXPECT_THAT(ProblemOf(kObjVertices + "f 1 2 3 1\n", MeshFormat::kObj, limits),
              HasSubstr("more than 3 corners"));
}

// Faces of many corners are few bytes in a file and many triangles in memory.
TEST(ReadMeshTest, RefusesFacesOfTooManyTriangles) {
  MeshLimits limits;
  limits.max_faces = 2;  // four triangles
  const std::string six = "1 2 3 1 2 3";
  EXPECT_EQ(ProblemOf(kObjVertices + "f " + six + "\n", MeshFormat::kObj, limits), "accepted");
  EXPECT_THAT(ProblemOf(kObjVertices + "f " + six + "\nf 1 2 3\n", MeshFormat::kObj, limits),
              HasSubstr("line 5: the faces come to too many triangles"));
  const std::string seven = " 7 0 1 2 0 1 2 0\n";
  EXPECT_THAT(ProblemOf("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n" + seven, MeshFormat::kOff, limits),
              HasSubstr("must be at most 4 together"));
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_THAT(ProblemOf(ply + seven, MeshFormat::kPly, limits), HasSubstr("too many triangles"));
  EXPECT_THAT(ProblemOf(ply + "3.5 0 1 2\n", MeshFormat::kPly), HasSubstr("has 3.5 corners"));
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
  EXPECT_THAT(soup->face_sizes, ElementsAre(3));
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

const std::string kLittle = PlyHeader("binary_little_endian");

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

INSTANTIATE_TEST_SUITE_P(
    Ply, BadFileTest,
    testing::Values(
        BadFile{"NoPly", MeshFormat::kPly, "plain\n", "begins with the line 'ply'"},
        BadFile{"NoEndOfHeader", MeshFormat::kPly, "ply\nformat ascii 1.0\n",
                "before 'end_header'"},
        BadFile{"NoFormat", MeshFormat::kPly, "ply\nend_header\n", "no 'format' line"},
        BadFile{"BadFormat", MeshFormat::kPly, "ply\nformat binary 1.0\n", "line 2: bad 'format'"},
        BadFile{"BadKeyword", MeshFormat::kPly, "ply\nelephant\n", "line 2: unknown keyword"},
        BadFile{"BadCount", MeshFormat::kPly, "ply\nelement vertex -1\n", "bad 'element' line"},
        BadFile{"BadType", MeshFormat::kPly, "ply\nelement vertex 1\nproperty quad x\n",
                "line 3: bad 'property' line"},
        BadFile{"BadListType", MeshFormat::kPly, "ply\nelement v 1\nproperty list float int x\n",
                "line 3: bad type of a list's length"},
        BadFile{"PropertyFirst", MeshFormat::kPly, "ply\nproperty int x\n", "before 'element'"},
        BadFile{"NoVertices", MeshFormat::kPly, "ply\nformat ascii 1.0\nend_header\n",
                "no element 'vertex'"},
        BadFile{"NoCoordinates", MeshFormat::kPly,
                Replaced(PlyHeader("ascii"), "float y", "float v") + "0 0 0 0 0 0 0 0 0 3 0 1 2",
                "no properties x, y and z"},
        BadFile{"NoCornerList", MeshFormat::kPly,
                Replaced(kLittle, "vertex_indices", "corners") + std::string(60, '\0'),
                "no list vertex_indices"},
        BadFile{"Strips", MeshFormat::kPly,
                Replaced(kLittle, "element face", "element tristrips") + std::string(60, '\0'),
                "triangle strips"},
        BadFile{
            "HugeVertexCount", MeshFormat::kPly,
            Replaced(kLittle, "vertex 3", "vertex 18446744073709551615") + std::string(99, '\0'),
            "claims 18446744073709551615 records of at least 12 bytes, but only 99"},
        BadFile{"HugeFaceCount", MeshFormat::kPly,
                Replaced(kLittle, "face 1", "face 4000000000") + std::string(99, '\0'),
                "element 'face' claims 4000000000 records"},
        BadFile{"CutOff", MeshFormat::kPly,
                kLittle + std::string(36, '\0') + "\3" + std::string(11, '\0'),
                "ends early or has a bad value in record 0 of 1 of element 'face'"},
        BadFile{"ManyCorners", MeshFormat::kPly,
                "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                "property float z\nelement face 1\nproperty list int int vertex_indices\n"
                "end_header\n0 0 0\n1001 0 0 0\n",
                "face 0 has 1001 corners, must have at most 1000"},
        BadFile{"NegativeIndex", MeshFormat::kPly,
                kLittle + std::string(36, '\0') + "\3" + std::string(12, '\xff'),
                "face 0 names vertex -1"},
        BadFile{"TextIndexNoInteger", MeshFormat::kPly,
                PlyHeader("ascii") + "0 0 0 0 0 0 0 0 0 3 0 1 1.5", "face 0 names vertex 1.5"},
        BadFile{"TextNoNumber", MeshFormat::kPly, PlyHeader("ascii") + "0 0 0 0 0 x 0 0 0 3 0 1 2",
                "in record 1 of 3 of element"}),
    [](const auto& test) { return test.param.name; });

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

INSTANTIATE_TEST_SUITE_P(
    Stl, BadFileTest,
    testing::Values(
        BadFile{"Short", MeshFormat::kStl, "no", "is neither a text STL"},
        BadFile{"HugeCount", MeshFormat::kStl,
                std::string(80, ' ') + Bytes(0xFFFFFFFFu) + std::string(50, '\0'),
                "claims 4294967295 triangles, which take 214748364834 bytes, but has only 134"},
        BadFile{"CutOff", MeshFormat::kStl,
                std::string(80, ' ') + Bytes(2u) + std::string(99, '\0'), "ends early"},
        BadFile{"NoTriangles", MeshFormat::kStl, std::string(80, ' ') + Bytes(0u), "no triangles"},
        BadFile{"TextCutOff", MeshFormat::kStl, "solid a\n" + std::string(kTextTriangle),
                "before 'endsolid'"},
        BadFile{"TextEmpty", MeshFormat::kStl, "solid a\nendsolid a\n", "no triangles"},
        BadFile{
            "TextTwoVertices", MeshFormat::kStl,
            Replaced("solid a\n" + std::string(kTextTriangle) + "endsolid", "  vertex 1 0 0\n", ""),
            "a loop must have three vertices"},
        BadFile{"TextFourVertices", MeshFormat::kStl,
                Replaced("solid a\n" + std::string(kTextTriangle) + "endsolid", " endloop",
                         " vertex 0 0 0\n endloop"),
                "a loop must have three vertices"},
        BadFile{"TextNoNumber", MeshFormat::kStl,
                Replaced("solid a\n" + std::string(kTextTriangle) + "endsolid", "1 0 0", "1 O 0"),
                "line 5: a vertex must have three coordinates"}),
    [](const auto& test) { return test.param.name; });

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

const std::string kOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";

INSTANTIATE_TEST_SUITE_P(
    Off, BadFileTest,
    testing::Values(
        BadFile{"NoKeyword", MeshFormat::kOff, "1 0 0\n0 0 0\n", "begins with 'OFF'"},
        BadFile{"FourDimensions", MeshFormat::kOff, "4OFF\n1 0 0\n", "begins with 'OFF'"},
        BadFile{"Binary", MeshFormat::kOff, "OFF BINARY\n", "binary OFF is not read"},
        BadFile{"NoCounts", MeshFormat::kOff, "OFF\n", "numbers of vertices and faces"},
        BadFile{"HugeCount", MeshFormat::kOff, "OFF\n9999999999999 1 0\n", "claims 9999999999999"},
        BadFile{"CountsBeyondTheFile", MeshFormat::kOff, "OFF\n1000 1000 0\n0 0 0\n",
                "ends early: it claims 1000 vertices and 1000 faces, which take at least 8000"},
        BadFile{"NoVertices", MeshFormat::kOff, "OFF\n0 0 0\n", "no vertices"},
        BadFile{"CutOffVertices", MeshFormat::kOff, "OFF\n2 0 0\n0 0 0.0000000\n",
                "vertex 1 of 2 must have three coordinates"},
        BadFile{"CutOffFaces", MeshFormat::kOff, kOff + "     ", "face 0 of 1 is missing"},
        BadFile{"IndexTooHigh", MeshFormat::kOff, kOff + "3 0 1 3\n",
                "line 6: corner 2 of face 0 must be below 3"},
        BadFile{"IndexNegative", MeshFormat::kOff, kOff + "3 0 -1 2\n", "corner 1 of face 0"},
        BadFile{"TooFewCorners", MeshFormat::kOff, kOff + "4 0 1 2\n", "corner 3 of face 0"},
        BadFile{"TooManyCorners", MeshFormat::kOff, kOff + "4000000000 0 1 2\n",
                "face 0 has 4000000000 corners"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace capfit::mesh
