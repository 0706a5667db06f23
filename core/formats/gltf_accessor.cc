#include "core/formats/gltf_accessor.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/gltf_json.h"

namespace capfit::formats {
namespace {

using nlohmann::json;

constexpr std::size_t kMostElements = std::size_t{1} << 32;
constexpr std::size_t kLargestStride = 255;
// One element of the largest type, of which an accessor without bytes consists.
constexpr std::array<std::byte, 64> kZeros = {};

template <typename Value>
Value Load(const std::byte* bytes) {
  Value value;
  std::memcpy(&value, bytes, sizeof(Value));
  return value;
}

std::size_t SizeOf(GltfComponent type) {
  switch (type) {
    case GltfComponent::kInt8:
    case GltfComponent::kUint8:
      return 1;
    case GltfComponent::kInt16:
    case GltfComponent::kUint16:
      return 2;
    case GltfComponent::kUint32:
    case GltfComponent::kFloat32:
      return 4;
  }
  return 4;
}

std::optional<GltfComponent> ComponentAt(const json& parent) {
  switch (IndexAt(parent, "componentType", 10'000).value_or(0)) {
    case 5120:
      return GltfComponent::kInt8;
    case 5121:
      return GltfComponent::kUint8;
    case 5122:
      return GltfComponent::kInt16;
    case 5123:
      return GltfComponent::kUint16;
    case 5125:
      return GltfComponent::kUint32;
    case 5126:
      return GltfComponent::kFloat32;
    default:
      return std::nullopt;
  }
}

std::size_t ComponentsOf(const std::string& type) {
  return type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

template <typename Value>
double LoadScaled(const std::byte* bytes, bool normalized) {
  const auto value = static_cast<double>(Load<Value>(bytes));
  if (!normalized) return value;
  return std::max(value / static_cast<double>(std::numeric_limits<Value>::max()), -1.0);
}

// `bytes` from `offset` on, where `count` elements of `stride` fit.
struct Rows {
  std::size_t count = 0;
  std::size_t element = 0;  // bytes
  std::size_t stride = 0;
  std::size_t offset = 0;

  // count < 2^32, stride < 2^8: no overflow.
  [[nodiscard]] std::size_t end() const {
    return count == 0 ? 0 : offset + (count - 1) * stride + element;
  }
};

absl::StatusOr<std::span<const std::byte>> BytesOf(GltfFile& file, std::size_t view_index,
                                                   const Rows& rows, const FilePlace& place) {
  CAPFIT_ASSIGN_OR_RETURN(const std::span<const std::byte> view, file.View(view_index));
  if (rows.end() > view.size()) {
    return FileError(
        ErrorReason::kOutOfRange, place,
        absl::StrCat("it is out of range: it needs ", rows.end(), " bytes of buffer view ",
                     view_index, ", which has ", view.size()),
        ValueAndLimit(rows.end(), view.size()));
  }
  return rows.count == 0 ? std::span<const std::byte>()
                         : view.subspan(rows.offset, rows.end() - rows.offset);
}

absl::Status BadLayout(const FilePlace& place) {
  return FileError(ErrorReason::kMalformedFile, place, "it has a bad stride, offset or count");
}

// One of the two arrays of a sparse accessor.
absl::StatusOr<std::span<const std::byte>> SparseBytes(GltfFile& file, const json& part,
                                                       std::size_t count, std::size_t element,
                                                       const FilePlace& place) {
  const std::size_t views = ArrayAt(file.description(), "bufferViews").size();
  const std::optional<std::size_t> view = IndexAt(part, "bufferView", views);
  if (!view.has_value()) return BadIndexAt(place, part, "bufferView", views);
  const std::optional<std::size_t> offset = SizeAt(part, "byteOffset", 0);
  if (!offset.has_value()) return BadLayout(place);
  return BytesOf(file, *view, {count, element, element, *offset}, place);
}

}  // namespace

absl::StatusOr<GltfAccessor> GltfAccessor::Create(GltfFile& file, std::size_t index,
                                                  const std::string& type) {
  const FilePlace place = AtElement(absl::StrCat("accessor ", index));
  const json& accessors = ArrayAt(file.description(), "accessors");
  if (index >= accessors.size()) {
    return FileError(ErrorReason::kMalformedFile, place, "the file has no such accessor");
  }
  const json& accessor = accessors[index];
  GltfAccessor result;
  result.components_ = ComponentsOf(type);
  if (ValueAt(accessor, "type") != type) {
    return FileError(ErrorReason::kMalformedFile, place, "it must be of type " + type);
  }
  result.normalized_ = ValueAt(accessor, "normalized") == true;
  CAPFIT_RETURN_IF_ERROR(result.ReadLayout(accessor, place));
  CAPFIT_RETURN_IF_ERROR(result.FindBytes(file, accessor, place));
  const json& sparse = ValueAt(accessor, "sparse");
  if (!sparse.is_null()) CAPFIT_RETURN_IF_ERROR(result.ReplaceSparse(file, sparse, place));
  return result;
}

GltfAccessor GltfAccessor::FromBytes(std::vector<std::byte> bytes, std::size_t components,
                                     GltfComponent type, bool normalized) {
  GltfAccessor result;
  result.components_ = components;
  result.type_ = type;
  result.normalized_ = normalized;
  result.stride_ = result.element_size();
  result.count_ = bytes.size() / result.stride_;
  result.own_ = std::make_shared<std::vector<std::byte>>(std::move(bytes));
  result.bytes_ = *result.own_;
  return result;
}

std::size_t GltfAccessor::element_size() const { return SizeOf(type_) * components_; }

absl::Status GltfAccessor::ReadLayout(const json& accessor, const FilePlace& place) {
  const std::optional<GltfComponent> type = ComponentAt(accessor);
  if (!type.has_value()) {
    return FileError(ErrorReason::kMalformedFile, place, "it has no known component type");
  }
  const std::optional<std::size_t> count = IndexAt(accessor, "count", kMostElements);
  if (!count.has_value()) return BadLayout(place);
  type_ = *type;
  count_ = *count;
  return absl::OkStatus();
}

absl::Status GltfAccessor::FindBytes(GltfFile& file, const json& accessor, const FilePlace& place) {
  if (!accessor.contains("bufferView")) {
    bytes_ = kZeros;
    stride_ = 0;
    return absl::OkStatus();
  }
  const json& views = ArrayAt(file.description(), "bufferViews");
  const std::optional<std::size_t> view_index = IndexAt(accessor, "bufferView", views.size());
  if (!view_index.has_value()) return BadIndexAt(place, accessor, "bufferView", views.size());
  const std::optional<std::size_t> stride =
      SizeAt(views[*view_index], "byteStride", element_size());
  const std::optional<std::size_t> offset = SizeAt(accessor, "byteOffset", 0);
  if (!stride.has_value() || *stride < element_size() || *stride > kLargestStride ||
      !offset.has_value()) {
    return BadLayout(place);
  }
  stride_ = *stride;
  CAPFIT_ASSIGN_OR_RETURN(
      bytes_, BytesOf(file, *view_index, {count_, element_size(), stride_, *offset}, place));
  return absl::OkStatus();
}

// Becomes a copy, in which some elements are others.
absl::Status GltfAccessor::ReplaceSparse(GltfFile& file, const json& sparse,
                                         const FilePlace& place) {
  const std::size_t element = element_size();
  const json& indices = ValueAt(sparse, "indices");
  const std::optional<GltfComponent> index_type = ComponentAt(indices);
  const std::optional<std::size_t> count = IndexAt(sparse, "count", count_ + 1);
  if (!count.has_value()) return BadIndexAt(place, sparse, "count", count_ + 1);
  if (!index_type.has_value() || index_type == GltfComponent::kFloat32) {
    return FileError(ErrorReason::kMalformedFile, place, "its sparse indices have no known type");
  }
  const std::size_t index_size = SizeOf(*index_type);
  CAPFIT_ASSIGN_OR_RETURN(const std::span<const std::byte> index_bytes,
                          SparseBytes(file, indices, *count, index_size, place));
  CAPFIT_ASSIGN_OR_RETURN(const std::span<const std::byte> values,
                          SparseBytes(file, ValueAt(sparse, "values"), *count, element, place));
  CAPFIT_RETURN_IF_ERROR(file.Claim(count_ * element, place));
  auto all = std::make_shared<std::vector<std::byte>>(count_ * element);
  for (std::size_t i = 0; i < count_; ++i) {
    std::memcpy(all->data() + i * element, bytes_.data() + i * stride_, element);
  }
  for (std::size_t k = 0; k < *count; ++k) {
    std::uint32_t to = 0;  // little-endian
    std::memcpy(&to, index_bytes.data() + k * index_size, index_size);
    if (to >= count_) {
      return FileOutOfRange(place, absl::StrCat("its sparse index ", k), to, IndexRange(count_));
    }
    std::memcpy(all->data() + to * element, values.data() + k * element, element);
  }
  own_ = std::move(all);
  bytes_ = *own_;
  stride_ = element;
  return absl::OkStatus();
}

bool GltfAccessor::IsUnsigned() const {
  return type_ == GltfComponent::kUint8 || type_ == GltfComponent::kUint16 ||
         type_ == GltfComponent::kUint32;
}

double GltfAccessor::At(std::size_t element, std::size_t component) const {
  const std::byte* const bytes = bytes_.data() + element * stride_ + component * SizeOf(type_);
  switch (type_) {
    case GltfComponent::kInt8:
      return LoadScaled<std::int8_t>(bytes, normalized_);
    case GltfComponent::kUint8:
      return LoadScaled<std::uint8_t>(bytes, normalized_);
    case GltfComponent::kInt16:
      return LoadScaled<std::int16_t>(bytes, normalized_);
    case GltfComponent::kUint16:
      return LoadScaled<std::uint16_t>(bytes, normalized_);
    case GltfComponent::kUint32:
      return LoadScaled<std::uint32_t>(bytes, normalized_);
    case GltfComponent::kFloat32:
      return static_cast<double>(Load<float>(bytes));
  }
  return 0.0;
}

Eigen::Vector3d GltfAccessor::VectorAt(std::size_t element) const {
  if (type_ == GltfComponent::kFloat32) {
    const std::byte* const bytes = bytes_.data() + element * stride_;
    return {Load<float>(bytes), Load<float>(bytes + 4), Load<float>(bytes + 8)};
  }
  return {At(element, 0), At(element, 1), At(element, 2)};
}

}  // namespace capfit::formats
