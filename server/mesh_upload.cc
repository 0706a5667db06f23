#include "server/mesh_upload.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/mesh/read_mesh.h"
#include "proto/wire/enum_conversion.h"

namespace capfit::server {
namespace {

constexpr std::int64_t kMaxReservedBytes = 16LL * 1024 * 1024;
constexpr std::size_t kMaxRequestIdBytes = 128;

absl::Status CheckClaim(const char* field, std::int64_t claimed, std::int64_t limit) {
  if (claimed >= 0 && claimed <= limit) return absl::OkStatus();
  return InvalidField(ErrorReason::kOutOfRange, field,
                      absl::StrCat("is ", claimed, ", must be in [0, ", limit, "]"));
}

absl::Status CheckFile(const v1::FileEncoding& file, const UploadLimits& limits) {
  if (!wire::FromWire(file.format())) {
    return InvalidField(
        ErrorReason::kOutOfRange, "mesh.file.format",
        absl::StrCat("is ", static_cast<int>(file.format()), ", must be one of MeshFileFormat"));
  }
  return CheckClaim("mesh.file.byte_count", file.byte_count(), limits.max_bytes);
}

absl::Status CheckArrays(const v1::ArrayEncoding& arrays, const UploadLimits& limits) {
  CAPFIT_RETURN_IF_ERROR(CheckClaim("mesh.arrays.vertex_count", arrays.vertex_count(),
                                    static_cast<std::int64_t>(limits.mesh.max_vertices)));
  return CheckClaim("mesh.arrays.face_count", arrays.face_count(),
                    static_cast<std::int64_t>(limits.mesh.max_faces));
}

absl::Status CheckHeader(const v1::ApproximateBodyHeader& header, const UploadLimits& limits) {
  if (header.request_id().size() > kMaxRequestIdBytes) {
    return InvalidField(
        ErrorReason::kOutOfRange, "request_id",
        absl::StrCat("has ", header.request_id().size(), " bytes, limit ", kMaxRequestIdBytes));
  }
  switch (header.mesh().encoding_case()) {
    case v1::MeshHeader::kFile:
      return CheckFile(header.mesh().file(), limits);
    case v1::MeshHeader::kArrays:
      return CheckArrays(header.mesh().arrays(), limits);
    case v1::MeshHeader::ENCODING_NOT_SET:
      break;
  }
  return InvalidField(ErrorReason::kOutOfRange, "mesh.encoding",
                      "is missing, must be file or arrays");
}

absl::Status CheckMet(const char* field, std::int64_t claimed, std::size_t received) {
  if (claimed == 0 || static_cast<std::size_t>(claimed) == received) return absl::OkStatus();
  return InvalidField(ErrorReason::kOutOfRange, field,
                      absl::StrCat("is ", claimed, ", but the chunks bring ", received));
}

absl::Status CheckAtMost(const char* field, const char* what, std::size_t count,
                         std::size_t limit) {
  if (count <= limit) return absl::OkStatus();
  return InvalidField(ErrorReason::kOutOfRange, field,
                      absl::StrCat("bring ", count, " ", what, ", limit ", limit));
}

template <typename Numbers>
void AppendCoordinates(const Numbers& numbers, std::size_t& count,
                       std::vector<Eigen::Vector3d>& positions) {
  for (const auto number : numbers) {
    if (count % 3 == 0) positions.emplace_back(0.0, 0.0, 0.0);
    positions.back()[static_cast<Eigen::Index>(count % 3)] = number;
    ++count;
  }
}

template <typename Numbers>
void Append(const Numbers& numbers, std::vector<std::uint32_t>& target) {
  target.insert(target.end(), numbers.begin(), numbers.end());
}

std::size_t ArrayBytes(const v1::MeshArrays& arrays) {
  return sizeof(float) * static_cast<std::size_t>(arrays.positions_size()) +
         sizeof(double) * static_cast<std::size_t>(arrays.positions_double_size()) +
         sizeof(std::uint32_t) * (static_cast<std::size_t>(arrays.triangle_indices_size()) +
                                  static_cast<std::size_t>(arrays.face_sizes_size()) +
                                  static_cast<std::size_t>(arrays.face_indices_size()));
}

}  // namespace

absl::Status MeshUpload::Add(const v1::ApproximateBodyRequest& request) {
  switch (request.part_case()) {
    case v1::ApproximateBodyRequest::kHeader:
      return AddHeader(request.header());
    case v1::ApproximateBodyRequest::kChunk:
      return AddChunk(request.chunk());
    case v1::ApproximateBodyRequest::PART_NOT_SET:
      break;
  }
  return InvalidField(ErrorReason::kOutOfRange, "part",
                      "is missing: each message must carry a header or a chunk");
}

absl::Status MeshUpload::AddHeader(const v1::ApproximateBodyHeader& header) {
  if (has_header_)
    return InvalidField(ErrorReason::kOutOfRange, "header",
                        "came a second time, only the first message may");
  CAPFIT_RETURN_IF_ERROR(CheckHeader(header, limits_));
  has_header_ = true;
  header_ = header;
  if (header.mesh().has_file()) {
    file_bytes_.reserve(
        static_cast<std::size_t>(std::min(kMaxReservedBytes, header.mesh().file().byte_count())));
  } else {
    const std::int64_t claimed = header.mesh().arrays().vertex_count();
    const auto vertex_bytes = static_cast<std::int64_t>(sizeof(Eigen::Vector3d));
    soup_.positions.reserve(
        static_cast<std::size_t>(std::min(kMaxReservedBytes / vertex_bytes, claimed)));
  }
  return absl::OkStatus();
}

absl::Status MeshUpload::AddChunk(const v1::MeshChunk& chunk) {
  if (!has_header_)
    return InvalidField(ErrorReason::kOutOfRange, "chunk", "came before the header");
  const bool wants_file = header_.mesh().has_file();
  switch (chunk.data_case()) {
    case v1::MeshChunk::kFileBytes:
      if (!wants_file)
        return InvalidField(ErrorReason::kOutOfRange, "chunk.file_bytes",
                            "came, but the header says arrays");
      CAPFIT_RETURN_IF_ERROR(CountBytes("chunk.file_bytes", chunk.file_bytes().size()));
      file_bytes_ += chunk.file_bytes();
      return absl::OkStatus();
    case v1::MeshChunk::kArrays:
      if (wants_file)
        return InvalidField(ErrorReason::kOutOfRange, "chunk.arrays",
                            "came, but the header says file");
      return AddArrays(chunk.arrays());
    case v1::MeshChunk::DATA_NOT_SET:
      break;
  }
  return InvalidField(ErrorReason::kOutOfRange, "chunk.data",
                      "is missing, must be file_bytes or arrays");
}

absl::Status MeshUpload::CountBytes(const char* field, std::size_t bytes) {
  if (bytes == 0)
    return InvalidField(ErrorReason::kOutOfRange, field,
                        "is empty, each chunk must bring something");
  received_bytes_ += static_cast<std::int64_t>(bytes);
  if (received_bytes_ <= limits_.max_bytes) return absl::OkStatus();
  return InvalidField(
      ErrorReason::kOutOfRange, field,
      absl::StrCat("brings the upload to ", received_bytes_, " bytes, limit ", limits_.max_bytes));
}

absl::Status MeshUpload::AddArrays(const v1::MeshArrays& arrays) {
  CAPFIT_RETURN_IF_ERROR(CountBytes("chunk.arrays", ArrayBytes(arrays)));
  has_float_ |= !arrays.positions().empty();
  has_double_ |= !arrays.positions_double().empty();
  has_triangles_ |= !arrays.triangle_indices().empty();
  has_polygons_ |= !arrays.face_sizes().empty() || !arrays.face_indices().empty();
  if (has_float_ && has_double_) {
    return InvalidField(ErrorReason::kOutOfRange, "chunk.arrays",
                        "mixes positions and positions_double, use one of them");
  }
  if (has_triangles_ && has_polygons_) {
    return InvalidField(ErrorReason::kOutOfRange, "chunk.arrays",
                        "mixes triangle_indices and face_sizes, use one of them");
  }
  AppendCoordinates(arrays.positions(), coordinate_count_, soup_.positions);
  AppendCoordinates(arrays.positions_double(), coordinate_count_, soup_.positions);
  Append(arrays.triangle_indices(), soup_.face_vertices);
  Append(arrays.face_sizes(), soup_.face_sizes);
  Append(arrays.face_indices(), soup_.face_vertices);
  return CheckArraySizes();
}

std::size_t MeshUpload::face_count() const {
  return has_polygons_ ? soup_.face_sizes.size() : soup_.face_vertices.size() / 3;
}

absl::Status MeshUpload::CheckArraySizes() const {
  CAPFIT_RETURN_IF_ERROR(CheckAtMost("chunk.arrays.positions", "vertices", soup_.positions.size(),
                                     limits_.mesh.max_vertices));
  return CheckAtMost(has_polygons_ ? "chunk.arrays.face_sizes" : "chunk.arrays.triangle_indices",
                     "faces", face_count(), limits_.mesh.max_faces);
}

absl::Status MeshUpload::CheckComplete() const {
  if (!has_header_) {
    return InvalidField(ErrorReason::kOutOfRange, "header",
                        "is missing: the upload is empty, its first message must be one");
  }
  if (received_bytes_ == 0) {
    return InvalidField(ErrorReason::kOutOfRange, "chunk",
                        "is missing: the upload is empty, at least one must follow the "
                        "header");
  }
  if (header_.mesh().has_file()) {
    return CheckMet("mesh.file.byte_count", header_.mesh().file().byte_count(), file_bytes_.size());
  }
  if (coordinate_count_ % 3 != 0) {
    return InvalidField(
        ErrorReason::kOutOfRange, "positions",
        absl::StrCat("has ", coordinate_count_, " numbers, must be a multiple of 3"));
  }
  if (!has_polygons_ && soup_.face_vertices.size() % 3 != 0) {
    return InvalidField(
        ErrorReason::kOutOfRange, "triangle_indices",
        absl::StrCat("has ", soup_.face_vertices.size(), " numbers, must be a multiple of 3"));
  }
  const std::uint64_t corners =
      std::accumulate(soup_.face_sizes.begin(), soup_.face_sizes.end(), std::uint64_t{0});
  if (has_polygons_ && corners != soup_.face_vertices.size()) {
    return InvalidField(ErrorReason::kOutOfRange, "face_indices",
                        absl::StrCat("has ", soup_.face_vertices.size(),
                                     " numbers, but face_sizes add up to ", corners));
  }
  CAPFIT_RETURN_IF_ERROR(CheckMet("mesh.arrays.vertex_count",
                                  header_.mesh().arrays().vertex_count(), soup_.positions.size()));
  return CheckMet("mesh.arrays.face_count", header_.mesh().arrays().face_count(), face_count());
}

absl::StatusOr<mesh::PolygonSoup> MeshUpload::Finish() && {
  CAPFIT_RETURN_IF_ERROR(CheckComplete());
  if (!header_.mesh().has_file()) return std::move(soup_);
  const mesh::MeshFormat format =
      wire::FromWire(header_.mesh().file().format()).value_or(mesh::MeshFormat::kUnknown);
  return mesh::ReadMesh(std::as_bytes(std::span(file_bytes_)), format, limits_.mesh);
}

}  // namespace capfit::server
