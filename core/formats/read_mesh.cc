#include "core/formats/read_mesh.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/base/status.h"
#include "core/formats/file_error.h"
#include "core/formats/gltf_chunks.h"
#include "core/formats/read_glb.h"
#include "core/formats/read_obj.h"
#include "core/formats/read_off.h"
#include "core/formats/read_ply.h"
#include "core/formats/read_stl.h"
#include "core/formats/text_scanner.h"

namespace capfit::formats {
namespace {

char Lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool StartsWithWord(std::string_view text, std::string_view word) {
  return text.substr(0, word.size()) == word &&
         (text.size() == word.size() || WordScanner::IsBlank(text[word.size()]));
}

// Whether the first statement begins like OFF.
bool LooksLikeOff(std::string_view text) {
  LineScanner lines(text.substr(0, 64 * 1024));
  while (!lines.AtEnd()) {
    const std::string_view word = WordScanner(lines.NextLine()).NextWord();
    if (!word.empty() && word.front() != '#') return IsOffKeyword(word);
  }
  return false;
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

absl::StatusOr<PolygonSoup> ReadAs(MeshFormat format, std::span<const std::byte> bytes,
                                   const MeshLimits& limits) {
  switch (format) {
    case MeshFormat::kObj:
      return ReadObj(AsText(bytes), limits);
    case MeshFormat::kPly:
      return ReadPly(bytes, limits);
    case MeshFormat::kStl:
      return ReadStl(bytes, limits);
    case MeshFormat::kOff:
      return ReadOff(AsText(bytes), limits);
    case MeshFormat::kGlb:
      return ReadGlb(bytes, limits);
    case MeshFormat::kUnknown:
      break;
  }
  return FileError(ErrorReason::kUnsupportedFile, {},
                   "has no known format: give an OBJ, PLY, STL, OFF, GLB, VRM or glTF file");
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
  if (ending == "glb" || ending == "vrm" || ending == "gltf") return MeshFormat::kGlb;
  return MeshFormat::kUnknown;
}

MeshFormat FormatFromBytes(std::span<const std::byte> bytes) {
  const std::string_view text = AsText(bytes);
  if (text.substr(0, 4) == "glTF") return MeshFormat::kGlb;
  if (StartsWithWord(text, "ply")) return MeshFormat::kPly;
  if (HasSizeOfBinaryStl(bytes)) return MeshFormat::kStl;
  if (StartsWithWord(text, "solid")) return MeshFormat::kStl;
  if (LooksLikeGltfText(text)) return MeshFormat::kGlb;
  if (LooksLikeOff(text)) return MeshFormat::kOff;
  if (LooksLikeObj(text)) return MeshFormat::kObj;
  return MeshFormat::kUnknown;
}

absl::StatusOr<PolygonSoup> ReadMesh(std::span<const std::byte> bytes, MeshFormat format,
                                     const MeshLimits& limits) {
  if (bytes.empty()) return FileError(ErrorReason::kMissing, {}, "is empty");
  if (format == MeshFormat::kUnknown) format = FormatFromBytes(bytes);
  CAPFIT_ASSIGN_OR_RETURN(PolygonSoup soup, ReadAs(format, bytes, limits));
  soup.is_from_file = true;
  // What need not be told need not be looked at again.
  if (soup.HasTrianglesOnly()) soup.face_sizes = {};
  return soup;
}

}  // namespace capfit::formats
