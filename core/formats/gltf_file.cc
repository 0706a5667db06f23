#include "core/formats/gltf_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/gltf_json.h"
#include "core/formats/gltf_meshopt.h"
#include "core/formats/text_scanner.h"

namespace capfit::formats {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

// Parsed JSON takes up to thirty times its text. The description of an avatar has some 100 kB.
constexpr std::size_t kMostJsonBytes = 8 << 20;
// A longer string in it is a buffer or an image and takes no more than itself.
constexpr std::size_t kLongString = 1024;
constexpr std::size_t kLongestExtension = 64;
constexpr std::size_t kMostUnpackedBytes = 256 << 20;

constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN"

std::uint32_t WordAt(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

// Without what stands in long strings.
std::size_t BytesToParse(std::string_view text) {
  std::size_t bytes = text.size();
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '"') continue;
    const std::size_t begin = ++i;
    while (i < text.size() && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
    const std::size_t length = std::min(i, text.size()) - begin;
    if (length > kLongString) bytes -= length;
  }
  return bytes;
}

absl::StatusOr<json> ParseDescription(std::span<const std::byte> bytes, const char* where,
                                      GltfContent content) {
  if (bytes.size() > kMostJsonBytes) {
    const std::size_t size = BytesToParse(AsText(bytes));
    if (size > kMostJsonBytes) return FileTooLarge({}, size, "bytes of JSON", kMostJsonBytes);
  }
  std::optional<json> parsed = ParseGltfJson(AsText(bytes), content);
  if (parsed.has_value()) return *std::move(parsed);
  return FileError(ErrorReason::kMalformedFile, {},
                   absl::StrCat("has ", where, " that is no JSON object"));
}

// What the extension changes is not where the surface lies: looks, light, sound, movement.
bool IsBesideTheGeometry(std::string_view extension) {
  static constexpr std::array<std::string_view, 15> kBeside = {
      "_materials_", "_texture_", "_lights_",  "_animation", "_audio",
      "_image",      "_xmp",      "VRMC_",     "_interact",  "_rigid_bod",
      "_collision",  "_physics",  "_metadata", "_features",  "MSFT_lod"};
  return extension == "VRM" || std::any_of(kBeside.begin(), kBeside.end(), [&](auto word) {
           return extension.find(word) != std::string_view::npos;
         });
}

absl::Status CheckRequiredExtensions(const json& gltf) {
  static constexpr std::array<std::string_view, 3> kRead = {
      "KHR_mesh_quantization", "KHR_draco_mesh_compression", kMeshoptExtension};
  for (const json& extension : ArrayAt(gltf, "extensionsRequired")) {
    if (!extension.is_string()) continue;
    const auto& name = extension.get_ref<const std::string&>();
    if (std::find(kRead.begin(), kRead.end(), name) != kRead.end()) continue;
    if (IsBesideTheGeometry(name)) continue;
    return FileError(ErrorReason::kUnsupportedFile, {},
                     absl::StrCat("requires the extension ", Printable(name, kLongestExtension),
                                  ", which is not read: export without it"));
  }
  return absl::OkStatus();
}

absl::Status CheckVersion(const json& gltf) {
  const std::string version = NameAt(ValueAt(gltf, "asset"), "version");
  if (version.empty() || version.front() == '2') return absl::OkStatus();
  return FileError(
      ErrorReason::kUnsupportedFile, {},
      absl::StrCat("is of glTF version ", Printable(version), ", must be of version 2"),
      ValueAndLimit(Printable(version), 2));
}

// What stands behind "data:TYPE;base64,"; nothing for other addresses.
std::optional<std::string_view> Base64Of(std::string_view uri) {
  const std::size_t comma = uri.substr(0, kLongString).find(',');
  if (uri.substr(0, 5) != "data:" || comma == std::string_view::npos) return std::nullopt;
  constexpr std::string_view kEnding = ";base64";
  const std::string_view kind = uri.substr(0, comma);
  if (kind.size() < kEnding.size() || kind.substr(kind.size() - kEnding.size()) != kEnding) {
    return std::nullopt;
  }
  return uri.substr(comma + 1);
}

}  // namespace

absl::StatusOr<GltfFile> GltfFile::Open(std::span<const std::byte> bytes, GltfContent content) {
  GltfFile file;
  const bool is_text = AsText(bytes).substr(0, 4) != "glTF" && LooksLikeGltfText(AsText(bytes));
  CAPFIT_RETURN_IF_ERROR(is_text ? file.OpenText(bytes, content) : file.OpenChunks(bytes, content));
  CAPFIT_RETURN_IF_ERROR(CheckVersion(file.json_));
  CAPFIT_RETURN_IF_ERROR(CheckRequiredExtensions(file.json_));
  CAPFIT_RETURN_IF_ERROR(file.UnpackBuffers());
  return file;
}

absl::Status GltfFile::OpenText(std::span<const std::byte> bytes, GltfContent content) {
  CAPFIT_ASSIGN_OR_RETURN(json_, ParseDescription(bytes, "text", content));
  return absl::OkStatus();
}

