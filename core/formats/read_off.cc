#include "core/formats/read_off.h"

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

class OffReader {
 public:
  OffReader(std::string_view text, const MeshLimits& limits)
      : lines_(text), limits_(limits), triangles_(limits) {}

  absl::StatusOr<PolygonSoup> Run() {
    CAPFIT_RETURN_IF_ERROR(ReadHeader());
    soup_.positions.reserve(vertices_);
    for (std::size_t i = 0; i < vertices_; ++i) CAPFIT_RETURN_IF_ERROR(ReadVertex(i));
    soup_.face_sizes.reserve(faces_);
    soup_.face_vertices.reserve(3 * faces_);
    for (std::size_t i = 0; i < faces_; ++i) CAPFIT_RETURN_IF_ERROR(ReadFace(i));
    return std::move(soup_);
  }

 private:
  // The next line that says something, without its comment; empty at the end of the file.
  std::string_view NextStatement() {
    while (!lines_.AtEnd()) {
      const std::string_view line = lines_.NextLine();
      const std::string_view statement = line.substr(0, line.find('#'));
      if (!WordScanner(statement).NextWord().empty()) return statement;
    }
    return {};
  }

  // "OFF", then the numbers of vertices, faces and edges, on the same line or on the next.
  absl::Status ReadHeader() {
    WordScanner words(NextStatement());
    if (!IsOffKeyword(words.NextWord())) return Malformed("an OFF file begins with 'OFF'");
    std::string_view word = words.NextWord();
    if (word == "BINARY") {
      return FileError(ErrorReason::kUnsupportedFile, Here(),
                       "binary OFF is not read; send text OFF or binary PLY");
    }
    if (word.empty()) {
      words = WordScanner(NextStatement());
      word = words.NextWord();
    }
    const std::optional<std::uint64_t> vertices = ParseNumber<std::uint64_t>(word);
    const std::optional<std::uint64_t> faces = ParseNumber<std::uint64_t>(words.NextWord());
    if (!vertices.has_value() || !faces.has_value()) {
      return Malformed("the numbers of vertices and faces are missing");
    }
    return CheckCounts(*vertices, *faces);
  }

  absl::Status CheckCounts(std::uint64_t vertices, std::uint64_t faces) {
    if (vertices > limits_.max_vertices) {
      return FileTooLarge(Here(), vertices, "vertices", limits_.max_vertices);
    }
    if (faces > limits_.max_faces) return FileTooLarge(Here(), faces, "faces", limits_.max_faces);
    // "0 0 0\n" is the shortest vertex, "0\n" the shortest face.
    const std::uint64_t needed = 6 * vertices + 2 * faces;
    const std::uint64_t present = lines_.Rest().size();
    if (needed > present + 1) {
      return FileError(ErrorReason::kMalformedFile, Here(),
                       absl::StrCat("the file ends early: it claims ", vertices, " vertices and ",
                                    faces, " faces, which take at least ", needed,
                                    " bytes, but only ", present, " follow"),
                       ValueAndLimit(needed, present));
    }
    if (vertices == 0) return FileError(ErrorReason::kMissing, Here(), "the file has no vertices");
    vertices_ = vertices;
    faces_ = faces;
    return absl::OkStatus();
  }

  absl::Status ReadVertex(std::size_t index) {
    const std::string_view statement = NextStatement();
    if (statement.empty()) return EndsEarly("vertices", vertices_, index);
    WordScanner words(statement);
    return ReadPosition(lines_.number(), words, soup_.positions.emplace_back());
  }

  absl::Status ReadFace(std::size_t index) {
    const std::string_view statement = NextStatement();
    if (statement.empty()) return EndsEarly("faces", faces_, index);
    WordScanner words(statement);
    const std::string_view size = words.NextWord();
    const std::optional<std::uint64_t> corners = ParseNumber<std::uint64_t>(size);
    if (!corners.has_value()) {
      return BadNumber<std::uint64_t>(Here(), absl::StrCat("the size of face ", index), size,
                                      absl::StrCat("[3, ", limits_.max_corners_per_face, "]"));
    }
    if (*corners > limits_.max_corners_per_face) {
      return FileError(ErrorReason::kTooLarge, Here(),
                       absl::StrCat("face ", index, " has ", *corners,
                                    " corners, must have at most ", limits_.max_corners_per_face),
                       ValueAndLimit(*corners, limits_.max_corners_per_face));
    }
    if (!triangles_.Add(*corners)) return TooManyTriangles(Here(), limits_);
    for (std::uint64_t k = 0; k < *corners; ++k) {
      CAPFIT_RETURN_IF_ERROR(ReadCorner(words.NextWord(), index));
    }
    soup_.face_sizes.push_back(static_cast<std::uint32_t>(*corners));
    return absl::OkStatus();
  }

  absl::Status ReadCorner(std::string_view word, std::size_t face) {
    const std::optional<std::int64_t> vertex = ParseNumber<std::int64_t>(word);
    if (vertex.has_value() && *vertex >= 0 && *vertex < static_cast<std::int64_t>(vertices_)) {
      soup_.face_vertices.push_back(static_cast<std::uint32_t>(*vertex));
      return absl::OkStatus();
    }
    const std::string what = absl::StrCat("a corner of face ", face);
    if (vertex.has_value()) return FileOutOfRange(Here(), what, *vertex, IndexRange(vertices_));
    return BadNumber<std::int64_t>(Here(), what, word, IndexRange(vertices_));
  }

  [[nodiscard]] FilePlace Here() const { return AtLine(lines_.number()); }
  absl::Status Malformed(const std::string& problem) const {
    return FileError(ErrorReason::kMalformedFile, Here(), problem);
  }
  absl::Status EndsEarly(const char* what, std::size_t claimed, std::size_t present) const {
    return FileError(ErrorReason::kMalformedFile, Here(),
                     absl::StrCat("the file ends early: it claims ", claimed, " ", what,
                                  ", but has only ", present),
                     ValueAndLimit(claimed, present));
  }

  LineScanner lines_;
  const MeshLimits& limits_;
  TriangleCounter triangles_;
  std::size_t vertices_ = 0;
  std::size_t faces_ = 0;
  PolygonSoup soup_;
};

}  // namespace

bool IsOffKeyword(std::string_view word) {
  if (word.size() < 3 || word.substr(word.size() - 3) != "OFF") return false;
  // Texture coordinates, colours and normals may stand behind each vertex; "4" and "n" would mean
  // other dimensions.
  const std::string_view prefix = word.substr(0, word.size() - 3);
  constexpr std::string_view kKnown[] = {"", "C", "N", "CN", "ST", "STC", "STN", "STCN"};
  for (const std::string_view known : kKnown) {
    if (prefix == known) return true;
  }
  return false;
}

absl::StatusOr<PolygonSoup> ReadOff(std::string_view text, const MeshLimits& limits) {
  return OffReader(text, limits).Run();
}

}  // namespace capfit::formats
