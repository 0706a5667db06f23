#include "core/formats/read_stl.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "absl/container/flat_hash_map.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/file_error.h"
#include "core/formats/soup_checks.h"
#include "core/formats/text_scanner.h"

namespace capfit::formats {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kBytesPerTriangle = 50;

std::uint32_t CountIn(std::span<const std::byte> bytes) {
  static_assert(std::endian::native == std::endian::little, "STL is little-endian");
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return count;
}

// Collects corners; equal ones are stored once. The map is only looked up, never walked, and by
// bits, which are faster to compare than numbers.
template <typename Coordinate, typename Bits>
class CornerMerger {
 public:
  using Corner = std::array<Coordinate, 3>;

  void Reserve(std::size_t triangles) {
    soup_.face_vertices.reserve(3 * triangles);
    soup_.positions.reserve(triangles / 2 + 3);
    vertex_at_.reserve(triangles / 2 + 3);
  }
  // Whether it is the first of its kind.
  bool Add(const Corner& corner) {
    std::array<Bits, 3> bits;
    for (int k = 0; k < 3; ++k) bits[k] = std::bit_cast<Bits>(corner[k] + Coordinate{0});  // no -0
    const auto [entry, is_new] =
        vertex_at_.try_emplace(bits, static_cast<std::uint32_t>(soup_.positions.size()));
    if (is_new) soup_.positions.emplace_back(corner[0], corner[1], corner[2]);
    soup_.face_vertices.push_back(entry->second);
    return is_new;
  }
  [[nodiscard]] std::size_t corners() const { return soup_.face_vertices.size(); }
  [[nodiscard]] std::size_t vertices() const { return soup_.positions.size(); }
  PolygonSoup Take() { return std::move(soup_); }

 private:
  PolygonSoup soup_;
  absl::flat_hash_map<std::array<Bits, 3>, std::uint32_t> vertex_at_;
};

absl::Status BadCorner(std::uint32_t triangle, int k, const std::array<float, 3>& corner) {
  const FilePlace place = {absl::StrCat("triangle ", triangle, " corner ", k),
                           {{"element", "triangle"}, {"row", absl::StrCat(triangle)}}};
  int axis = 0;
  while (axis < 2 && IsCoordinate(corner[axis])) ++axis;
  return BadCoordinate(place, axis, double{corner[axis]});
}

absl::StatusOr<PolygonSoup> ReadBinary(std::span<const std::byte> bytes, const MeshLimits& limits) {
  const std::uint32_t count = CountIn(bytes);
  const std::uint64_t needed = kHeaderBytes + std::uint64_t{kBytesPerTriangle} * count;
  if (bytes.size() < needed) {
    return FileError(ErrorReason::kMalformedFile, {},
                     absl::StrCat("ends early: it claims ", count, " triangles, which take ",
                                  needed, " bytes, but has only ", bytes.size()),
                     ValueAndLimit(needed, bytes.size()));
  }
  if (count > limits.max_faces) return FileTooLarge({}, count, "faces", limits.max_faces);
  CornerMerger<float, std::uint32_t> corners;
  corners.Reserve(count);
  const std::byte* triangle = bytes.data() + kHeaderBytes;
  for (std::uint32_t t = 0; t < count; ++t, triangle += kBytesPerTriangle) {
    std::array<std::array<float, 3>, 4> normal_and_corners;
    std::memcpy(normal_and_corners.data(), triangle, sizeof(normal_and_corners));
    for (int k = 0; k < 3; ++k) {
      const std::array<float, 3>& corner = normal_and_corners[k + 1];
      if (corners.Add(corner) && !IsPosition(corner)) return BadCorner(t, k, corner);
    }
  }
  if (corners.vertices() > limits.max_vertices) {
    return FileTooLarge({}, corners.vertices(), "vertices", limits.max_vertices);
  }
  if (count == 0) return FileError(ErrorReason::kMissing, {}, "has no triangles");
  return corners.Take();
}

class TextReader {
 public:
  TextReader(std::string_view text, const MeshLimits& limits) : lines_(text), limits_(limits) {}

  absl::StatusOr<PolygonSoup> Run() {
    while (!lines_.AtEnd()) {
      WordScanner words(lines_.NextLine());
      const std::string_view keyword = words.NextWord();
      is_finished_ = keyword.empty() ? is_finished_ : keyword == "endsolid";
      if (keyword == "vertex") CAPFIT_RETURN_IF_ERROR(ReadVertex(words));
      if (keyword == "endloop" && corners_.corners() != loop_start_ + 3) {
        return Error("a loop must have three vertices");
      }
      if (keyword == "outer") {
        if (corners_.corners() % 3 != 0) return Error("a loop must have three vertices");
        loop_start_ = corners_.corners();
      }
    }
    if (!is_finished_) return Error("the file ends before 'endsolid'");
    if (corners_.corners() == 0) return FileError(ErrorReason::kMissing, {}, "has no triangles");
    if (corners_.corners() != loop_start_ + 3) return Error("a loop must have three vertices");
    return corners_.Take();
  }

 private:
  absl::Status ReadVertex(WordScanner words) {
    Eigen::Vector3d corner;
    CAPFIT_RETURN_IF_ERROR(ReadPosition(lines_.number(), words, corner));
    if (corners_.corners() >= loop_start_ + 3) return Error("a loop must have three vertices");
    corners_.Add({corner.x(), corner.y(), corner.z()});
    if (corners_.corners() > 3 * limits_.max_faces) {
      return FileTooLarge(Here(), limits_.max_faces + 1, "faces", limits_.max_faces);
    }
    if (corners_.vertices() > limits_.max_vertices) {
      return FileTooLarge(Here(), corners_.vertices(), "vertices", limits_.max_vertices);
    }
    return absl::OkStatus();
  }

  [[nodiscard]] FilePlace Here() const { return AtLine(lines_.number()); }
  absl::Status Error(const char* problem) const {
    return FileError(ErrorReason::kMalformedFile, Here(), problem);
  }

  LineScanner lines_;
  const MeshLimits& limits_;
  CornerMerger<double, std::uint64_t> corners_;
  std::size_t loop_start_ = 0;
  bool is_finished_ = false;
};

}  // namespace

bool HasSizeOfBinaryStl(std::span<const std::byte> bytes) {
  return bytes.size() >= kHeaderBytes &&
         bytes.size() == kHeaderBytes + std::uint64_t{kBytesPerTriangle} * CountIn(bytes);
}

absl::StatusOr<PolygonSoup> ReadStl(std::span<const std::byte> bytes, const MeshLimits& limits) {
  const std::string_view text = AsText(bytes);
  const bool begins_as_text = WordScanner(text.substr(0, 256)).NextWord() == "solid";
  // A text file of the same size as a binary one with its bytes 80 to 83 as count: impossible
  // below 400 MB, for those bytes are printable.
  if (begins_as_text && !HasSizeOfBinaryStl(bytes)) return TextReader(text, limits).Run();
  if (bytes.size() < kHeaderBytes) {
    return FileError(ErrorReason::kMalformedFile, {},
                     "is neither a text STL ('solid ...') nor has it the 84 bytes that begin a "
                     "binary one");
  }
  return ReadBinary(bytes, limits);
}

}  // namespace capfit::formats
