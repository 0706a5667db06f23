#include "core/formats/gltf_chunks.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/file_error.h"
#include "core/formats/text_scanner.h"

namespace capfit::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

// Parsed JSON takes up to thirty times its text. The description of an avatar has some 100 kB.
constexpr std::size_t kMostJsonBytes = 8 << 20;
// A longer string in it is a buffer or an image and takes no more than itself.
constexpr std::size_t kLongString = 1024;

constexpr std::uint32_t kMagic = 0x46546C67;        // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN"
constexpr std::size_t kFileHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

std::uint32_t WordAt(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

void AppendWord(std::size_t value, std::string& bytes) {
  const auto word = static_cast<std::uint32_t>(value);
  bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
}

std::size_t Padded(std::size_t size) { return (size + 3) / 4 * 4; }

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

absl::Status CheckDescription(std::string_view text) {
  if (text.size() <= kMostJsonBytes) return absl::OkStatus();
  const std::size_t size = BytesToParse(text);
  if (size <= kMostJsonBytes) return absl::OkStatus();
  return FileTooLarge({}, size, "bytes of JSON", kMostJsonBytes);
}

absl::Status CheckGlbHeader(std::span<const std::byte> bytes) {
  if (!LooksLikeGlb(bytes)) {
    return FileError(ErrorReason::kMalformedFile, {},
                     "is no GLB file: it must begin with 'glTF' and a header");
  }
  if (const std::uint32_t version = WordAt(bytes, 4); version != 2) {
    return FileError(ErrorReason::kUnsupportedFile, {},
                     absl::StrCat("is of glTF version ", version, ", must be of version 2"),
                     ValueAndLimit(version, 2));
  }
  const std::size_t length = WordAt(bytes, 8);
  if (length <= bytes.size()) return absl::OkStatus();
  return FileError(ErrorReason::kMalformedFile, {},
                   absl::StrCat("ends early: its header claims ", length,
                                " bytes, but it has only ", bytes.size()),
                   ValueAndLimit(length, bytes.size()));
}

absl::StatusOr<GltfChunks> SplitChunks(std::span<const std::byte> bytes) {
  CAPFIT_RETURN_IF_ERROR(CheckGlbHeader(bytes));
  bytes =
      bytes.first(std::max<std::size_t>(WordAt(bytes, 8), kFileHeaderBytes + kChunkHeaderBytes));
  GltfChunks chunks;
  bool has_json = false;
  for (std::size_t offset = kFileHeaderBytes; offset + kChunkHeaderBytes <= bytes.size();) {
    const std::size_t begin = offset;
    const std::size_t size = WordAt(bytes, offset);
    const std::uint32_t type = WordAt(bytes, offset + 4);
    offset += kChunkHeaderBytes;
    if (size > bytes.size() - offset) {
      return FileError(ErrorReason::kMalformedFile, {},
                       absl::StrCat("ends early: a chunk claims ", size, " bytes, but only ",
                                    bytes.size() - offset, " follow"),
                       ValueAndLimit(size, bytes.size() - offset));
    }
    const std::span<const std::byte> chunk = bytes.subspan(offset, size);
    if (type == kJsonChunk && !has_json) {
      chunks.description = AsText(chunk);
      has_json = true;
    } else if (type == kBinaryChunk && chunks.binary.empty()) {
      chunks.binary = chunk;
    } else {
      chunks.others.push_back(bytes.subspan(begin, kChunkHeaderBytes + size));
    }
    offset += std::min(bytes.size() - offset, Padded(size));
  }
  if (!has_json) return FileError(ErrorReason::kMalformedFile, {}, "has no JSON chunk");
  return chunks;
}

}  // namespace

bool LooksLikeGlb(std::span<const std::byte> bytes) {
  return bytes.size() >= kFileHeaderBytes + kChunkHeaderBytes && WordAt(bytes, 0) == kMagic;
}

bool LooksLikeGltfText(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);  // byte order mark
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && text[begin] == '{';
}

absl::StatusOr<GltfChunks> SplitGltf(std::span<const std::byte> bytes) {
  GltfChunks chunks;
  if (AsText(bytes).substr(0, 4) != "glTF" && LooksLikeGltfText(AsText(bytes))) {
    chunks.description = AsText(bytes);
  } else {
    CAPFIT_ASSIGN_OR_RETURN(chunks, SplitChunks(bytes));
  }
  CAPFIT_RETURN_IF_ERROR(CheckDescription(chunks.description));
  return chunks;
}

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

absl::StatusOr<std::string> JoinGltf(const GltfChunks& chunks) {
  const std::size_t text = Padded(chunks.description.size());
  const std::size_t binary = Padded(chunks.binary.size());
  std::size_t total = kFileHeaderBytes + kChunkHeaderBytes + text;
  if (binary > 0) total += kChunkHeaderBytes + binary;
  for (const std::span<const std::byte> other : chunks.others) total += Padded(other.size());
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (total > kMost) return FileTooLarge({}, total, "bytes with its colliders", kMost);
  std::string bytes;
  bytes.reserve(total);
  AppendWord(kMagic, bytes);
  AppendWord(2, bytes);
  AppendWord(total, bytes);
  AppendWord(text, bytes);
  AppendWord(kJsonChunk, bytes);
  bytes.append(chunks.description);
  bytes.resize(Padded(bytes.size()), ' ');
  if (binary > 0) {
    AppendWord(binary, bytes);
    AppendWord(kBinaryChunk, bytes);
    bytes.append(AsText(chunks.binary));
    bytes.resize(Padded(bytes.size()), '\0');
  }
  for (const std::span<const std::byte> other : chunks.others) {
    bytes.append(AsText(other));
    bytes.resize(Padded(bytes.size()), '\0');
  }
  return bytes;
}

}  // namespace capfit::formats
