// Every refusal of a mesh: the reason, the place and the figures that programs get, the message
// that people read. (GLB files: read_glb_test.cc.)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "core/formats/read_mesh.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/core/mesh/soups.h"
#include "tests/support/told.h"

namespace capfit::formats {
namespace {

using mesh::Cube;
using mesh::PrepareMesh;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <typename Value>
std::string Raw(Value value) {
  std::string bytes(sizeof(Value), '\0');
  std::memcpy(bytes.data(), &value, sizeof(Value));
  return bytes;
}

std::string Floats(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) bytes += Raw(value);
  return bytes;
}

std::string Times(int times, const std::string& text) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

MeshLimits AtMost(std::size_t vertices, std::size_t faces, std::size_t corners = 1000) {
  MeshLimits limits;
  limits.max_vertices = vertices;
  limits.max_faces = faces;
  limits.max_corners_per_face = corners;
  return limits;
}

const std::string kObjVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string kOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";

// PLY: headers of nine lines.
const std::string kPlyVertices =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPlyFaces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kText = "ply\nformat ascii 1.0\n" + kPlyVertices + kPlyFaces + "end_header\n";
const std::string kLittle =
    "ply\nformat binary_little_endian 1.0\n" + kPlyVertices + kPlyFaces + "end_header\n";
const std::string kFacesFirst =
    "ply\nformat binary_little_endian 1.0\n" + kPlyFaces + kPlyVertices + "end_header\n";

std::string Corners(const std::vector<std::uint32_t>& corners) {
  std::string bytes(1, static_cast<char>(corners.size()));
  for (const std::uint32_t corner : corners) bytes += Raw(corner);
  return bytes;
}

const std::string kStlHeader(80, ' ');
std::string RawTriangle(const std::vector<float>& corners) {
  return std::string(12, '\0') + Floats(corners) + std::string(2, '\0');
}
const std::string kStlTriangle = RawTriangle({0, 0, 0, 1, 0, 0, 0, 1, 0});
const std::string kStlLoop =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0.1\n"
    " endloop\nendfacet\n";
const std::string kStlText = "solid a\n" + kStlLoop + "endsolid";

struct Refused {
  const char* name;
  MeshFormat format;
  std::string bytes;
  const char* told;
  MeshLimits limits = {};
  friend void PrintTo(const Refused& refused, std::ostream* os) { *os << refused.name; }
};

std::string NameOf(const testing::TestParamInfo<Refused>& test) { return test.param.name; }

class FileRefusalTest : public testing::TestWithParam<Refused> {};

TEST_P(FileRefusalTest, TellsReasonPlaceFiguresAndMessage) {
  const auto soup =
      ReadMesh(std::as_bytes(std::span(GetParam().bytes)), GetParam().format, GetParam().limits);
  EXPECT_EQ(Told(soup.status()), GetParam().told);
  EXPECT_EQ(FieldOf(soup.status()), "mesh.file");
  EXPECT_EQ(soup.status().code(), absl::StatusCode::kInvalidArgument);
}

INSTANTIATE_TEST_SUITE_P(
    Any, FileRefusalTest,
    testing::Values(Refused{"Empty", MeshFormat::kObj, "", "MISSING mesh.file is empty"},
                    Refused{"UnknownFormat", MeshFormat::kUnknown, "plain prose",
                            "UNSUPPORTED_FILE mesh.file has no known format: give an OBJ, PLY, "
                            "STL, OFF, GLB, VRM or glTF file"}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    Obj, FileRefusalTest,
    testing::Values(
        Refused{"Prose", MeshFormat::kObj, "This is not\na mesh.\n",
                "MISSING mesh.file holds nothing to read: an OBJ file has lines 'v x y z'"},
        Refused{"NoNumber", MeshFormat::kObj, "v 0 0,5 0\n",
                "MALFORMED_FILE [line=1] mesh.file line 1: y is '0,5', must be a number"},
        Refused{"TooFewNumbers", MeshFormat::kObj, "\nv 0 0\n",
                "MALFORMED_FILE [line=2] mesh.file line 2: z is missing"},
        Refused{"NotANumber", MeshFormat::kObj, "v 0 0 0\nv 0 0 nan\n",
                "NOT_FINITE [value=nan, limit=finite, line=2] mesh.file line 2: z is nan, must be "
                "finite"},
        Refused{"Infinite", MeshFormat::kObj, "v 0 0 0\n\n# far\nv -inf 0 0\n",
                "NOT_FINITE [value=-inf, limit=finite, line=4] mesh.file line 4: x is -inf, must "
                "be finite"},
        Refused{"TooFar", MeshFormat::kObj, "v 0 1e300 0\n",
                "OUT_OF_RANGE [value=1e+300, limit=[-1e+12, 1e+12], line=1] mesh.file line 1: y is "
                "1e+300, must be in [-1e+12, 1e+12]"},
        Refused{"BeyondADouble", MeshFormat::kObj, "v 1e999 0 0\n",
                "OUT_OF_RANGE [value=1e999, limit=[-1e+12, 1e+12], line=1] mesh.file line 1: x is "
                "1e999, must be in [-1e+12, 1e+12]"},
        Refused{"Unprintable", MeshFormat::kObj, "v \x01\x02 0 0\n",
                "MALFORMED_FILE [line=1] mesh.file line 1: x is '?\?', must be a number"},
        Refused{"LongWord", MeshFormat::kObj, "v " + std::string(99, 'a') + " 0 0\n",
                "MALFORMED_FILE [line=1] mesh.file line 1: x is 'aaaaaaaaaaaaaaaaaaaa...', must be "
                "a number"},
        Refused{"IndexZero", MeshFormat::kObj, kObjVertices + "f 1 2 3\nf 1 0 2\n",
                "OUT_OF_RANGE [value=0, limit=[1, 2000000], line=5] mesh.file line 5: a corner of "
                "face 1 is 0, must be in [1, 2000000]"},
        Refused{"IndexTooHigh", MeshFormat::kObj, kObjVertices + "f 1 2 3\nf 1 2 4\n",
                "OUT_OF_RANGE [value=4, limit=[1, 3], line=5] mesh.file line 5: a corner of face 1 "
                "is 4, must be in [1, 3]"},
        Refused{"IndexTooHighOnAContinuedLine", MeshFormat::kObj, kObjVertices + "f 1 \\\n2 4\n",
                "OUT_OF_RANGE [value=4, limit=[1, 3], line=5] mesh.file line 5: a corner of face 0 "
                "is 4, must be in [1, 3]"},
        Refused{"IndexTooLow", MeshFormat::kObj, kObjVertices + "f -1 -2 -4\n",
                "OUT_OF_RANGE [value=-4, limit=[-3, -1], line=4] mesh.file line 4: a corner of "
                "face 0 is -4, must be in [-3, -1]"},
        Refused{"IndexBelowNothing", MeshFormat::kObj, "f -1 -2 -3\n" + kObjVertices,
                "OUT_OF_RANGE [value=-1, limit=[1, 2000000], line=1] mesh.file line 1: a corner of "
                "face 0 is -1, must be in [1, 2000000]"},
        Refused{"IndexBeyondAnyLimit", MeshFormat::kObj, kObjVertices + "f 1 2 99999999999\n",
                "OUT_OF_RANGE [value=99999999999, limit=[1, 2000000], line=4] mesh.file line 4: a "
                "corner of face 0 is 99999999999, must be in [1, 2000000]"},
        Refused{"IndexBeyondAnyNumber", MeshFormat::kObj,
                kObjVertices + "f 1 2 99999999999999999999\n",
                "OUT_OF_RANGE [value=99999999999999999999, limit=[1, 2000000], line=4] mesh.file "
                "line 4: a corner of face 0 is 99999999999999999999, must be in [1, 2000000]"},
        Refused{"IndexNoNumber", MeshFormat::kObj, kObjVertices + "f a b c\n",
                "MALFORMED_FILE [line=4] mesh.file line 4: a corner of face 0 is 'a', must be a "
                "whole number"},
        Refused{"IndexMissing", MeshFormat::kObj, kObjVertices + "f 1 /2 3\n",
                "MALFORMED_FILE [line=4] mesh.file line 4: a corner of face 0 is '/2', must be a "
                "whole number"},
        Refused{"TwoCorners", MeshFormat::kObj, kObjVertices + "f 1 2\n",
                "MALFORMED_FILE [value=2, limit=[3, 1000], line=4] mesh.file line 4: face 0 has 2 "
                "corners, must have at least 3"},
        Refused{"ManyVertices", MeshFormat::kObj, kObjVertices,
                "TOO_LARGE [value=3, limit=2, line=3] mesh.file line 3: brings the file to 3 "
                "vertices, must have at most 2",
                AtMost(2, 9)},
        Refused{"ManyFaces", MeshFormat::kObj, kObjVertices + "f 1 2 3\nf 1 3 2\n",
                "TOO_LARGE [value=2, limit=1, line=5] mesh.file line 5: brings the file to 2 "
                "faces, must have at most 1",
                AtMost(3, 1)},
        Refused{
            "ManyCorners", MeshFormat::kObj, kObjVertices + "f 1 2 3 1\n",
            "TOO_LARGE [value=4, limit=3, line=4] mesh.file line 4: face 0 has more than 3 corners",
            AtMost(3, 1, 3)},
        Refused{"ManyTriangles", MeshFormat::kObj, kObjVertices + "f 1 2 3 1 2 3\nf 1 2 3\n",
                "TOO_LARGE [limit=4, line=5] mesh.file line 5: the faces come to too many "
                "triangles: faces of n corners make n - 2 each, must be at most 4 together",
                AtMost(3, 2)}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    Off, FileRefusalTest,
    testing::Values(
        Refused{"NoKeyword", MeshFormat::kOff, "1 0 0\n0 0 0\n",
                "MALFORMED_FILE [line=1] mesh.file line 1: an OFF file begins with 'OFF'"},
        Refused{"FourDimensions", MeshFormat::kOff, "4OFF\n1 0 0\n",
                "MALFORMED_FILE [line=1] mesh.file line 1: an OFF file begins with 'OFF'"},
        Refused{"Binary", MeshFormat::kOff, "OFF BINARY\n",
                "UNSUPPORTED_FILE [line=1] mesh.file line 1: binary OFF is not read; send text OFF "
                "or binary PLY"},
        Refused{"NoCounts", MeshFormat::kOff, "OFF\n",
                "MALFORMED_FILE [line=1] mesh.file line 1: the numbers of vertices and faces are "
                "missing"},
        Refused{"ManyVertices", MeshFormat::kOff, "OFF\n9999999999999 1 0\n",
                "TOO_LARGE [value=9999999999999, limit=2000000, line=2] mesh.file line 2: brings "
                "the file to 9999999999999 vertices, must have at most 2000000"},
        Refused{"ManyFaces", MeshFormat::kOff, "OFF\n1 9999999999999 0\n",
                "TOO_LARGE [value=9999999999999, limit=2000000, line=2] mesh.file line 2: brings "
                "the file to 9999999999999 faces, must have at most 2000000"},
        Refused{"CountsBeyondTheFile", MeshFormat::kOff, "OFF\n1000 1000 0\n0 0 0\n",
                "MALFORMED_FILE [value=8000, limit=6, line=2] mesh.file line 2: the file ends "
                "early: it claims 1000 vertices and 1000 faces, which take at least 8000 bytes, "
                "but only 6 follow"},
        Refused{"NoVertices", MeshFormat::kOff, "OFF\n0 0 0\n",
                "MISSING [line=2] mesh.file line 2: the file has no vertices"},
        Refused{"CutOffVertices", MeshFormat::kOff, "OFF\n2 0 0\n0 0 0.0000000\n",
                "MALFORMED_FILE [value=2, limit=1, line=3] mesh.file line 3: the file ends early: "
                "it claims 2 vertices, but has only 1"},
        Refused{"CutOffFaces", MeshFormat::kOff, kOff + "     ",
                "MALFORMED_FILE [value=1, limit=0, line=6] mesh.file line 6: the file ends early: "
                "it claims 1 faces, but has only 0"},
        Refused{"NoNumber", MeshFormat::kOff, "OFF\n1 0 0\n0 0,5 0\n",
                "MALFORMED_FILE [line=3] mesh.file line 3: y is '0,5', must be a number"},
        Refused{"NotANumber", MeshFormat::kOff, "OFF # c\n\n1 0 0\n# d\n0 0 NaN\n",
                "NOT_FINITE [value=nan, limit=finite, line=5] mesh.file line 5: z is nan, must be "
                "finite"},
        Refused{"Infinite", MeshFormat::kOff, "OFF\n1 0 0\ninf 0 0\n",
                "NOT_FINITE [value=inf, limit=finite, line=3] mesh.file line 3: x is inf, must be "
                "finite"},
        Refused{"TooFar", MeshFormat::kOff, "OFF\n1 0 0\n0 -2e12 0\n",
                "OUT_OF_RANGE [value=-2e+12, limit=[-1e+12, 1e+12], line=3] mesh.file line 3: y is "
                "-2e+12, must be in [-1e+12, 1e+12]"},
        Refused{"IndexTooHigh", MeshFormat::kOff, kOff + "3 0 1 3\n",
                "OUT_OF_RANGE [value=3, limit=[0, 3), line=6] mesh.file line 6: a corner of face 0 "
                "is 3, must be in [0, 3)"},
        Refused{"IndexNegative", MeshFormat::kOff, kOff + "3 0 -1 2\n",
                "OUT_OF_RANGE [value=-1, limit=[0, 3), line=6] mesh.file line 6: a corner of face "
                "0 is -1, must be in [0, 3)"},
        Refused{"IndexNoNumber", MeshFormat::kOff, kOff + "3 0 1.5 2\n",
                "MALFORMED_FILE [line=6] mesh.file line 6: a corner of face 0 is '1.5', must be a "
                "whole number"},
        Refused{"TooFewCorners", MeshFormat::kOff, kOff + "4 0 1 2\n",
                "MALFORMED_FILE [line=6] mesh.file line 6: a corner of face 0 is missing"},
        Refused{"SizeNoNumber", MeshFormat::kOff, kOff + "-3 0 1 2\n",
                "MALFORMED_FILE [line=6] mesh.file line 6: the size of face 0 is '-3', must be a "
                "whole number"},
        Refused{"ManyCorners", MeshFormat::kOff, kOff + "4000000000 0 1 2\n",
                "TOO_LARGE [value=4000000000, limit=1000, line=6] mesh.file line 6: face 0 has "
                "4000000000 corners, must have at most 1000"},
        Refused{"ManyTriangles", MeshFormat::kOff, kOff + "7 0 1 2 0 1 2 0\n",
                "TOO_LARGE [limit=4, line=6] mesh.file line 6: the faces come to too many "
                "triangles: faces of n corners make n - 2 each, must be at most 4 together",
                AtMost(3, 2)}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    PlyHeader, FileRefusalTest,
    testing::Values(
        Refused{"NoPly", MeshFormat::kPly, "plain\n",
                "MALFORMED_FILE [line=1] mesh.file line 1: a PLY file begins with the line 'ply'"},
        Refused{"NoEnd", MeshFormat::kPly, "ply\nformat ascii 1.0\n",
                "MALFORMED_FILE [line=2] mesh.file line 2: the file ends before 'end_header'"},
        Refused{"NoFormat", MeshFormat::kPly, "ply\nend_header\n",
                "MALFORMED_FILE [line=2] mesh.file line 2: the header has no 'format' line"},
        Refused{"UnknownFormat", MeshFormat::kPly, "ply\nformat binary 1.0\n",
                "UNSUPPORTED_FILE [value=binary, limit=ascii, binary_little_endian, "
                "binary_big_endian, line=2] mesh.file line 2: the format is 'binary', must be one "
                "of ascii, binary_little_endian, binary_big_endian"},
        Refused{"TwoFormats", MeshFormat::kPly, "ply\nformat ascii 1.0\nformat ascii 1.0\n",
                "MALFORMED_FILE [line=3] mesh.file line 3: the header has two 'format' lines"},
        Refused{"UnknownKeyword", MeshFormat::kPly, "ply\nelephant\n",
                "MALFORMED_FILE [line=2] mesh.file line 2: unknown keyword in the header"},
        Refused{"BadCount", MeshFormat::kPly, "ply\nelement vertex -1\n",
                "MALFORMED_FILE [line=2] mesh.file line 2: bad 'element' line"},
        Refused{"BadType", MeshFormat::kPly, "ply\nelement vertex 1\nproperty quad x\n",
                "MALFORMED_FILE [line=3] mesh.file line 3: bad 'property' line"},
        Refused{"BadListType", MeshFormat::kPly, "ply\nelement v 1\nproperty list float int x\n",
                "MALFORMED_FILE [line=3] mesh.file line 3: bad type of a list's length"},
        Refused{"PropertyFirst", MeshFormat::kPly, "ply\nproperty int x\n",
                "MALFORMED_FILE [line=2] mesh.file line 2: 'property' comes before 'element'"},
        Refused{"ManyElements", MeshFormat::kPly, "ply\n" + Times(33, "element a 1\n"),
                "TOO_LARGE [value=33, limit=32, line=34] mesh.file line 34: brings the file to 33 "
                "elements, must have at most 32"},
        Refused{"ManyProperties", MeshFormat::kPly,
                "ply\nelement a 1\n" + Times(257, "property int x\n"),
                "TOO_LARGE [value=257, limit=256, line=259] mesh.file line 259: brings the file to "
                "257 properties of one element, must have at most 256"},
        Refused{"NoVertices", MeshFormat::kPly, "ply\nformat ascii 1.0\nend_header\n",
                "MISSING mesh.file has no vertices: no records of element 'vertex'"},
        Refused{"NoCoordinates", MeshFormat::kPly,
                Replaced(kText, "float y", "float v") + "0 0 0 0 0 0 0 0 0 3 0 1 2",
                "MALFORMED_FILE [element=vertex] mesh.file element 'vertex': must have the "
                "properties x, y and z, each once"},
        Refused{"NoCornerList", MeshFormat::kPly,
                Replaced(kLittle, "vertex_indices", "corners") + std::string(60, '\0'),
                "MALFORMED_FILE [element=face] mesh.file element 'face': must have one list "
                "vertex_indices of whole numbers"},
        Refused{"TwoVertexElements", MeshFormat::kPly,
                Replaced(kText, "element face 1\nproperty list uchar int vertex_indices",
                         "element vertex 1\nproperty float x") +
                    "0 0 0 0 0 0 0 0 0 7",
                "MALFORMED_FILE [element=vertex] mesh.file element 'vertex': the file has two of "
                "these"},
        Refused{
            "TwoFaceElements", MeshFormat::kPly,
            Replaced(kText, "end_header",
                     "element face 1\nproperty list uchar int vertex_index\nend_header") +
                "0 0 0 0 0 0 0 0 0 3 0 1 2 3 0 1 2",
            "MALFORMED_FILE [element=face] mesh.file element 'face': the file has two of these"},
        Refused{"Strips", MeshFormat::kPly,
                Replaced(kLittle, "element face", "element tristrips") + std::string(60, '\0'),
                "UNSUPPORTED_FILE [element=tristrips] mesh.file element 'tristrips': triangle "
                "strips are not read, store an element 'face' instead"},
        Refused{
            "HugeVertexCount", MeshFormat::kPly,
            Replaced(kLittle, "vertex 3", "vertex 18446744073709551615") + std::string(99, '\0'),
            "MALFORMED_FILE [value=18446744073709551615, limit=8, element=vertex] mesh.file "
            "element 'vertex': the file ends early: it claims 18446744073709551615 records of at "
            "least 12 bytes, but only 99 bytes follow"},
        Refused{"HugeFaceCount", MeshFormat::kPly,
                Replaced(kLittle, "face 1", "face 4000000000") + std::string(99, '\0'),
                "MALFORMED_FILE [value=4000000000, limit=64, element=face] mesh.file element "
                "'face': the file ends early: it claims 4000000000 records of at least 1 bytes, "
                "but only 63 bytes follow"},
        Refused{
            "UnprintableElement", MeshFormat::kPly,
            Replaced(kLittle, "element face 1", "element f\xe4 9") + std::string(36, '\0'),
            "MALFORMED_FILE [value=9, limit=1, element=f\uFFFD] mesh.file element 'f\uFFFD': the "
            "file ends early: it claims 9 records of at least 1 bytes, but only 0 bytes follow"},
        Refused{"ManyVertices", MeshFormat::kPly, kLittle + std::string(99, '\0'),
                "TOO_LARGE [value=3, limit=2, element=vertex] mesh.file element 'vertex': brings "
                "the file to 3 vertices, must have at most 2",
                AtMost(2, 9)},
        Refused{"ManyFaces", MeshFormat::kPly,
                Replaced(kLittle, "face 1", "face 2") + std::string(99, '\0'),
                "TOO_LARGE [value=2, limit=1, element=face] mesh.file element 'face': brings the "
                "file to 2 faces, must have at most 1",
                AtMost(3, 1)}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    PlyText, FileRefusalTest,
    testing::Values(
        Refused{"NoNumber", MeshFormat::kPly, kText + "0 0 0\n0 0 x\n0 0 0\n3 0 1 2\n",
                "MALFORMED_FILE [line=11] mesh.file line 11: z is 'x', must be a number"},
        Refused{"NotANumber", MeshFormat::kPly, kText + "0 0 0\n\n0 nan 0\n0 0 0\n3 0 1 2\n",
                "NOT_FINITE [value=nan, limit=finite, line=12] mesh.file line 12: y is nan, must "
                "be finite"},
        Refused{"TooFar", MeshFormat::kPly, kText + "0 0 0\n0 1e300 0\n0 0 0\n3 0 1 2\n",
                "OUT_OF_RANGE [value=1e+300, limit=[-1e+12, 1e+12], line=11] mesh.file line 11: y "
                "is 1e+300, must be in [-1e+12, 1e+12]"},
        Refused{"BeyondADouble", MeshFormat::kPly, kText + "0 0 0\n0 0 -1e999\n0 0 0\n3 0 1 2\n",
                "OUT_OF_RANGE [value=-1e999, limit=[-1e+12, 1e+12], line=11] mesh.file line 11: z "
                "is -1e999, must be in [-1e+12, 1e+12]"},
        Refused{"CutOffVertices", MeshFormat::kPly,
                Replaced(kText, "face 1", "face 0") + "0 0 0 \n  0 0.0000000000000\n\n",
                "MALFORMED_FILE [value=3, limit=1, line=11] mesh.file line 11: the file ends "
                "early: it claims 3 records of element 'vertex', but has only 1"},
        Refused{"CutOffFaces", MeshFormat::kPly, kText + "0 0 0\n1 0 0\n0 1 0\n3 0 1",
                "MALFORMED_FILE [value=1, limit=0, line=13] mesh.file line 13: the file ends "
                "early: it claims 1 records of element 'face', but has only 0"},
        Refused{"SizeNoNumber", MeshFormat::kPly, kText + "0 0 0\n1 0 0\n0 1 0\nthree 0 1 2\n",
                "MALFORMED_FILE [line=13] mesh.file line 13: a value is 'three', must be a number"},
        Refused{"SizeNotWhole", MeshFormat::kPly, kText + "0 0 0\n1 0 0\n0 1 0\n3.5 0 1 2\n",
                "MALFORMED_FILE [value=3.5, limit=1000, line=13] mesh.file line 13: face 0 has 3.5 "
                "corners, must have a whole number of at most 1000"},
        Refused{"SizeNegative", MeshFormat::kPly, kText + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n",
                "MALFORMED_FILE [value=-3, limit=1000, line=13] mesh.file line 13: face 0 has -3 "
                "corners, must have a whole number of at most 1000"},
        Refused{"ManyCorners", MeshFormat::kPly, kText + "0 0 0\n1 0 0\n0 1 0\n1001 0 1 2\n",
                "TOO_LARGE [value=1001, limit=1000, line=13] mesh.file line 13: face 0 has 1001 "
                "corners, must have at most 1000"},
        Refused{"ManyTriangles", MeshFormat::kPly, kText + "0 0 0\n1 0 0\n0 1 0\n7 0 1 2 0 1 2 0\n",
                "TOO_LARGE [limit=4, line=13] mesh.file line 13: the faces come to too many "
                "triangles: faces of n corners make n - 2 each, must be at most 4 together",
                AtMost(3, 2)},
        Refused{"IndexTooHigh", MeshFormat::kPly, kText + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
                "OUT_OF_RANGE [value=3, limit=[0, 3), line=13] mesh.file line 13: a corner of face "
                "0 is 3, must be in [0, 3)"},
        Refused{"IndexNegative", MeshFormat::kPly, kText + "0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n",
                "OUT_OF_RANGE [value=-1, limit=[0, 3), line=13] mesh.file line 13: a corner of "
                "face 0 is -1, must be in [0, 3)"},
        Refused{"IndexNotWhole", MeshFormat::kPly, kText + "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n",
                "MALFORMED_FILE [value=1.5, limit=[0, 3), line=13] mesh.file line 13: a corner of "
                "face 0 is 1.5, must be a whole number"},
        Refused{"IndexNoNumber", MeshFormat::kPly, kText + "0 0 0\n1 0 0\n0 1 0\n3 0 1 b\n",
                "MALFORMED_FILE [line=13] mesh.file line 13: a value is 'b', must be a number"},
        Refused{"OtherNoNumber", MeshFormat::kPly,
                Replaced(kText, "element vertex 3",
                         "element camera 1\nproperty float a\nelement vertex 3") +
                    "wide\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                "MALFORMED_FILE [line=12] mesh.file line 12: a value is 'wide', must be a number"},
        Refused{"OtherListNegative", MeshFormat::kPly,
                Replaced(kText, "element vertex 3",
                         "element camera 1\nproperty list int int a\nelement vertex 3") +
                    "-1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                "MALFORMED_FILE [line=12] mesh.file line 12: a list has a negative length"}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    PlyBinary, FileRefusalTest,
    testing::Values(
        Refused{"NotANumber", MeshFormat::kPly,
                kLittle + Floats({0, 0, 0, 0, kNan, 0, 0, 0, 0}) + Corners({0, 1, 2}),
                "NOT_FINITE [value=nan, limit=finite, element=vertex, row=1] mesh.file element "
                "'vertex' row 1: y is nan, must be finite"},
        Refused{"Infinite", MeshFormat::kPly,
                kLittle + Floats({0, 0, 0, 0, 0, 0, 0, 0, -kInfinity}) + Corners({0, 1, 2}),
                "NOT_FINITE [value=-inf, limit=finite, element=vertex, row=2] mesh.file element "
                "'vertex' row 2: z is -inf, must be finite"},
        Refused{"TooFar", MeshFormat::kPly,
                kLittle + Floats({0, 0, 0, 2e12F, 0, 0, 0, 0, 0}) + Corners({0, 1, 2}),
                "OUT_OF_RANGE [value=2e+12, limit=[-1e+12, 1e+12], element=vertex, row=1] "
                "mesh.file element 'vertex' row 1: x is 2e+12, must be in [-1e+12, 1e+12]"},
        Refused{
            "CutOff", MeshFormat::kPly,
            kLittle + std::string(36, '\0') + "\3" + std::string(11, '\0'),
            "MALFORMED_FILE [value=1, limit=0, element=face, row=0] mesh.file element 'face' row "
            "0: the file ends early: it claims 1 records of element 'face', but has only 0"},
        Refused{"IndexTooHigh", MeshFormat::kPly,
                kLittle + std::string(36, '\0') + Corners({0, 1, 3}),
                "OUT_OF_RANGE [value=3, limit=[0, 3), element=face, row=0] mesh.file element "
                "'face' row 0: a corner of face 0 is 3, must be in [0, 3)"},
        Refused{"IndexNegative", MeshFormat::kPly,
                kLittle + std::string(36, '\0') + Corners({0, 0xFFFFFFFF, 2}),
                "OUT_OF_RANGE [value=-1, limit=[0, 3), element=face, row=0] mesh.file element "
                "'face' row 0: a corner of face 0 is -1, must be in [0, 3)"},
        Refused{"IndexTooHighBeforeTheVertices", MeshFormat::kPly,
                kFacesFirst + Corners({0, 1, 3}) + std::string(36, '\0'),
                "OUT_OF_RANGE [value=3, limit=[0, 3), element=face, row=0] mesh.file element "
                "'face' row 0: a corner of face 0 is 3, must be in [0, 3)"},
        Refused{"SizeNegative", MeshFormat::kPly,
                Replaced(kLittle, "list uchar", "list char") + std::string(36, '\0') + "\xff" +
                    std::string(12, '\0'),
                "MALFORMED_FILE [value=-1, limit=1000, element=face, row=0] mesh.file element "
                "'face' row 0: face 0 has -1 corners, must have a whole number of at most 1000"},
        Refused{"ManyCorners", MeshFormat::kPly,
                Replaced(kLittle, "list uchar", "list uint") + std::string(36, '\0') +
                    "\xff\xff\xff\xff" + std::string(12, '\0'),
                "TOO_LARGE [value=4294967295, limit=1000, element=face, row=0] mesh.file element "
                "'face' row 0: face 0 has 4294967295 corners, must have at most 1000"},
        Refused{"OtherListNegative", MeshFormat::kPly,
                Replaced(kLittle, "property list", "property list char int uv\nproperty list") +
                    std::string(36, '\0') + "\xff" + std::string(12, '\0'),
                "MALFORMED_FILE [element=face, row=0] mesh.file element 'face' row 0: a list has a "
                "negative length"}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    StlBinary, FileRefusalTest,
    testing::Values(
        Refused{"Short", MeshFormat::kStl, "no",
                "MALFORMED_FILE mesh.file is neither a text STL ('solid ...') nor has it the 84 "
                "bytes that begin a binary one"},
        Refused{"HugeCount", MeshFormat::kStl,
                kStlHeader + Raw(0xFFFFFFFFu) + std::string(50, '\0'),
                "MALFORMED_FILE [value=214748364834, limit=134] mesh.file ends early: it claims "
                "4294967295 triangles, which take 214748364834 bytes, but has only 134"},
        Refused{"CutOff", MeshFormat::kStl, kStlHeader + Raw(2u) + std::string(99, '\0'),
                "MALFORMED_FILE [value=184, limit=183] mesh.file ends early: it claims 2 "
                "triangles, which take 184 bytes, but has only 183"},
        Refused{"NoTriangles", MeshFormat::kStl, kStlHeader + Raw(0u),
                "MISSING mesh.file has no triangles"},
        Refused{"NotANumber", MeshFormat::kStl,
                kStlHeader + Raw(2u) + kStlTriangle + RawTriangle({0, 0, 0, 1, 0, 0, 0, kNan, 0}),
                "NOT_FINITE [value=nan, limit=finite, element=triangle, row=1] mesh.file triangle "
                "1 corner 2: y is nan, must be finite"},
        Refused{"Infinite", MeshFormat::kStl,
                kStlHeader + Raw(1u) + RawTriangle({0, 0, kInfinity, 1, 0, 0, 0, 1, 0}),
                "NOT_FINITE [value=inf, limit=finite, element=triangle, row=0] mesh.file triangle "
                "0 corner 0: z is inf, must be finite"},
        Refused{"TooFar", MeshFormat::kStl,
                kStlHeader + Raw(2u) + kStlTriangle + RawTriangle({0, 0, 0, 1, 0, 0, 0, 1, -2e12F}),
                "OUT_OF_RANGE [value=-2e+12, limit=[-1e+12, 1e+12], element=triangle, row=1] "
                "mesh.file triangle 1 corner 2: z is -2e+12, must be in [-1e+12, 1e+12]"},
        Refused{"ManyVertices", MeshFormat::kStl, kStlHeader + Raw(1u) + kStlTriangle,
                "TOO_LARGE [value=3, limit=2] mesh.file has 3 vertices, must have at most 2",
                AtMost(2, 9)},
        Refused{"ManyFaces", MeshFormat::kStl, kStlHeader + Raw(2u) + kStlTriangle + kStlTriangle,
                "TOO_LARGE [value=2, limit=1] mesh.file has 2 faces, must have at most 1",
                AtMost(9, 1)}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    StlText, FileRefusalTest,
    testing::Values(
        Refused{"CutOff", MeshFormat::kStl, "solid a\n" + kStlLoop,
                "MALFORMED_FILE [line=8] mesh.file line 8: the file ends before 'endsolid'"},
        Refused{"Empty", MeshFormat::kStl, "solid a\nendsolid a\n",
                "MISSING mesh.file has no triangles"},
        Refused{"TwoVertices", MeshFormat::kStl, Replaced(kStlText, "  vertex 1 0 0\n", ""),
                "MALFORMED_FILE [line=6] mesh.file line 6: a loop must have three vertices"},
        Refused{"FourVertices", MeshFormat::kStl,
                Replaced(kStlText, " endloop", " vertex 0 0 0\n endloop"),
                "MALFORMED_FILE [line=7] mesh.file line 7: a loop must have three vertices"},
        Refused{"NoEndOfLoop", MeshFormat::kStl,
                Replaced(Replaced(kStlText, " endloop\n", ""), "  vertex 1 0 0\n", ""),
                "MALFORMED_FILE [line=7] mesh.file line 7: a loop must have three vertices"},
        Refused{"NoNumber", MeshFormat::kStl, Replaced(kStlText, "1 0 0", "1 O 0"),
                "MALFORMED_FILE [line=5] mesh.file line 5: y is 'O', must be a number"},
        Refused{"TooFewNumbers", MeshFormat::kStl, Replaced(kStlText, "1 0 0", "1 0"),
                "MALFORMED_FILE [line=5] mesh.file line 5: z is missing"},
        Refused{"NotANumber", MeshFormat::kStl, Replaced(kStlText, "1 0 0", "1 nan 0"),
                "NOT_FINITE [value=nan, limit=finite, line=5] mesh.file line 5: y is nan, must be "
                "finite"},
        Refused{"TooFar", MeshFormat::kStl, Replaced(kStlText, "1 0 0", "1 0 1e13"),
                "OUT_OF_RANGE [value=1e+13, limit=[-1e+12, 1e+12], line=5] mesh.file line 5: z is "
                "1e+13, must be in [-1e+12, 1e+12]"},
        Refused{"ManyVertices", MeshFormat::kStl, kStlText,
                "TOO_LARGE [value=3, limit=2, line=6] mesh.file line 6: brings the file to 3 "
                "vertices, must have at most 2",
                AtMost(2, 9)},
        Refused{"ManyFaces", MeshFormat::kStl, "solid a\n" + kStlLoop + kStlLoop + "endsolid",
                "TOO_LARGE [value=2, limit=1, line=11] mesh.file line 11: brings the file to 2 "
                "faces, must have at most 1",
                AtMost(9, 1)}),
    NameOf);

struct BadArrays {
  const char* name;
  PolygonSoup soup;
  const char* told;
  MeshLimits limits = {};
  friend void PrintTo(const BadArrays& arrays, std::ostream* os) { *os << arrays.name; }
};
class ArrayRefusalTest : public testing::TestWithParam<BadArrays> {};

TEST_P(ArrayRefusalTest, TellsReasonPlaceFiguresAndMessage) {
  EXPECT_EQ(Told(PrepareMesh(GetParam().soup, GetParam().limits).status()), GetParam().told);
}

// A cube whose `number` of the array `member` is `value`.
template <typename Value, typename Member>
PolygonSoup CubeWith(Member member, std::size_t number, Value value) {
  PolygonSoup soup = Cube();
  (soup.*member)[number] = value;
  return soup;
}
PolygonSoup CubeWithCoordinate(std::size_t number, double value) {
  PolygonSoup soup = Cube();
  soup.positions[number / 3][static_cast<Eigen::Index>(number % 3)] = value;
  return soup;
}
PolygonSoup Triangles(const std::vector<std::uint32_t>& indices) {
  PolygonSoup soup = Cube();
  soup.face_sizes.clear();
  soup.face_vertices = indices;
  return soup;
}
PolygonSoup FromFile(PolygonSoup soup) {
  soup.is_from_file = true;
  return soup;
}
PolygonSoup Polygon(std::uint32_t corners) {
  PolygonSoup soup = Cube();
  soup.face_sizes = {corners};
  soup.face_vertices.assign(corners, 0);
  return soup;
}
PolygonSoup WithoutVertices() {
  PolygonSoup soup = Cube();
  soup.positions.clear();
  return soup;
}

INSTANTIATE_TEST_SUITE_P(
    All, ArrayRefusalTest,
    testing::Values(
        BadArrays{"NoVertices", WithoutVertices(),
                  "MISSING mesh.arrays.positions is empty: the mesh has no vertices"},
        BadArrays{"NoFaces", Triangles({}),
                  "MISSING mesh.arrays.triangle_indices is empty: the mesh has no faces"},
        BadArrays{"NotInThrees", Triangles({0, 1, 2, 3}),
                  "COUNT_MISMATCH [value=4, limit=a multiple of 3] mesh.arrays.triangle_indices "
                  "has 4 entries, must have 3 per triangle"},
        BadArrays{"TriangleIndexTooHigh", Triangles({0, 1, 2, 3, 90210, 5}),
                  "OUT_OF_RANGE [value=90210, limit=[0, 8)] mesh.arrays.triangle_indices[4] is "
                  "90210, must be below 8"},
        BadArrays{"FaceIndexTooHigh", CubeWith(&PolygonSoup::face_vertices, 17, 8U),
                  "OUT_OF_RANGE [value=8, limit=[0, 8)] mesh.arrays.face_indices[17] is 8, must "
                  "be below 8"},
        BadArrays{"FaceOfTwo", CubeWith(&PolygonSoup::face_sizes, 3, 2U),
                  "OUT_OF_RANGE [value=2, limit=[3, 1000]] mesh.arrays.face_sizes[3] is 2, must "
                  "be in [3, 1000]"},
        BadArrays{"FaceOfNone", CubeWith(&PolygonSoup::face_sizes, 0, 0U),
                  "OUT_OF_RANGE [value=0, limit=[3, 1000]] mesh.arrays.face_sizes[0] is 0, must "
                  "be in [3, 1000]"},
        BadArrays{"FaceOfTooMany", CubeWith(&PolygonSoup::face_sizes, 1, 1001U),
                  "OUT_OF_RANGE [value=1001, limit=[3, 1000]] mesh.arrays.face_sizes[1] is 1001, "
                  "must be in [3, 1000]"},
        BadArrays{"SizesDoNotAddUp", CubeWith(&PolygonSoup::face_sizes, 5, 5U),
                  "COUNT_MISMATCH [value=25, limit=24] mesh.arrays.face_sizes adds up to 25, must "
                  "add up to the 24 face corners"},
        BadArrays{"NotANumber", CubeWithCoordinate(22, kNan),
                  "NOT_FINITE [value=nan, limit=finite] mesh.arrays.positions[22] is nan, must be "
                  "finite"},
        BadArrays{"Infinite", CubeWithCoordinate(0, -kInfinity),
                  "NOT_FINITE [value=-inf, limit=finite] mesh.arrays.positions[0] is -inf, must be "
                  "finite"},
        BadArrays{"TooFar", CubeWithCoordinate(4, -2e12),
                  "OUT_OF_RANGE [value=-2e+12, limit=[-1e+12, 1e+12]] mesh.arrays.positions[4] is "
                  "-2e+12, must be in [-1e+12, 1e+12]"},
        BadArrays{"ManyVertices", Cube(),
                  "TOO_LARGE [value=8, limit=7] mesh.arrays.positions has 8 vertices, must have at "
                  "most 7",
                  AtMost(7, 99)},
        BadArrays{"ManyFaces", Cube(),
                  "TOO_LARGE [value=6, limit=5] mesh.arrays.face_sizes has 6 faces, must have at "
                  "most 5",
                  AtMost(8, 5)},
        BadArrays{"ManyTriangles", Triangles({0, 1, 2, 3, 4, 5}),
                  "TOO_LARGE [value=2, limit=1] mesh.arrays.triangle_indices has 2 faces, must "
                  "have at most 1",
                  AtMost(8, 1)},
        BadArrays{"ManyTrianglesInOneFace", Polygon(7),
                  "TOO_LARGE [limit=4] mesh.arrays.face_sizes come to too many triangles: faces of "
                  "n corners make n - 2 each, must be at most 4 together",
                  AtMost(8, 2)},
        BadArrays{"FileWithoutFaces", FromFile(Triangles({})), "MISSING mesh.file has no faces"},
        BadArrays{"FileWithoutVertices", FromFile(WithoutVertices()),
                  "MISSING mesh.file has no vertices"},
        BadArrays{"FileOfManyFaces", FromFile(Cube()),
                  "TOO_LARGE [value=6, limit=5] mesh.file has 6 faces, must have at most 5",
                  AtMost(8, 5)}),
    [](const auto& test) { return std::string(test.param.name); });

// Exporters write them into files; a caller who sends one has mixed something up.
TEST(ArrayRefusalTest, FacesOfOneOrTwoCornersAreMendedInFiles) {
  const std::string off =
      "OFF\n4 6 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n"
      "3 2 0 3\n2 0 1\n1 3\n";
  const auto soup = ReadMesh(std::as_bytes(std::span(off)));
  ASSERT_TRUE(soup.ok()) << soup.status();
  const auto prepared = PrepareMesh(*soup);
  ASSERT_TRUE(prepared.ok()) << prepared.status();
  EXPECT_EQ(CodesOf(*prepared), "DEGENERATE_FACES");
  EXPECT_EQ(CountOf(*prepared, "DEGENERATE_FACES"), 2);
  PolygonSoup arrays = *soup;
  arrays.is_from_file = false;
  EXPECT_EQ(Told(PrepareMesh(arrays).status()),
            "OUT_OF_RANGE [value=2, limit=[3, 1000]] mesh.arrays.face_sizes[4] is 2, must be in "
            "[3, 1000]");
}

}  // namespace
}  // namespace capfit::formats
