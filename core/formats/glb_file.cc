#include "core/formats/glb_file.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/gltf_json.h"
#include "core/formats/text_scanner.h"

namespace capfit::formats {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

// Parsed JSON takes up to thirty times its text. The description of an avatar has some 100 kB.
constexpr std::size_t kMostJsonBytes = 8 << 20;

constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN"

constexpr int kInt8 = 5120;
constexpr int kUint8 = 5121;
constexpr int kInt16 = 5122;
constexpr int kUint16 = 5123;
constexpr int kUint32 = 5125;
constexpr int kFloat32 = 5126;

template <typename Value>
Value Load(const std::byte* bytes) {
  Value value;
  std::memcpy(&value, bytes, sizeof(Value));
  return value;
}

std::uint32_t WordAt(std::span<const std::byte> bytes, std::size_t offset) {
  return Load<std::uint32_t>(bytes.data() + offset);
}

std::optional<std::size_t> SizeOfComponent(int component_type) {
  switch (component_type) {
    case kInt8:
    case kUint8:
      return 1;
    case kInt16:
    case kUint16:
      return 2;
    case kUint32:
    case kFloat32:
      return 4;
    default:
      return std::nullopt;
  }
}

std::size_t ComponentsOf(const std::string& type) {
  return type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 16;
}

template <typename Value>
double LoadScaled(const std::byte* bytes, bool normalized) {
  const auto value = static_cast<double>(Load<Value>(bytes));
  if (!normalized) return value;
  return std::max(value / static_cast<double>(std::numeric_limits<Value>::max()), -1.0);
}

// No size in a file can exceed that of the largest file that fits in memory.
constexpr std::size_t kMostBytes = std::size_t{1} << 48;

// json[key] as a size; `fallback` where it is absent, nothing where it is anything else.
std::optional<std::size_t> SizeAt(const json& parent, const char* key, std::size_t fallback) {
  if (!parent.is_object() || !parent.contains(key)) return fallback;
  return IndexAt(parent, key, kMostBytes);
}

absl::StatusOr<json> ParseJsonChunk(std::span<const std::byte> chunk) {
  if (chunk.size() > kMostJsonBytes) {
    return FileTooLarge({}, chunk.size(), "bytes of JSON", kMostJsonBytes);
  }
  std::optional<json> parsed = ParseGltfJson(AsText(chunk));
  if (parsed.has_value()) return *std::move(parsed);
  return FileError(ErrorReason::kMalformedFile, {}, "has a JSON chunk that is no JSON object");
}

// The place of a buffer view in the binary chunk.
struct ViewRange {
  std::size_t offset = 0;
  std::size_t size = 0;
};

absl::StatusOr<ViewRange> RangeOf(const GlbFile& file, const json& view, const FilePlace& place) {
  if (view.is_object() && view.contains("extensions")) {
    const json& extensions = view["extensions"];
    if (extensions.is_object() && extensions.contains("EXT_meshopt_compression")) {
      return FileError(ErrorReason::kUnsupportedFile, place,
                       "it is compressed with EXT_meshopt_compression, which is not read: export "
                       "uncompressed");
    }
  }
  const json& buffers = ArrayAt(file.json, "buffers");
  const std::optional<std::size_t> buffer = IndexAt(view, "buffer", buffers.size());
  if (!buffer.has_value()) return BadIndexAt(place, view, "buffer", buffers.size());
  if (*buffer != 0 || !buffers[0].is_object() || buffers[0].contains("uri")) {
    return FileError(ErrorReason::kUnsupportedFile, place,
                     "it is not in the file's own binary chunk, and no other file is opened");
  }
  const std::optional<std::size_t> offset = SizeAt(view, "byteOffset", 0);
  const std::optional<std::size_t> size = IndexAt(view, "byteLength", kMostBytes);
  if (!offset.has_value() || !size.has_value()) {
    return FileError(ErrorReason::kMalformedFile, place, "it has a bad offset or length");
  }
  if (*offset > file.binary.size() || *size > file.binary.size() - *offset) {
    return FileError(ErrorReason::kOutOfRange, place,
                     absl::StrCat("it is out of range: it ends at byte ", *offset + *size,
                                  " of the ", file.binary.size(), " in the binary chunk"),
                     ValueAndLimit(*offset + *size, file.binary.size()));
  }
  return ViewRange{*offset, *size};
}

}  // namespace

