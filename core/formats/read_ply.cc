#include "core/formats/read_ply.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/status.h"
#include "core/formats/file_error.h"
#include "core/formats/ply_header.h"
#include "core/formats/ply_values.h"
#include "core/formats/soup_checks.h"
#include "core/formats/text_scanner.h"

namespace capfit::formats {
namespace {

// A number that should be whole.
std::string TextOf(double number) { return absl::StrFormat("%.15g", number); }

template <typename Values>
class BodyReader {
 public:
  BodyReader(const PlyHeader& header, Values values, const MeshLimits& limits)
      : header_(header),
        values_(std::move(values)),
        limits_(limits),
        triangles_(limits),
        vertices_(static_cast<double>(header.vertex_count())) {}

  absl::StatusOr<PolygonSoup> Run() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty() || element.count == 0) continue;
      CAPFIT_RETURN_IF_ERROR(CheckCount(element));
      CAPFIT_RETURN_IF_ERROR(ReadElement(element));
    }
    if (soup_.positions.empty()) {
      return FileError(ErrorReason::kMissing, {},
                       "has no vertices: no records of element 'vertex'");
    }
    return std::move(soup_);
  }

 private:
  absl::Status CheckCount(const PlyElement& element) const {
    const std::size_t fewest = MinimumBytes(element, header_.encoding);
    // One byte more: the last value of a text needs no separator.
    const std::size_t most = (values_.BytesLeft() + 1) / fewest;
    if (element.count > most) {
      return FileError(
          ErrorReason::kMalformedFile, At(element),
          absl::StrCat("the file ends early: it claims ", element.count, " records of at least ",
                       fewest, " bytes, but only ", values_.BytesLeft(), " bytes follow"),
          ValueAndLimit(element.count, most));
    }
    if (element.name == "face" && element.count > limits_.max_faces) {
      return FileTooLarge(At(element), element.count, "faces", limits_.max_faces);
    }
    if (element.name == "vertex" && element.count > limits_.max_vertices) {
      return FileTooLarge(At(element), element.count, "vertices", limits_.max_vertices);
    }
    return absl::OkStatus();
  }

  absl::Status ReadElement(const PlyElement& element) {
    if (element.name == "vertex") return ReadVertices(element);
    if (element.name == "face") return ReadFaces(element);
    if (element.name == "tristrips") {
      return FileError(ErrorReason::kUnsupportedFile, At(element),
                       "triangle strips are not read, store an element 'face' instead");
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (!Skip(property)) return BadRecord(element, i);
      }
    }
    return absl::OkStatus();
  }

  absl::Status ReadVertices(const PlyElement& element) {
    if (!soup_.positions.empty()) return Malformed(element, "the file has two of these");
    std::vector<int> axis_of(element.properties.size(), -1);
    std::array<int, 3> found = {0, 0, 0};
    for (std::size_t k = 0; k < axis_of.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (property.is_list || property.name.size() != 1) continue;
      const char axis = property.name[0];
      if (axis < 'x' || axis > 'z') continue;
      axis_of[k] = axis - 'x';
      ++found[axis - 'x'];
    }
    if (found != std::array<int, 3>{1, 1, 1}) {
      return Malformed(element, "must have the properties x, y and z, each once");
    }
    soup_.positions.resize(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t k = 0; k < axis_of.size(); ++k) {
        if (axis_of[k] < 0) {
          if (!Skip(element.properties[k])) return BadRecord(element, i);
          continue;
        }
        const std::optional<double> value = values_.Next(element.properties[k].type);
        if (!value.has_value() || !IsCoordinate(*value)) {
          return BadCoordinateAt(element, i, axis_of[k], value);
        }
        soup_.positions[i][axis_of[k]] = *value;
      }
    }
    return absl::OkStatus();
  }

  static bool IsCornerList(const PlyProperty& property) {
    return property.is_list && property.type < PlyType::kFloat32 &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  absl::Status ReadFaces(const PlyElement& element) {
    if (!soup_.face_sizes.empty()) return Malformed(element, "the file has two of these");
    if (std::count_if(element.properties.begin(), element.properties.end(), IsCornerList) != 1) {
      return Malformed(element, "must have one list vertex_indices of whole numbers");
    }
    soup_.face_sizes.reserve(element.count);
    soup_.face_vertices.reserve(3 * element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (IsCornerList(property)) {
          CAPFIT_RETURN_IF_ERROR(ReadCorners(element, property, i));
        } else if (!Skip(property)) {
          return BadRecord(element, i);
        }
      }
    }
    return absl::OkStatus();
  }

  absl::Status ReadCorners(const PlyElement& element, const PlyProperty& property,
                           std::uint64_t face) {
    const std::optional<double> corners = values_.Next(property.count_type);
    if (!corners.has_value()) return BadRecord(element, face);
    if (!(*corners >= 0.0) || *corners > static_cast<double>(limits_.max_corners_per_face) ||
        *corners != std::floor(*corners)) {
      return BadSize(element, face, *corners);
    }
    const auto count = static_cast<std::uint32_t>(*corners);
    if (!triangles_.Add(count)) return TooManyTriangles(values_.Place(element, face), limits_);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::optional<double> index = values_.Next(property.type);
      if (!index.has_value()) return BadRecord(element, face);
      if (!(*index >= 0.0) || *index >= vertices_ || *index != std::floor(*index)) {
        return BadIndex(element, face, *index);
      }
      soup_.face_vertices.push_back(static_cast<std::uint32_t>(*index));
    }
    soup_.face_sizes.push_back(count);
    return absl::OkStatus();
  }

  bool Skip(const PlyProperty& property) {
    if (!property.is_list) return values_.Next(property.type).has_value();
    const std::optional<double> count = values_.Next(property.count_type);
    has_bad_length_ = count.has_value() && !(*count >= 0.0);
    if (!count.has_value() || has_bad_length_) return false;
    for (double k = 0; k < *count; ++k) {
      if (!values_.Next(property.type).has_value()) return false;
    }
    return true;
  }

  // Where Skip() or Next() failed.
  absl::Status BadRecord(const PlyElement& element, std::uint64_t row) const {
    const FilePlace place = values_.Place(element, row);
    if (has_bad_length_) {
      return FileError(ErrorReason::kMalformedFile, place, "a list has a negative length");
    }
    if (const std::string_view word = values_.BadWord(); !word.empty()) {
      return BadNumber<double>(place, "a value", word, "the range of double precision");
    }
    return FileError(
        ErrorReason::kMalformedFile, place,
        absl::StrCat("the file ends early: it claims ", element.count, " records of element ",
                     Quoted(element.name), ", but has only ", row),
        ValueAndLimit(element.count, row));
  }
  absl::Status BadCoordinateAt(const PlyElement& element, std::uint64_t row, int axis,
                               std::optional<double> value) const {
    if (value.has_value()) return BadCoordinate(values_.Place(element, row), axis, *value);
    if (values_.BadWord().empty()) return BadRecord(element, row);
    return BadCoordinate(values_.Place(element, row), axis, values_.BadWord());
  }
  absl::Status BadSize(const PlyElement& element, std::uint64_t face, double corners) const {
    const bool is_large = corners > static_cast<double>(limits_.max_corners_per_face);
    return FileError(is_large ? ErrorReason::kTooLarge : ErrorReason::kMalformedFile,
                     values_.Place(element, face),
                     absl::StrCat("face ", face, " has ", TextOf(corners), " corners, must have ",
                                  is_large ? "at most " : "a whole number of at most ",
                                  limits_.max_corners_per_face),
                     ValueAndLimit(TextOf(corners), limits_.max_corners_per_face));
  }
  absl::Status BadIndex(const PlyElement& element, std::uint64_t face, double index) const {
    const FilePlace place = values_.Place(element, face);
    const std::string what = absl::StrCat("a corner of face ", face);
    if (index == std::floor(index)) {
      return FileOutOfRange(place, what, TextOf(index), IndexRange(header_.vertex_count()));
    }
    return FileError(ErrorReason::kMalformedFile, place,
                     absl::StrCat(what, " is ", TextOf(index), ", must be a whole number"),
                     ValueAndLimit(TextOf(index), IndexRange(header_.vertex_count())));
  }
  static FilePlace At(const PlyElement& element) {
    return {absl::StrCat("element ", Quoted(element.name)), {{"element", Printable(element.name)}}};
  }
  static absl::Status Malformed(const PlyElement& element, const std::string& problem) {
    return FileError(ErrorReason::kMalformedFile, At(element), problem);
  }

  const PlyHeader& header_;
  Values values_;
  const MeshLimits& limits_;
  TriangleCounter triangles_;
  double vertices_;  // as the header claims
  PolygonSoup soup_;
  bool has_bad_length_ = false;  // the list that could not be skipped
};

template <typename Values>
absl::StatusOr<PolygonSoup> ReadBody(const PlyHeader& header, std::string_view file,
                                     const MeshLimits& limits) {
  return BodyReader<Values>(header, Values(header, file), limits).Run();
}

}  // namespace

absl::StatusOr<PolygonSoup> ReadPly(std::span<const std::byte> bytes, const MeshLimits& limits) {
  const std::string_view text = AsText(bytes);
  CAPFIT_ASSIGN_OR_RETURN(const PlyHeader header, ReadPlyHeader(text));
  switch (header.encoding) {
    case PlyEncoding::kText:
      return ReadBody<TextValues>(header, text, limits);
    case PlyEncoding::kLittleEndian:
      return ReadBody<BinaryValues<false>>(header, text, limits);
    case PlyEncoding::kBigEndian:
      return ReadBody<BinaryValues<true>>(header, text, limits);
  }
  return FileError(ErrorReason::kUnsupportedFile, {}, "has no known encoding");
}

}  // namespace capfit::formats
