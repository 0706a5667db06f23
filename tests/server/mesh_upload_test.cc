#include "server/mesh_upload.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/base/status.h"

namespace capfit::server {
namespace {

using Request = v1::ApproximateBodyRequest;

constexpr char kTriangleObj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\n";

Request FileHeader(std::int64_t byte_count = 0) {
  Request request;
  v1::FileEncoding& file = *request.mutable_header()->mutable_mesh()->mutable_file();
  file.set_format(v1::MESH_FILE_FORMAT_OBJ);
  file.set_byte_count(byte_count);
  return request;
}

Request ArrayHeader(int vertex_count = 0, int face_count = 0) {
  Request request;
  v1::ArrayEncoding& arrays = *request.mutable_header()->mutable_mesh()->mutable_arrays();
  arrays.set_vertex_count(vertex_count);
  arrays.set_face_count(face_count);
  return request;
}

Request Bytes(const std::string& bytes) {
  Request request;
  request.mutable_chunk()->set_file_bytes(bytes);
  return request;
}

Request Arrays(const std::vector<float>& positions, const std::vector<std::uint32_t>& triangles) {
  Request request;
  v1::MeshArrays& arrays = *request.mutable_chunk()->mutable_arrays();
  arrays.mutable_positions()->Assign(positions.begin(), positions.end());
  arrays.mutable_triangle_indices()->Assign(triangles.begin(), triangles.end());
  return request;
}

Request Polygons(const std::vector<std::uint32_t>& sizes,
                 const std::vector<std::uint32_t>& corners) {
  Request request;
  v1::MeshArrays& arrays = *request.mutable_chunk()->mutable_arrays();
  arrays.mutable_face_sizes()->Assign(sizes.begin(), sizes.end());
  arrays.mutable_face_indices()->Assign(corners.begin(), corners.end());
  return request;
}

Request Doubles(const std::vector<double>& positions) {
  Request request;
  request.mutable_chunk()->mutable_arrays()->mutable_positions_double()->Assign(positions.begin(),
                                                                                positions.end());
  return request;
}

absl::StatusOr<formats::PolygonSoup> Upload(const std::vector<Request>& requests,
                                            const UploadLimits& limits = {}) {
  MeshUpload upload(limits);
  for (const Request& request : requests) CAPFIT_RETURN_IF_ERROR(upload.Add(request));
  return std::move(upload).Finish();
}

TEST(MeshUpload, AFileInPiecesIsReadAsOne) {
  const std::string file = kTriangleObj;
  const auto soup = Upload({FileHeader(static_cast<std::int64_t>(file.size())),
                            Bytes(file.substr(0, 11)), Bytes(file.substr(11))});
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->positions.size(), 4U);
  EXPECT_EQ(soup->face_vertices.size(), 6U);
}

TEST(MeshUpload, ArraysMayBeCutAnywhere) {
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0.5F, 7, 8, 9};
  const std::vector<std::uint32_t> triangles = {0, 1, 2, 2, 1, 3};
  for (std::size_t cut = 0; cut <= positions.size(); ++cut) {
    const auto middle = positions.begin() + static_cast<std::ptrdiff_t>(cut);
    const auto soup = Upload({ArrayHeader(4, 2), Arrays({positions.begin(), middle}, {0}),
                              Arrays({middle, positions.end()}, {1, 2, 2}), Arrays({}, {1, 3})});
    ASSERT_TRUE(soup.ok()) << soup.status();
    ASSERT_EQ(soup->positions.size(), 4U);
    EXPECT_EQ(soup->positions[2], Eigen::Vector3d(0, 1, 0.5));
    EXPECT_EQ(soup->positions[3], Eigen::Vector3d(7, 8, 9));
    EXPECT_EQ(soup->face_vertices, triangles);
    EXPECT_TRUE(soup->face_sizes.empty());
  }
}

TEST(MeshUpload, DoublesAndPolygonsAreTaken) {
  const double third = 1.0 / 3.0;
  const auto soup = Upload({ArrayHeader(), Doubles({third, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}),
                            Polygons({4, 3}, {0, 1, 2, 3, 0, 2, 1})});
  ASSERT_TRUE(soup.ok()) << soup.status();
  EXPECT_EQ(soup->positions[0].x(), third);
  EXPECT_EQ(soup->face_sizes, (std::vector<std::uint32_t>{4, 3}));
  EXPECT_EQ(soup->face_vertices.size(), 7U);
}

