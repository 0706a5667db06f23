#include "core/formats/gltf_meshopt.h"

#include <meshoptimizer.h>

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/status.h"
#include "core/formats/gltf_json.h"

namespace capfit::formats {
namespace {

using nlohmann::json;

constexpr std::size_t kMeshoptStride = 256;  // the codec's
constexpr std::size_t kMeshoptElements = std::size_t{1} << 32;
// The codec spends at least four bytes for one byte of each of 256 vertices, and one for a
// triangle.
constexpr std::size_t kMostUnpackedPerByte = 64;

std::optional<MeshoptMode> ModeOf(const std::string& name) {
  if (name == "ATTRIBUTES") return MeshoptMode::kAttributes;
  if (name == "TRIANGLES") return MeshoptMode::kTriangles;
  if (name == "INDICES") return MeshoptMode::kIndices;
  return std::nullopt;
}

std::optional<MeshoptFilter> FilterOf(const std::string& name) {
  if (name.empty() || name == "NONE") return MeshoptFilter::kNone;
  if (name == "OCTAHEDRAL") return MeshoptFilter::kOctahedral;
  if (name == "QUATERNION") return MeshoptFilter::kQuaternion;
  if (name == "EXPONENTIAL") return MeshoptFilter::kExponential;
  return std::nullopt;
}

// What the decoder asserts.
bool IsDecodable(const MeshoptLayout& layout) {
  const std::size_t stride = layout.stride;
  if (layout.mode != MeshoptMode::kAttributes) {
    const bool has_triangles = layout.mode == MeshoptMode::kIndices || layout.count % 3 == 0;
    return has_triangles && (stride == 2 || stride == 4) && layout.filter == MeshoptFilter::kNone;
  }
  if (stride == 0 || stride % 4 != 0 || stride > kMeshoptStride) return false;
  if (layout.filter == MeshoptFilter::kOctahedral) return stride == 4 || stride == 8;
  return layout.filter != MeshoptFilter::kQuaternion || stride == 8;
}

int Decode(const MeshoptLayout& layout, std::span<const std::byte> packed, std::byte* to) {
  const auto* const from = reinterpret_cast<const unsigned char*>(packed.data());
  switch (layout.mode) {
    case MeshoptMode::kAttributes:
      return meshopt_decodeVertexBuffer(to, layout.count, layout.stride, from, packed.size());
    case MeshoptMode::kTriangles:
      return meshopt_decodeIndexBuffer(to, layout.count, layout.stride, from, packed.size());
    case MeshoptMode::kIndices:
      return meshopt_decodeIndexSequence(to, layout.count, layout.stride, from, packed.size());
  }
  return -1;
}

void ApplyFilter(const MeshoptLayout& layout, std::byte* bytes) {
  switch (layout.filter) {
    case MeshoptFilter::kNone:
      return;
    case MeshoptFilter::kOctahedral:
      return meshopt_decodeFilterOct(bytes, layout.count, layout.stride);
    case MeshoptFilter::kQuaternion:
      return meshopt_decodeFilterQuat(bytes, layout.count, layout.stride);
    case MeshoptFilter::kExponential:
      return meshopt_decodeFilterExp(bytes, layout.count, layout.stride);
  }
}

}  // namespace

absl::StatusOr<MeshoptLayout> ReadMeshoptLayout(const json& extension, std::size_t packed_bytes,
                                                const FilePlace& place) {
  const std::string mode_name = NameAt(extension, "mode");
  const std::string filter_name = NameAt(extension, "filter");
  const std::optional<MeshoptMode> mode = ModeOf(mode_name);
  const std::optional<MeshoptFilter> filter = FilterOf(filter_name);
  if (!mode.has_value() || !filter.has_value()) {
    return FileError(ErrorReason::kUnsupportedFile, place,
                     absl::StrCat("its ", kMeshoptExtension, " has the mode ", Quoted(mode_name),
                                  " and the filter ", Quoted(filter_name),
                                  ", which are not read: export uncompressed"));
  }
  const std::optional<std::size_t> count = IndexAt(extension, "count", kMeshoptElements);
  const std::optional<std::size_t> stride = IndexAt(extension, "byteStride", kMeshoptStride + 1);
  const MeshoptLayout layout = {*mode, *filter, count.value_or(0), stride.value_or(0)};
  if (!count.has_value() || !IsDecodable(layout)) {
    return FileError(
        ErrorReason::kMalformedFile, place,
        absl::StrCat("its ", kMeshoptExtension, " has a count, stride or filter that cannot be"));
  }
  if (layout.size() > kMostUnpackedPerByte * packed_bytes) {
    return FileError(ErrorReason::kOutOfRange, place,
                     absl::StrCat("its ", kMeshoptExtension, " claims to unpack to ", layout.size(),
                                  " bytes, which ", packed_bytes, " packed ones cannot hold"),
                     ValueAndLimit(layout.size(), kMostUnpackedPerByte * packed_bytes));
  }
  return layout;
}

absl::StatusOr<std::vector<std::byte>> DecodeMeshopt(const MeshoptLayout& layout,
                                                     std::span<const std::byte> packed,
                                                     const FilePlace& place) {
  std::vector<std::byte> unpacked(layout.size());
  if (layout.count == 0) return unpacked;
  const int result = Decode(layout, packed, unpacked.data());
  if (result == -1) {  // not its magic byte, or of a later version
    return FileError(ErrorReason::kUnsupportedFile, place,
                     absl::StrCat("its ", kMeshoptExtension,
                                  " is not of the codec's version 0, the one that is read"));
  }
  if (result != 0) {
    return FileError(ErrorReason::kMalformedFile, place,
                     absl::StrCat("its ", kMeshoptExtension, " data is damaged"));
  }
  ApplyFilter(layout, unpacked.data());
  return unpacked;
}

}  // namespace capfit::formats
