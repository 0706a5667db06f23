#include "core/formats/read_obj.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/file_error.h"
#include "core/formats/soup_checks.h"
#include "core/formats/text_scanner.h"

namespace capfit::formats {
namespace {

class ObjReader {
 public:
  ObjReader(std::string_view text, const MeshLimits& limits)
      : lines_(text), limits_(limits), triangles_(limits) {}

  absl::StatusOr<PolygonSoup> Run() {
    while (!lines_.AtEnd()) CAPFIT_RETURN_IF_ERROR(ReadLine(NextStatement()));
    if (soup_.positions.empty()) {
      return FileError(ErrorReason::kMissing, {},
                       "holds nothing to read: an OBJ file has lines 'v x y z'");
    }
    if (highest_index_ >= soup_.positions.size() && !soup_.face_vertices.empty()) {
      return FileOutOfRange(AtLine(highest_index_line_), CornerOf(highest_index_face_),
                            highest_index_ + 1, absl::StrCat("[1, ", soup_.positions.size(), "]"));
    }
    return std::move(soup_);
  }

 private:
  // The next line, joined with those that a backslash at its end continues it on.
  std::string_view NextStatement() {
    std::string_view line = lines_.NextLine();
    if (line.empty() || line.back() != '\\') return line;
    joined_.clear();
    while (!line.empty() && line.back() == '\\') {
      line.remove_suffix(1);
      joined_.append(line).push_back(' ');
      line = lines_.AtEnd() ? std::string_view() : lines_.NextLine();
    }
    return joined_.append(line);
  }

  absl::Status ReadLine(std::string_view line) {
    WordScanner words(line);
    const std::string_view keyword = words.NextWord();
    if (keyword == "v") return ReadVertex(words);
    if (keyword == "f" || keyword == "fo") return ReadFace(words);
    return absl::OkStatus();
  }

  absl::Status ReadVertex(WordScanner words) {
    if (soup_.positions.size() >= limits_.max_vertices) {
      return FileTooLarge(Here(), soup_.positions.size() + 1, "vertices", limits_.max_vertices);
    }
    return ReadPosition(lines_.number(), words, soup_.positions.emplace_back());
  }

  absl::Status ReadFace(WordScanner words) {
    if (soup_.face_sizes.size() >= limits_.max_faces) {
      return FileTooLarge(Here(), soup_.face_sizes.size() + 1, "faces", limits_.max_faces);
    }
    std::uint32_t corners = 0;
    for (std::string_view word = words.NextWord(); !word.empty() && word.front() != '#';
         word = words.NextWord()) {
      if (++corners > limits_.max_corners_per_face) {
        return FaceError(ErrorReason::kTooLarge,
                         absl::StrCat("has more than ", limits_.max_corners_per_face, " corners"),
                         ValueAndLimit(corners, limits_.max_corners_per_face));
      }
      CAPFIT_RETURN_IF_ERROR(ReadCorner(word));
    }
    if (corners < 3) {
      return FaceError(
          ErrorReason::kMalformedFile,
          absl::StrCat("has ", corners, " corners, must have at least 3"),
          ValueAndLimit(corners, absl::StrCat("[3, ", limits_.max_corners_per_face, "]")));
    }
    if (!triangles_.Add(corners)) return TooManyTriangles(Here(), limits_);
    soup_.face_sizes.push_back(corners);
    return absl::OkStatus();
  }

  // "7", "7/1", "7//3", "7/1/3", "-2": only the vertex counts.
  absl::Status ReadCorner(std::string_view word) {
    const std::string_view vertex = word.substr(0, word.find('/'));
    const std::optional<std::int64_t> number = ParseNumber<std::int64_t>(vertex);
    const auto limit = static_cast<std::int64_t>(limits_.max_vertices);
    const auto count = static_cast<std::int64_t>(soup_.positions.size());
    if (!number.has_value()) {
      return BadNumber<std::int64_t>(Here(), CornerOf(soup_.face_sizes.size()),
                                     vertex.empty() ? word : vertex,
                                     absl::StrCat("[1, ", limit, "]"));
    }
    if (*number == 0 || *number > limit || *number < -count) {
      return FileOutOfRange(Here(), CornerOf(soup_.face_sizes.size()), *number,
                            *number < 0 && count > 0 ? absl::StrCat("[", -count, ", -1]")
                                                     : absl::StrCat("[1, ", limit, "]"));
    }
    const std::int64_t index = *number > 0 ? *number - 1 : count + *number;
    NoteIndex(static_cast<std::uint32_t>(index));
    soup_.face_vertices.push_back(static_cast<std::uint32_t>(index));
    return absl::OkStatus();
  }

  // A face may come before its vertices, so only the end shows whether they exist.
  void NoteIndex(std::uint32_t index) {
    if (index <= highest_index_) return;
    highest_index_ = index;
    highest_index_line_ = lines_.number();
    highest_index_face_ = soup_.face_sizes.size();
  }

  [[nodiscard]] FilePlace Here() const { return AtLine(lines_.number()); }
  absl::Status FaceError(ErrorReason reason, const std::string& problem,
                         const ErrorFacts& facts) const {
    return FileError(reason, Here(), absl::StrCat("face ", soup_.face_sizes.size(), " ", problem),
                     facts);
  }
  static std::string CornerOf(std::size_t face) { return absl::StrCat("a corner of face ", face); }

  LineScanner lines_;
  const MeshLimits& limits_;
  TriangleCounter triangles_;
  std::string joined_;
  PolygonSoup soup_;
  std::size_t highest_index_ = 0;
  std::size_t highest_index_line_ = 0;
  std::size_t highest_index_face_ = 0;
};

}  // namespace

absl::StatusOr<PolygonSoup> ReadObj(std::string_view text, const MeshLimits& limits) {
  return ObjReader(text, limits).Run();
}

}  // namespace capfit::formats
