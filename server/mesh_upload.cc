#include "server/mesh_upload.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/read_mesh.h"
#include "proto/wire/enum_conversion.h"

namespace capfit::server {
namespace {

constexpr std::size_t kMaxRequestIdBytes = 128;

absl::Status CheckClaim(const char* field, std::int64_t claimed, std::int64_t limit) {
  if (claimed >= 0 && claimed <= limit) return absl::OkStatus();
  return OutOfRange(field, claimed, std::int64_t{0}, limit);
}

absl::Status CheckFormat(v1::MeshFileFormat format) {
  if (wire::FromWire(format)) return absl::OkStatus();
  return wire::UnknownEnum("mesh.file.format", format);
}

absl::Status CheckFile(const v1::FileEncoding& file, const UploadLimits& limits) {
  CAPFIT_RETURN_IF_ERROR(CheckFormat(file.format()));
  return CheckClaim("mesh.file.byte_count", file.byte_count(), limits.max_bytes);
}

absl::Status CheckArrays(const v1::ArrayEncoding& arrays, const UploadLimits& limits) {
  CAPFIT_RETURN_IF_ERROR(CheckClaim("mesh.arrays.vertex_count", arrays.vertex_count(),
                                    static_cast<std::int64_t>(limits.mesh.max_vertices)));
  return CheckClaim("mesh.arrays.face_count", arrays.face_count(),
                    static_cast<std::int64_t>(limits.mesh.max_faces));
}

absl::Status CheckRequestId(const std::string& request_id) {
  if (request_id.size() <= kMaxRequestIdBytes) return absl::OkStatus();
  return TooLarge("request_id", request_id.size(), "bytes", kMaxRequestIdBytes);
}

absl::Status NoEncoding() {
  return InvalidField(ErrorReason::kMissing, "mesh", "has no encoding, must have file or arrays");
}

absl::Status CheckHeader(const v1::ApproximateBodyHeader& header, const UploadLimits& limits) {
  CAPFIT_RETURN_IF_ERROR(CheckRequestId(header.request_id()));
  switch (header.mesh().encoding_case()) {
    case v1::MeshHeader::kFile:
      return CheckFile(header.mesh().file(), limits);
    case v1::MeshHeader::kArrays:
      return CheckArrays(header.mesh().arrays(), limits);
    case v1::MeshHeader::ENCODING_NOT_SET:
      break;
  }
  return NoEncoding();
}

absl::Status CheckMet(const char* field, std::int64_t claimed, std::size_t received) {
  if (claimed == 0 || static_cast<std::size_t>(claimed) == received) return absl::OkStatus();
  return InvalidField(ErrorReason::kCountMismatch, field,
                      absl::StrCat("is ", claimed, ", but the chunks bring ", received),
                      {{"value", absl::StrCat(received)}, {"limit", absl::StrCat(claimed)}});
}

absl::Status CheckInThrees(const char* field, std::size_t count) {
  if (count % 3 == 0) return absl::OkStatus();
  return InvalidField(ErrorReason::kCountMismatch, field,
                      absl::StrCat("has ", count, " numbers, must be a multiple of 3"),
                      {{"value", absl::StrCat(count)}, {"limit", "a multiple of 3"}});
}

// Room for `needed` elements without more growth than a vector's own, and none beyond `claimed`.
template <typename Container>
void MakeRoom(Container& container, std::size_t needed, std::int64_t claimed) {
  if (needed <= container.capacity()) return;
  container.reserve(
      std::clamp(static_cast<std::size_t>(std::max<std::int64_t>(0, claimed)), needed, 2 * needed));
}

template <typename Container>
std::int64_t CapacityBytes(const Container& container) {
  return static_cast<std::int64_t>(container.capacity() * sizeof(container[0]));
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
  return InvalidField(ErrorReason::kMissing, "part",
                      "is missing: each message must carry a header or a chunk");
}

absl::Status MeshUpload::AddWhole(const v1::ApproximateBodyUnaryRequest& request) {
  CAPFIT_RETURN_IF_ERROR(CheckRequestId(request.request_id()));
  has_header_ = true;
  header_.set_request_id(request.request_id());
  *header_.mutable_options() = request.options();
  if (request.has_layout()) *header_.mutable_layout() = request.layout();
  *header_.mutable_exports() = request.exports();
  v1::MeshHeader& mesh = *header_.mutable_mesh();
  mesh.set_unit(request.mesh().unit());
  mesh.set_up_axis(request.mesh().up_axis());
  switch (request.mesh().encoding_case()) {
    case v1::InlineMesh::kFile:
      CAPFIT_RETURN_IF_ERROR(CheckFormat(request.mesh().file().format()));
      mesh.mutable_file()->set_format(request.mesh().file().format());
      return AddFileBytes("mesh.file.data", request.mesh().file().data());
    case v1::InlineMesh::kArrays:
      mesh.mutable_arrays();
      return AddArrays("mesh.arrays", request.mesh().arrays());
    case v1::InlineMesh::ENCODING_NOT_SET:
      break;
  }
  return NoEncoding();
}

absl::Status MeshUpload::AddHeader(const v1::ApproximateBodyHeader& header) {
  if (has_header_) {
    return InvalidField(ErrorReason::kDuplicate, "header",
                        "came a second time, only the first message may be one");
  }
  CAPFIT_RETURN_IF_ERROR(CheckHeader(header, limits_));
  has_header_ = true;
  header_ = header;
  return absl::OkStatus();
}

absl::Status MeshUpload::AddChunk(const v1::MeshChunk& chunk) {
  if (!has_header_) {
    return InvalidField(ErrorReason::kOutOfOrder, "chunk",
                        "came before the header, which must be the first message");
  }
  if (is_complete()) {
    return InvalidField(ErrorReason::kCountMismatch, "chunk",
                        "came after all that the header declares had arrived");
  }
  const bool wants_file = header_.mesh().has_file();
  switch (chunk.data_case()) {
    case v1::MeshChunk::kFileBytes:
      if (wants_file) return AddFileBytes("chunk.file_bytes", chunk.file_bytes());
      return InvalidField(ErrorReason::kConflict, "chunk.file_bytes",
                          "came, but the header says arrays");
    case v1::MeshChunk::kArrays:
      if (!wants_file) return AddArrays("chunk.arrays", chunk.arrays());
      return InvalidField(ErrorReason::kConflict, "chunk.arrays", "came, but the header says file");
    case v1::MeshChunk::DATA_NOT_SET:
      break;
  }
  return InvalidField(ErrorReason::kMissing, "chunk",
                      "has no data, must have file_bytes or arrays");
}

absl::Status MeshUpload::CountBytes(const char* field, std::size_t bytes) {
  if (bytes == 0) {
    return InvalidField(ErrorReason::kMissing, field, "is empty, must bring a piece of the mesh");
  }
  received_bytes_ += static_cast<std::int64_t>(bytes);
  if (received_bytes_ <= limits_.max_bytes) return absl::OkStatus();
  return InvalidField(
      ErrorReason::kTooLarge, field,
      absl::StrCat("brings the upload to ", received_bytes_, " bytes, must have at most ",
                   limits_.max_bytes),
      {{"value", absl::StrCat(received_bytes_)}, {"limit", absl::StrCat(limits_.max_bytes)}});
}

absl::Status MeshUpload::AddFileBytes(const char* field, const std::string& bytes) {
  CAPFIT_RETURN_IF_ERROR(CountBytes(field, bytes.size()));
  MakeRoom(file_bytes_, file_bytes_.size() + bytes.size(), header_.mesh().file().byte_count());
  file_bytes_ += bytes;
  return absl::OkStatus();
}

absl::Status MeshUpload::AddArrays(const char* field, const v1::MeshArrays& arrays) {
  CAPFIT_RETURN_IF_ERROR(CountBytes(field, ArrayBytes(arrays)));
  has_float_ |= !arrays.positions().empty();
  has_double_ |= !arrays.positions_double().empty();
  has_triangles_ |= !arrays.triangle_indices().empty();
  has_polygons_ |= !arrays.face_sizes().empty() || !arrays.face_indices().empty();
  if (has_float_ && has_double_) {
    return InvalidField(ErrorReason::kConflict, "mesh.arrays",
                        "mixes positions and positions_double, use one of them");
  }
  if (has_triangles_ && has_polygons_) {
    return InvalidField(ErrorReason::kConflict, "mesh.arrays",
                        "mixes triangle_indices and face_sizes, use one of them");
  }
  const auto more =
      static_cast<std::size_t>(arrays.positions_size() + arrays.positions_double_size());
  MakeRoom(soup_.positions, (coordinate_count_ + more + 2) / 3,
           header_.mesh().arrays().vertex_count());
  AppendCoordinates(arrays.positions(), coordinate_count_, soup_.positions);
  AppendCoordinates(arrays.positions_double(), coordinate_count_, soup_.positions);
  Append(arrays.triangle_indices(), soup_.face_vertices);
  Append(arrays.face_sizes(), soup_.face_sizes);
  Append(arrays.face_indices(), soup_.face_vertices);
  corner_count_ =
      std::accumulate(arrays.face_sizes().begin(), arrays.face_sizes().end(), corner_count_);
  return CheckArraySizes();
}

void MeshUpload::AddTo(ContentHash& hash) const {
  v1::ApproximateBodyHeader asked = header_;
  asked.clear_request_id();
  if (asked.mesh().has_file()) {
    asked.mutable_mesh()->mutable_file()->clear_byte_count();
  } else {
    asked.mutable_mesh()->mutable_arrays()->Clear();
  }
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream out(&bytes);
    google::protobuf::io::CodedOutputStream coded(&out);
    coded.SetSerializationDeterministic(true);
    asked.SerializeToCodedStream(&coded);
  }
  hash.Add(bytes);
  hash.Add(file_bytes_);
  hash.Add(soup_.positions);
  hash.Add(soup_.face_sizes);
  hash.Add(soup_.face_vertices);
}

std::int64_t MeshUpload::held_bytes() const {
  return CapacityBytes(file_bytes_) + CapacityBytes(soup_.positions) +
         CapacityBytes(soup_.face_sizes) + CapacityBytes(soup_.face_vertices);
}

std::int64_t MeshUpload::claimed_bytes() const {
  if (header_.mesh().has_file()) return header_.mesh().file().byte_count();
  const v1::ArrayEncoding& arrays = header_.mesh().arrays();
  return static_cast<std::int64_t>(sizeof(Eigen::Vector3d)) * arrays.vertex_count() +
         static_cast<std::int64_t>(3 * sizeof(std::uint32_t)) * arrays.face_count();
}

std::int64_t MeshUpload::face_count() const {
  if (file_bytes_.empty()) return static_cast<std::int64_t>(soup_.face_count());
  return static_cast<std::int64_t>(file_bytes_.size()) / kFileBytesOfAFace;
}

std::int64_t MeshUpload::vertex_count() const {
  return file_bytes_.empty() ? static_cast<std::int64_t>(soup_.positions.size()) : face_count() / 2;
}

absl::Status MeshUpload::CheckArraySizes() const {
  if (soup_.positions.size() > limits_.mesh.max_vertices) {
    return TooLarge(positions_field(), soup_.positions.size(), "vertices",
                    limits_.mesh.max_vertices);
  }
  if (soup_.face_count() <= limits_.mesh.max_faces) return absl::OkStatus();
  return TooLarge(has_polygons_ ? "mesh.arrays.face_sizes" : "mesh.arrays.triangle_indices",
                  soup_.face_count(), "faces", limits_.mesh.max_faces);
}

bool MeshUpload::is_complete() const {
  if (!has_header_) return false;
  if (header_.mesh().has_file()) {
    const std::int64_t claimed = header_.mesh().file().byte_count();
    return claimed > 0 && static_cast<std::int64_t>(file_bytes_.size()) >= claimed;
  }
  const v1::ArrayEncoding& arrays = header_.mesh().arrays();
  return arrays.vertex_count() > 0 && arrays.face_count() > 0 &&
         coordinate_count_ >= 3 * static_cast<std::size_t>(arrays.vertex_count()) &&
         soup_.face_count() >= static_cast<std::size_t>(arrays.face_count()) &&
         soup_.face_vertices.size() >= CornersOfFaces();
}

std::uint64_t MeshUpload::CornersOfFaces() const {
  return has_polygons_ ? corner_count_
                       : 3 * static_cast<std::uint64_t>(header_.mesh().arrays().face_count());
}

absl::Status MeshUpload::CheckComplete() const {
  if (!has_header_) {
    return InvalidField(ErrorReason::kMissing, "header",
                        "is missing: the upload is empty, its first message must be one");
  }
  if (received_bytes_ == 0) {
    return InvalidField(ErrorReason::kMissing, "chunk",
                        "is missing: the upload is empty, at least one must follow the header");
  }
  if (header_.mesh().has_file()) {
    return CheckMet("mesh.file.byte_count", header_.mesh().file().byte_count(), file_bytes_.size());
  }
  CAPFIT_RETURN_IF_ERROR(CheckInThrees(positions_field(), coordinate_count_));
  if (!has_polygons_) {
    CAPFIT_RETURN_IF_ERROR(
        CheckInThrees("mesh.arrays.triangle_indices", soup_.face_vertices.size()));
  }
  if (has_polygons_ && corner_count_ != soup_.face_vertices.size()) {
    return InvalidField(ErrorReason::kCountMismatch, "mesh.arrays.face_indices",
                        absl::StrCat("has ", soup_.face_vertices.size(),
                                     " numbers, but face_sizes add up to ", corner_count_),
                        {{"value", absl::StrCat(soup_.face_vertices.size())},
                         {"limit", absl::StrCat(corner_count_)}});
  }
  CAPFIT_RETURN_IF_ERROR(CheckMet("mesh.arrays.vertex_count",
                                  header_.mesh().arrays().vertex_count(), soup_.positions.size()));
  return CheckMet("mesh.arrays.face_count", header_.mesh().arrays().face_count(),
                  soup_.face_count());
}

const char* MeshUpload::positions_field() const {
  return has_double_ ? "mesh.arrays.positions_double" : "mesh.arrays.positions";
}

absl::Status MeshUpload::InCallersWords(const absl::Status& status) const {
  constexpr char kSingle[] = "mesh.arrays.positions[";
  const std::string field = FieldOf(status).value_or("");
  if (!has_double_ || field.rfind(kSingle, 0) != 0) return status;
  return WithField(status, positions_field() + field.substr(sizeof(kSingle) - 2));
}

absl::StatusOr<formats::PolygonSoup> MeshUpload::Finish() && {
  CAPFIT_RETURN_IF_ERROR(CheckComplete());
  if (!header_.mesh().has_file()) return std::move(soup_);
  const formats::MeshFormat format =
      wire::FromWire(header_.mesh().file().format()).value_or(formats::MeshFormat::kUnknown);
  return formats::ReadMesh(std::as_bytes(std::span(file_bytes_)), format, limits_.mesh);
}

}  // namespace capfit::server