absl::StatusOr<GlbFile> OpenGlb(std::span<const std::byte> bytes) {
  if (bytes.size() < 20 || WordAt(bytes, 0) != 0x46546C67) {
    return FileError(ErrorReason::kMalformedFile, {},
                     "is no GLB file: it must begin with 'glTF' and a header");
  }
  if (const std::uint32_t version = WordAt(bytes, 4); version != 2) {
    return FileError(ErrorReason::kUnsupportedFile, {},
                     absl::StrCat("is of glTF version ", version, ", must be of version 2"),
                     ValueAndLimit(version, 2));
  }
  const std::size_t length = WordAt(bytes, 8);
  if (length > bytes.size()) {
    return FileError(ErrorReason::kMalformedFile, {},
                     absl::StrCat("ends early: its header claims ", length,
                                  " bytes, but it has only ", bytes.size()),
                     ValueAndLimit(length, bytes.size()));
  }
  bytes = bytes.first(std::max<std::size_t>(length, 20));
  GlbFile file;
  bool has_json = false;
  for (std::size_t offset = 12; offset + 8 <= bytes.size();) {
    const std::size_t size = WordAt(bytes, offset);
    const std::uint32_t type = WordAt(bytes, offset + 4);
    offset += 8;
    if (size > bytes.size() - offset) {
      return FileError(ErrorReason::kMalformedFile, {},
                       absl::StrCat("ends early: a chunk claims ", size, " bytes, but only ",
                                    bytes.size() - offset, " follow"),
                       ValueAndLimit(size, bytes.size() - offset));
    }
    const std::span<const std::byte> chunk = bytes.subspan(offset, size);
    if (type == kJsonChunk && !has_json) {
      CAPFIT_ASSIGN_OR_RETURN(file.json, ParseJsonChunk(chunk));
      has_json = true;
    } else if (type == kBinaryChunk && file.binary.empty()) {
      file.binary = chunk;
    }
    offset += std::min(bytes.size() - offset, (size + 3) / 4 * 4);
  }
  if (!has_json) return FileError(ErrorReason::kMalformedFile, {}, "has no JSON chunk");
  return file;
}

std::optional<std::size_t> IndexAt(const json& parent, const char* key, std::size_t limit) {
  if (!parent.is_object()) return std::nullopt;
  const auto found = parent.find(key);
  if (found == parent.end() || !found->is_number_unsigned()) return std::nullopt;
  const auto value = found->get<std::uint64_t>();
  if (value >= limit) return std::nullopt;
  return value;
}

absl::Status BadIndexAt(const FilePlace& place, const json& parent, const char* key,
                        std::size_t limit) {
  if (!parent.is_object() || !parent.contains(key)) {
    return FileError(ErrorReason::kMalformedFile, place, absl::StrCat(key, " is missing"));
  }
  const json& value = parent[key];
  if (value.is_number_integer()) return FileOutOfRange(place, key, value.dump(), IndexRange(limit));
  return FileError(ErrorReason::kMalformedFile, place, absl::StrCat(key, " is no index"));
}

const json& ArrayAt(const json& parent, const char* key) {
  static const json& kEmpty = *new json(json::array());  // never destroyed: safe at exit
  if (!parent.is_object()) return kEmpty;
  const auto found = parent.find(key);
  return found != parent.end() && found->is_array() ? *found : kEmpty;
}

