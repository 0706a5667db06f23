#include "core/mesh/read_off.h"

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
    if (!IsOffKeyword(words.NextWord())) return Error("an OFF file begins with 'OFF'");
    std::string_view word = words.NextWord();
    if (word == "BINARY") return Error("binary OFF is not read; send text OFF or binary PLY");
    if (word.empty()) {
      words = WordScanner(NextStatement());
      word = words.NextWord();
    }
    const std::optional<std::uint64_t> vertices = ParseNumber<std::uint64_t>(word);
    const std::optional<std::uint64_t> faces = ParseNumber<std::uint64_t>(words.NextWord());
    if (!vertices.has_value() || !faces.has_value()) {
      return Error("the numbers of vertices and faces are missing");
    }
    return CheckCounts(*vertices, *faces);
  }

  absl::Status CheckCounts(std::uint64_t vertices, std::uint64_t faces) {
    if (vertices > limits_.max_vertices || faces > limits_.max_faces) {
      return Error(absl::StrCat("the file claims ", vertices, " vertices and ", faces,
                                " faces, must have at most ", limits_.max_vertices, " and ",
                                limits_.max_faces));
    }
    // "0 0 0\n" is the shortest vertex, "0\n" the shortest face.
    const std::uint64_t needed = 6 * vertices + 2 * faces;
    if (needed > lines_.Rest().size() + 1) {
      return Error(absl::StrCat("the file ends early: it claims ", vertices, " vertices and ",
                                faces, " faces, which take at least ", needed, " bytes, but only ",
                                lines_.Rest().size(), " follow"));
    }
    if (vertices == 0) return Error("the file has no vertices");
    vertices_ = vertices;
    faces_ = faces;
    return absl::OkStatus();
  }

  absl::Status ReadVertex(std::size_t index) {
    WordScanner words(NextStatement());
    Eigen::Vector3d position;
    for (int axis = 0; axis < 3; ++axis) {
      const std::optional<double> value = ParseNumber<double>(words.NextWord());
      if (!value.has_value()) {
        return Error(
            absl::StrCat("vertex ", index, " of ", vertices_, " must have three coordinates"));
      }
      position[axis] = *value;
    }
    soup_.positions.push_back(position);
    return absl::OkStatus();
  }

  absl::Status ReadFace(std::size_t index) {
    WordScanner words(NextStatement());
    const std::optional<std::uint32_t> corners = ParseNumber<std::uint32_t>(words.NextWord());
    if (!corners.has_value()) {
      return Error(absl::StrCat("face ", index, " of ", faces_, " is missing"));
    }
    if (*corners > limits_.max_corners_per_face) {
      return Error(absl::StrCat("face ", index, " has ", *corners, " corners, must have at most ",
                                limits_.max_corners_per_face));
    }
    if (!triangles_.Add(*corners)) return Error("the faces " + TooManyTriangles(limits_));
    for (std::uint32_t k = 0; k < *corners; ++k) {
      const std::optional<std::uint32_t> vertex = ParseNumber<std::uint32_t>(words.NextWord());
      if (!vertex.has_value() || *vertex >= vertices_) {
        return Error(absl::StrCat("corner ", k, " of face ", index, " must be below ", vertices_));
      }
      soup_.face_vertices.push_back(*vertex);
    }
    soup_.face_sizes.push_back(*corners);
    return absl::OkStatus();
  }

  absl::Status Error(const std::string& problem) const {
    return InvalidField(ErrorReason::kMalformedFile, "mesh.file",
                        absl::StrCat("line ", lines_.number(), ": ", problem));
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

}  // namespace capfit::mesh
