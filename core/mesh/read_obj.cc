#include "core/mesh/read_obj.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/mesh/soup_checks.h"
#include "core/mesh/text_scanner.h"

namespace capfit::mesh {
namespace {

// A word of the file as it may stand in a message: short and printable.
std::string Quoted(std::string_view word) {
  std::string quoted = "'";
  for (const char c : word.substr(0, 20)) quoted += c >= ' ' && c <= '~' ? c : '?';
  return quoted + (word.size() > 20 ? "...'" : "'");
}

class ObjReader {
 public:
  ObjReader(std::string_view text, const MeshLimits& limits)
      : lines_(text), limits_(limits), triangles_(limits) {}

  absl::StatusOr<PolygonSoup> Run() {
    while (!lines_.AtEnd()) CAPFIT_RETURN_IF_ERROR(ReadLine(NextStatement()));
    if (soup_.positions.empty()) {
      return InvalidField(ErrorReason::kMalformedFile, "mesh.file",
                          "holds nothing to read: an OBJ file has lines 'v x y z'");
    }
    if (highest_index_ >= soup_.positions.size() && !soup_.face_vertices.empty()) {
      return InvalidField(ErrorReason::kMalformedFile, "mesh.file",
                          absl::StrCat("line ", highest_index_line_, ": face ", highest_index_face_,
                                       " names vertex ", highest_index_ + 1,
                                       ", but there are only ", soup_.positions.size()));
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
      return Error(absl::StrCat("more than ", limits_.max_vertices, " vertices"));
    }
    Eigen::Vector3d position;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = words.NextWord();
      const std::optional<double> value = ParseNumber<double>(word);
      if (!value.has_value()) return Error(Quoted(word) + " is not a coordinate");
      position[axis] = *value;
    }
    soup_.positions.push_back(position);
    return absl::OkStatus();
  }

  absl::Status ReadFace(WordScanner words) {
    if (soup_.face_sizes.size() >= limits_.max_faces) {
      return Error(absl::StrCat("more than ", limits_.max_faces, " faces"));
    }
    std::uint32_t corners = 0;
    for (std::string_view word = words.NextWord(); !word.empty() && word.front() != '#';
         word = words.NextWord()) {
      if (++corners > limits_.max_corners_per_face) {
        return FaceError(absl::StrCat("has more than ", limits_.max_corners_per_face, " corners"));
      }
      CAPFIT_RETURN_IF_ERROR(ReadCorner(word));
    }
    if (corners < 3) return FaceError(absl::StrCat("has ", corners, " corners, must have 3"));
    if (!triangles_.Add(corners)) return Error("the faces " + TooManyTriangles(limits_));
    soup_.face_sizes.push_back(corners);
    return absl::OkStatus();
  }

  // "7", "7/1", "7//3", "7/1/3", "-2": only the vertex counts.
  absl::Status ReadCorner(std::string_view word) {
    const std::optional<std::int64_t> number =
        ParseNumber<std::int64_t>(word.substr(0, word.find('/')));
    if (!number.has_value()) return FaceError("has the corner " + Quoted(word));
    if (*number == 0) return FaceError("names vertex 0, OBJ counts from 1");
    const auto count = static_cast<std::int64_t>(soup_.positions.size());
    const std::int64_t index = *number > 0 ? *number - 1 : count + *number;
    if (index < 0 || index >= static_cast<std::int64_t>(limits_.max_vertices)) {
      return FaceError(absl::StrCat("names vertex ", *number, ", ", count, " are defined so far"));
    }
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

  absl::Status Error(const std::string& problem) const {
    return InvalidField(ErrorReason::kMalformedFile, "mesh.file",
                        absl::StrCat("line ", lines_.number(), ": ", problem));
  }
  absl::Status FaceError(const std::string& problem) const {
    return Error(absl::StrCat("face ", soup_.face_sizes.size(), " ", problem));
  }

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

}  // namespace capfit::mesh
