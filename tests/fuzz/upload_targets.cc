#include "tests/fuzz/upload_targets.h"

#include <cstdint>
#include <cstring>
#include <utility>

#include "capfit/v1/service.pb.h"
#include "core/mesh/prepare_mesh.h"
#include "server/mesh_upload.h"
#include "tests/fuzz/byte_source.h"
#include "tests/fuzz/mesh_promises.h"

namespace capfit::fuzz {
namespace {

std::string AsText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void FileHeader(ByteSource& source, v1::FileEncoding& file) {
  file.set_format(static_cast<v1::MeshFileFormat>(source.Next() % 8u));
  file.set_byte_count(source.NextWord());
}

void ArrayHeader(ByteSource& source, v1::ArrayEncoding& arrays) {
  arrays.set_vertex_count(source.NextSigned());
  arrays.set_face_count(source.NextSigned());
}

// Any four bytes as a number: also NaN, infinity and denormals.
void AnyPositions(ByteSource& source, v1::MeshArrays& arrays) {
  const std::span<const std::byte> bytes = source.Take(source.Next());
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    float value = 0.0F;
    std::memcpy(&value, &bytes[i], sizeof value);
    arrays.add_positions(value);
  }
}

void SmallPositions(ByteSource& source, bool as_double, v1::MeshArrays& arrays) {
  for (int count = source.Next(); count > 0; --count) {
    const int value = source.NextSigned();
    if (as_double) {
      arrays.add_positions_double(value);
    } else {
      arrays.add_positions(static_cast<float>(value));
    }
  }
}

void Triangles(ByteSource& source, v1::MeshArrays& arrays) {
  for (int count = source.Next(); count > 0; --count) arrays.add_triangle_indices(source.Next());
}

void Polygons(ByteSource& source, v1::MeshArrays& arrays) {
  for (int count = source.Next() % 64; count > 0; --count) arrays.add_face_sizes(source.Next());
  for (int count = source.Next(); count > 0; --count) arrays.add_face_indices(source.Next());
}

v1::ApproximateBodyRequest NextMessage(ByteSource& source) {
  v1::ApproximateBodyRequest request;
  switch (source.Next() % 8u) {
    case 0: {
      const std::span<const std::byte> bytes = source.Take(source.NextWord());
      (void)request.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
      break;
    }
    case 1:
      FileHeader(source, *request.mutable_header()->mutable_mesh()->mutable_file());
      break;
    case 2:
      ArrayHeader(source, *request.mutable_header()->mutable_mesh()->mutable_arrays());
      break;
    case 3:
      request.mutable_chunk()->set_file_bytes(AsText(source.Take(source.NextWord())));
      break;
    case 4:
      AnyPositions(source, *request.mutable_chunk()->mutable_arrays());
      break;
    case 5: {
      const bool as_double = source.Next() % 2 != 0;
      SmallPositions(source, as_double, *request.mutable_chunk()->mutable_arrays());
      break;
    }
    case 6:
      Triangles(source, *request.mutable_chunk()->mutable_arrays());
      break;
    default:
      Polygons(source, *request.mutable_chunk()->mutable_arrays());
      break;
  }
  return request;
}

}  // namespace

std::string TryUpload(std::span<const std::byte> bytes) {
  server::UploadLimits limits;
  limits.mesh.max_vertices = 10'000;
  limits.mesh.max_faces = 10'000;
  limits.max_bytes = 1 << 16;
  server::MeshUpload upload(limits);
  ByteSource source(bytes);
  while (!source.IsEmpty()) {
    const absl::Status status = upload.Add(NextMessage(source));
    if (status.code() == absl::StatusCode::kInvalidArgument) return {};
    if (!status.ok()) return "an unexpected error: " + status.ToString();
    if (upload.received_bytes() > limits.max_bytes) return "more bytes than the limit";
  }
  const auto soup = std::move(upload).Finish();
  if (!soup.ok()) return {};
  const auto prepared = mesh::PrepareMesh(*soup, limits.mesh);
  return prepared.ok() ? BrokenPromiseOfPrepare(*prepared, soup->positions.size()) : std::string();
}

}  // namespace capfit::fuzz