absl::StatusOr<GltfAccessor> GltfAccessor::Create(const GlbFile& file, std::size_t index,
                                                  const std::string& type) {
  const FilePlace place = AtElement(absl::StrCat("accessor ", index));
  const json& accessors = ArrayAt(file.json, "accessors");
  if (index >= accessors.size()) {
    return FileError(ErrorReason::kMalformedFile, place, "the file has no such accessor");
  }
  const json& accessor = accessors[index];
  GltfAccessor result;
  result.components_ = ComponentsOf(type);
  if (!accessor.is_object() || !accessor.contains("type") || accessor["type"] != type) {
    return FileError(ErrorReason::kMalformedFile, place, "it must be of type " + type);
  }
  if (accessor.contains("sparse")) {
    return FileError(ErrorReason::kUnsupportedFile, place,
                     "sparse accessors are not read: export without morph data or with plain "
                     "accessors");
  }
  result.normalized_ = accessor.contains("normalized") && accessor["normalized"] == true;
  CAPFIT_RETURN_IF_ERROR(result.FindBytes(file, accessor, place));
  return result;
}

absl::Status GltfAccessor::FindBytes(const GlbFile& file, const json& accessor,
                                     const FilePlace& place) {
  const json& views = ArrayAt(file.json, "bufferViews");
  const std::optional<std::size_t> view_index = IndexAt(accessor, "bufferView", views.size());
  if (!view_index.has_value()) return BadIndexAt(place, accessor, "bufferView", views.size());
  const json& view = views[*view_index];
  const std::string view_name = absl::StrCat("buffer view ", *view_index);
  CAPFIT_ASSIGN_OR_RETURN(const ViewRange range, RangeOf(file, view, AtElement(view_name)));
  const std::optional<std::size_t> type = IndexAt(accessor, "componentType", 10'000);
  const std::optional<std::size_t> size = SizeOfComponent(static_cast<int>(type.value_or(0)));
  if (!size.has_value()) {
    return FileError(ErrorReason::kMalformedFile, place, "it has no known component type");
  }
  component_type_ = static_cast<int>(*type);
  const std::size_t element = *size * components_;
  const std::optional<std::size_t> stride = SizeAt(view, "byteStride", element);
  const std::optional<std::size_t> offset = SizeAt(accessor, "byteOffset", 0);
  const std::optional<std::size_t> count = IndexAt(accessor, "count", std::size_t{1} << 32);
  if (!stride.has_value() || *stride < element || *stride > 255 || !offset.has_value() ||
      !count.has_value()) {
    return FileError(ErrorReason::kMalformedFile, place, "it has a bad stride, offset or count");
  }
  // count < 2^32 and stride < 2^8: no overflow.
  const std::size_t needed = *count == 0 ? 0 : *offset + (*count - 1) * *stride + element;
  if (needed > range.size) {
    return FileError(ErrorReason::kOutOfRange, place,
                     absl::StrCat("it is out of range: it needs ", needed, " bytes of ", view_name,
                                  ", which has ", range.size),
                     ValueAndLimit(needed, range.size));
  }
  count_ = *count;
  stride_ = *stride;
  if (count_ > 0) bytes_ = file.binary.subspan(range.offset + *offset, needed - *offset);
  return absl::OkStatus();
}

bool GltfAccessor::IsUnsigned() const {
  return component_type_ == kUint8 || component_type_ == kUint16 || component_type_ == kUint32;
}

double GltfAccessor::At(std::size_t element, std::size_t component) const {
  const std::byte* const bytes =
      bytes_.data() + element * stride_ + component * *SizeOfComponent(component_type_);
  switch (component_type_) {
    case kInt8:
      return LoadScaled<std::int8_t>(bytes, normalized_);
    case kUint8:
      return LoadScaled<std::uint8_t>(bytes, normalized_);
    case kInt16:
      return LoadScaled<std::int16_t>(bytes, normalized_);
    case kUint16:
      return LoadScaled<std::uint16_t>(bytes, normalized_);
    case kUint32:
      return LoadScaled<std::uint32_t>(bytes, normalized_);
    default:
      return static_cast<double>(Load<float>(bytes));
  }
}

}  // namespace capfit::formats