TEST(MeshUpload, AClaimTakesNoMemoryBeyondTheFirstReservation) {
  // Would be 48 GB of positions; refused before anything is reserved.
  const auto soup = Upload({ArrayHeader(2'000'000'000)});
  EXPECT_EQ(FieldOf(soup.status()), "mesh.arrays.vertex_count");
}

struct Misuse {
  std::string name;
  std::vector<Request> requests;
  std::string field;
  std::string problem;  // part of the message
  friend void PrintTo(const Misuse& m, std::ostream* os) { *os << m.name; }
};
class MeshUploadMisuse : public testing::TestWithParam<Misuse> {};

// 100 bytes, 5 vertices, 4 faces.
UploadLimits TinyLimits() {
  UploadLimits limits;
  limits.max_bytes = 100;
  limits.mesh.max_vertices = 5;
  limits.mesh.max_faces = 4;
  return limits;
}

TEST_P(MeshUploadMisuse, IsRefusedWithFieldAndProblem) {
  const absl::Status status = Upload(GetParam().requests, TinyLimits()).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << status;
  EXPECT_EQ(FieldOf(status).value_or("none"), GetParam().field) << status;
  EXPECT_TRUE(ReasonOf(status)) << status;
  EXPECT_THAT(std::string(status.message()), testing::HasSubstr(GetParam().problem));
}

Request LongId() {
  Request request = FileHeader();
  request.mutable_header()->set_request_id(std::string(129, 'x'));
  return request;
}

Request UnknownFormat() {
  Request request = FileHeader();
  request.mutable_header()->mutable_mesh()->mutable_file()->set_format(v1::MeshFileFormat(77));
  return request;
}

Request EmptyHeader() {
  Request request;
  request.mutable_header();
  return request;
}

Request EmptyChunk() {
  Request request;
  request.mutable_chunk();
  return request;
}

INSTANTIATE_TEST_SUITE_P(
    All, MeshUploadMisuse,
    testing::Values(
        Misuse{"Nothing", {}, "header", "is missing"},
        Misuse{"NeitherHeaderNorChunk", {Request()}, "part", "header or a chunk"},
        Misuse{"NoEncoding", {EmptyHeader()}, "mesh", "file or arrays"},
        Misuse{"ChunkBeforeHeader", {Bytes("v 0 0 0\n")}, "chunk", "before the header"},
        Misuse{"SecondHeader", {FileHeader(), FileHeader()}, "header", "second time"},
        Misuse{"HeaderOnly", {FileHeader()}, "chunk", "empty"},
        Misuse{"ArraysHeaderOnly", {ArrayHeader()}, "chunk", "empty"},
        Misuse{"EmptyChunk", {FileHeader(), EmptyChunk()}, "chunk", "has no data"},
        Misuse{"EmptyBytes", {FileHeader(), Bytes("")}, "chunk.file_bytes", "is empty"},
        Misuse{"EmptyArrays", {ArrayHeader(), Arrays({}, {})}, "chunk.arrays", "is empty"},
        Misuse{"BytesForArrays", {ArrayHeader(), Bytes("x")}, "chunk.file_bytes", "says arrays"},
        Misuse{"ArraysForFile", {FileHeader(), Arrays({1}, {})}, "chunk.arrays", "says file"},
        Misuse{"LongRequestId", {LongId()}, "request_id", "at most 128"},
        Misuse{"UnknownFormat", {UnknownFormat()}, "mesh.file.format", "is 77"},
        Misuse{"ClaimTooBig", {FileHeader(101)}, "mesh.file.byte_count", "[0, 100]"},
        Misuse{"ClaimNegative", {FileHeader(-1)}, "mesh.file.byte_count", "is -1"},
        Misuse{"TooManyVerticesClaimed", {ArrayHeader(6)}, "mesh.arrays.vertex_count", "[0, 5]"},
        Misuse{"TooManyFacesClaimed", {ArrayHeader(1, 5)}, "mesh.arrays.face_count", "[0, 4]"},
        Misuse{"TooManyBytes",
               {FileHeader(), Bytes(std::string(60, ' ')), Bytes(std::string(41, ' '))},
               "chunk.file_bytes",
               "101 bytes, must have at most 100"},
        Misuse{
            "ClaimNotMet", {FileHeader(50), Bytes("v 0 0 0\n")}, "mesh.file.byte_count", "bring 8"},
        Misuse{"TooManyVertices",
               {ArrayHeader(), Arrays(std::vector<float>(18), {})},
               "mesh.arrays.positions",
               "6 vertices, must have at most 5"},
        Misuse{"TooManyTriangles",
               {ArrayHeader(), Arrays({}, std::vector<std::uint32_t>(15))},
               "mesh.arrays.triangle_indices",
               "5 faces, must have at most 4"},
        Misuse{"TooManyPolygons",
               {ArrayHeader(), Polygons({3, 3, 3, 3, 3}, {})},
               "mesh.arrays.face_sizes",
               "5 faces, must have at most 4"},
        Misuse{"HalfAVertex",
               {ArrayHeader(), Arrays({1, 2, 3, 4}, {})},
               "mesh.arrays.positions",
               "4 numbers"},
        Misuse{"HalfATriangle",
               {ArrayHeader(), Arrays({1, 2, 3}, {0, 0})},
               "mesh.arrays.triangle_indices",
               "2 numbers"},
        Misuse{"CornersDoNotAddUp",
               {ArrayHeader(), Arrays({1, 2, 3}, {}), Polygons({4}, {0, 0, 0})},
               "mesh.arrays.face_indices",
               "add up to 4"},
        Misuse{"MixedPositions",
               {ArrayHeader(), Arrays({1, 2, 3}, {}), Doubles({1})},
               "mesh.arrays",
               "mixes"},
        Misuse{"MixedFaces",
               {ArrayHeader(), Arrays({}, {1, 2, 3}), Polygons({3}, {})},
               "mesh.arrays",
               "mixes"},
        Misuse{"VertexClaimNotMet",
               {ArrayHeader(2), Arrays({1, 2, 3}, {0, 0, 0})},
               "mesh.arrays.vertex_count",
               "bring 1"},
        Misuse{"FaceClaimNotMet",
               {ArrayHeader(1, 2), Arrays({1, 2, 3}, {0, 0, 0})},
               "mesh.arrays.face_count",
               "bring 1"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace capfit::server