absl::Status GltfFile::OpenChunks(std::span<const std::byte> bytes, GltfContent content) {
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
      CAPFIT_ASSIGN_OR_RETURN(json_, ParseDescription(chunk, "a JSON chunk", content));
      has_json = true;
    } else if (type == kBinaryChunk && binary_.empty()) {
      binary_ = chunk;
    }
    offset += std::min(bytes.size() - offset, (size + 3) / 4 * 4);
  }
  if (!has_json) return FileError(ErrorReason::kMalformedFile, {}, "has no JSON chunk");
  return absl::OkStatus();
}

absl::Status GltfFile::UnpackBuffers() {
  const auto buffers = json_.find("buffers");
  if (buffers == json_.end() || !buffers->is_array()) return absl::OkStatus();
  unpacked_buffers_.resize(buffers->size());
  for (std::size_t b = 0; b < buffers->size(); ++b) {
    json& buffer = (*buffers)[b];
    if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string()) continue;
    const auto& uri = buffer["uri"].get_ref<const std::string&>();
    const std::optional<std::string_view> base64 = Base64Of(uri);
    if (!base64.has_value()) continue;
    std::string& unpacked = unpacked_buffers_[b].emplace();
    if (!absl::Base64Unescape({base64->data(), base64->size()}, &unpacked)) {
      return FileError(ErrorReason::kMalformedFile, AtElement(absl::StrCat("buffer ", b)),
                       "its data is no base64");
    }
    buffer["uri"] = "data:";  // it may be large, and has served
  }
  return absl::OkStatus();
}

absl::StatusOr<std::span<const std::byte>> GltfFile::Range(const json& view,
                                                           const FilePlace& place) const {
  const json& buffers = ArrayAt(json_, "buffers");
  const std::optional<std::size_t> index = IndexAt(view, "buffer", buffers.size());
  if (!index.has_value()) return BadIndexAt(place, view, "buffer", buffers.size());
  const std::string uri = NameAt(buffers[*index], "uri");
  std::span<const std::byte> buffer = binary_;
  const bool is_unpacked = unpacked_buffers_[*index].has_value();
  if (is_unpacked) {
    buffer = std::as_bytes(std::span(*unpacked_buffers_[*index]));
  } else if (*index != 0 || !buffers[0].is_object() || buffers[0].contains("uri")) {
    return FileError(ErrorReason::kUnsupportedFile, place,
                     absl::StrCat("its bytes are not in the file",
                                  uri.empty() ? std::string() : " but in " + Quoted(uri),
                                  ", and no other file is opened: export as GLB, in one file"));
  }
  const std::optional<std::size_t> offset = SizeAt(view, "byteOffset", 0);
  const std::optional<std::size_t> size = IndexAt(view, "byteLength", kMostFileBytes);
  if (!offset.has_value() || !size.has_value()) {
    return FileError(ErrorReason::kMalformedFile, place, "it has a bad offset or length");
  }
  if (*offset > buffer.size() || *size > buffer.size() - *offset) {
    return FileError(
        ErrorReason::kOutOfRange, place,
        absl::StrCat("it is out of range: it ends at byte ", *offset + *size, " of the ",
                     buffer.size(), is_unpacked ? " in the buffer" : " in the binary chunk"),
        ValueAndLimit(*offset + *size, buffer.size()));
  }
  return buffer.subspan(*offset, *size);
}

absl::StatusOr<std::span<const std::byte>> GltfFile::View(std::size_t index) {
  const json& view = ArrayAt(json_, "bufferViews")[index];
  const FilePlace place = AtElement(absl::StrCat("buffer view ", index));
  const json& packed = ExtensionAt(view, kMeshoptExtension);
  if (!packed.is_object()) return Range(view, place);
  const auto found = unpacked_views_.find(index);
  if (found != unpacked_views_.end()) return std::span<const std::byte>(found->second);
  CAPFIT_ASSIGN_OR_RETURN(const std::span<const std::byte> bytes, Range(packed, place));
  CAPFIT_ASSIGN_OR_RETURN(const MeshoptLayout layout,
                          ReadMeshoptLayout(packed, bytes.size(), place));
  CAPFIT_RETURN_IF_ERROR(Claim(layout.size(), place));
  CAPFIT_ASSIGN_OR_RETURN(std::vector<std::byte> unpacked, DecodeMeshopt(layout, bytes, place));
  return std::span<const std::byte>(
      unpacked_views_.emplace(index, std::move(unpacked)).first->second);
}

absl::Status GltfFile::Claim(std::size_t bytes, const FilePlace& place) {
  if (bytes > kMostUnpackedBytes - claimed_bytes_) {
    return FileTooLarge(place, claimed_bytes_ + bytes, "unpacked bytes", kMostUnpackedBytes);
  }
  claimed_bytes_ += bytes;
  return absl::OkStatus();
}

bool LooksLikeGltfText(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);  // byte order mark
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && text[begin] == '{';
}

}  // namespace capfit::formats
