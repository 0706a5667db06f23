#include "core/mesh/read_mesh.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "core/base/status.h"
#include "core/mesh/read_obj.h"
#include "core/mesh/read_ply.h"
#include "core/mesh/text_scanner.h"

namespace capfit::mesh {
namespace {

char Lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool StartsWithWord(std::string_view text, std::string_view word) {
  return text.substr(0, word.size()) == word &&
         (text.size() == word.size() || WordScanner::IsBlank(text[word.size()]));
}

// Whether the first statements look like OBJ: vertices, or what may come before them.
bool LooksLikeObj(std::string_view text) {
  LineScanner lines(text.substr(0, 64 * 1024));
  while (!lines.AtEnd()) {
    const std::string_view keyword = WordScanner(lines.NextLine()).NextWord();
    if (keyword == "v") return true;
    if (keyword.empty() || keyword.front() == '#') continue;
    constexpr std::string_view kOther[] = {"mtllib", "o", "g", "s", "vt", "vn", "usemtl", "f"};
    if (std::find(std::begin(kOther), std::end(kOther), keyword) == std::end(kOther)) return false;
  }
  return false;
}

// A binary STL may begin with any 80 bytes, but its size follows from its count.
bool HasSizeOfBinaryStl(std::string_view bytes) {
  if (bytes.size() < 84) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return bytes.size() == 84 + std::uint64_t{50} * count;
}

}  // namespace

MeshFormat FormatFromFileName(const std::string& file_name) {
  const std::size_t dot = file_name.rfind('.');
  if (dot == std::string::npos) return MeshFormat::kUnknown;
  std::string ending = file_name.substr(dot + 1);
  std::transform(ending.begin(), ending.end(), ending.begin(), Lower);
  if (ending == "obj") return MeshFormat::kObj;
  if (ending == "ply") return MeshFormat::kPly;
  if (ending == "stl") return MeshFormat::kStl;
  if (ending == "off") return MeshFormat::kOff;
  if (ending == "glb") return MeshFormat::kGlb;
  return MeshFormat::kUnknown;
}

MeshFormat FormatFromBytes(std::span<const std::byte> bytes) {
  const std::string_view text = AsText(bytes);
  if (text.substr(0, 4) == "glTF") return MeshFormat::kGlb;
  if (StartsWithWord(text, "ply")) return MeshFormat::kPly;
  if (HasSizeOfBinaryStl(text)) return MeshFormat::kStl;
  if (StartsWithWord(text, "solid")) return MeshFormat::kStl;
  const std::string_view first_word = WordScanner(text.substr(0, 64)).NextWord();
  if (first_word.size() >= 3 && first_word.size() <= 6 &&
      first_word.substr(first_word.size() - 3) == "OFF") {
    return MeshFormat::kOff;
  }
  if (LooksLikeObj(text)) return MeshFormat::kObj;
  return MeshFormat::kUnknown;
}

absl::StatusOr<PolygonSoup> ReadMesh(std::span<const std::byte> bytes, MeshFormat format,
                                     const MeshLimits& limits) {
  if (bytes.empty()) return InvalidField("file", "is empty");
  if (format == MeshFormat::kUnknown) format = FormatFromBytes(bytes);
  switch (format) {
    case MeshFormat::kObj:
      return ReadObj(AsText(bytes), limits);
    case MeshFormat::kPly:
      return ReadPly(bytes, limits);
    case MeshFormat::kStl:
    case MeshFormat::kOff:
    case MeshFormat::kGlb:
    case MeshFormat::kUnknown:
      break;
  }
  return InvalidField("file", "has no known format: give an OBJ, PLY, STL, OFF or GLB file");
}

}  // namespace capfit::mesh
