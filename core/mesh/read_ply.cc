#include "core/mesh/read_ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/mesh/ply_header.h"
#include "core/mesh/soup_checks.h"
#include "core/mesh/text_scanner.h"

namespace capfit::mesh {
namespace {

static_assert(std::endian::native == std::endian::little, "byte order of the loads below");

template <typename Value, bool kSwap>
double Load(const char* bytes) {
  std::array<char, sizeof(Value)> raw;
  std::memcpy(raw.data(), bytes, sizeof(Value));
  if constexpr (kSwap) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<Value>(raw));
}

// Values of a binary body. A double holds every value of every PLY type exactly.
template <bool kSwap>
class BinaryValues {
 public:
  explicit BinaryValues(std::string_view bytes) : bytes_(bytes) {}

  std::optional<double> Next(PlyType type) {
    const std::size_t size = SizeOf(type);
    if (bytes_.size() < size) return std::nullopt;
    const char* const data = bytes_.data();
    bytes_.remove_prefix(size);
    switch (type) {
      case PlyType::kInt8:
        return Load<std::int8_t, kSwap>(data);
      case PlyType::kUint8:
        return Load<std::uint8_t, kSwap>(data);
      case PlyType::kInt16:
        return Load<std::int16_t, kSwap>(data);
      case PlyType::kUint16:
        return Load<std::uint16_t, kSwap>(data);
      case PlyType::kInt32:
        return Load<std::int32_t, kSwap>(data);
      case PlyType::kUint32:
        return Load<std::uint32_t, kSwap>(data);
      case PlyType::kFloat32:
        return Load<float, kSwap>(data);
      case PlyType::kFloat64:
        return Load<double, kSwap>(data);
    }
    return std::nullopt;
  }
  [[nodiscard]] std::size_t BytesLeft() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

// Values of a text body.
class TextValues {
 public:
  explicit TextValues(std::string_view text) : words_(text) {}
  std::optional<double> Next(PlyType) { return ParseNumber<double>(words_.NextWord()); }
  [[nodiscard]] std::size_t BytesLeft() const { return words_.Rest().size(); }

 private:
  WordScanner words_;
};

template <typename Values>
class BodyReader {
 public:
  BodyReader(const PlyHeader& header, Values values, const MeshLimits& limits)
      : header_(header), values_(std::move(values)), limits_(limits), triangles_(limits) {}

  absl::StatusOr<PolygonSoup> Run() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty() || element.count == 0) continue;
      CAPFIT_RETURN_IF_ERROR(CheckCount(element));
      CAPFIT_RETURN_IF_ERROR(ReadElement(element));
    }
    if (soup_.positions.empty())
      return InvalidField(ErrorReason::kMalformedFile, "mesh.file", "has no element 'vertex'");
    return std::move(soup_);
  }

 private:
  absl::Status CheckCount(const PlyElement& element) const {
    const std::size_t fewest = MinimumBytes(element, header_.encoding);
    // One byte more: the last value of a text needs no separator.
    if (element.count > (values_.BytesLeft() + 1) / fewest) {
      return InvalidField(ErrorReason::kMalformedFile, "mesh.file",
                          absl::StrCat("ends early: element ", Named(element), " claims ",
                                       element.count, " records of at least ", fewest,
                                       " bytes, but only ", values_.BytesLeft(), " bytes follow"));
    }
    const bool is_face = element.name == "face";
    const std::size_t limit = is_face ? limits_.max_faces : limits_.max_vertices;
    if ((is_face || element.name == "vertex") && element.count > limit) {
      return InvalidField(ErrorReason::kMalformedFile, "mesh.file",
                          absl::StrCat("has ", element.count, " records of element ",
                                       Named(element), ", must have at most ", limit));
    }
    return absl::OkStatus();
  }

  absl::Status ReadElement(const PlyElement& element) {
    if (element.name == "vertex") return ReadVertices(element);
    if (element.name == "face") return ReadFaces(element);
    if (element.name == "tristrips") {
      return InvalidField(ErrorReason::kMalformedFile, "mesh.file",
                          "stores triangle strips, store an element 'face' instead");
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (!Skip(property)) return EndsEarly(element, i);
      }
    }
    return absl::OkStatus();
  }

  absl::Status ReadVertices(const PlyElement& element) {
    if (!soup_.positions.empty())
      return InvalidField(ErrorReason::kMalformedFile, "mesh.file", "has two elements 'vertex'");
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
      return InvalidField(ErrorReason::kMalformedFile, "mesh.file",
                          "has no properties x, y and z of element 'vertex'");
    }
    soup_.positions.resize(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t k = 0; k < axis_of.size(); ++k) {
        if (axis_of[k] < 0) {
          if (!Skip(element.properties[k])) return EndsEarly(element, i);
          continue;
        }
        const std::optional<double> value = values_.Next(element.properties[k].type);
        if (!value.has_value()) return EndsEarly(element, i);
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
    if (!soup_.face_sizes.empty())
      return InvalidField(ErrorReason::kMalformedFile, "mesh.file", "has two elements 'face'");
    if (std::count_if(element.properties.begin(), element.properties.end(), IsCornerList) != 1) {
      return InvalidField(ErrorReason::kMalformedFile, "mesh.file",
                          "has no list vertex_indices of element 'face'");
    }
    soup_.face_sizes.reserve(element.count);
    soup_.face_vertices.reserve(3 * element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (IsCornerList(property)) {
          CAPFIT_RETURN_IF_ERROR(ReadCorners(element, property, i));
        } else if (!Skip(property)) {
          return EndsEarly(element, i);
        }
      }
    }
    return absl::OkStatus();
  }

  absl::Status ReadCorners(const PlyElement& element, const PlyProperty& property,
                           std::uint64_t face) {
    const std::optional<double> corners = values_.Next(property.count_type);
    if (!corners.has_value()) return EndsEarly(element, face);
    if (!(*corners >= 0.0) || *corners > static_cast<double>(limits_.max_corners_per_face) ||
        *corners != std::floor(*corners)) {
      return FaceError(face, absl::StrCat("has ", *corners, " corners, must have at most ",
                                          limits_.max_corners_per_face));
    }
    const auto count = static_cast<std::uint32_t>(*corners);
    if (!triangles_.Add(count)) {
      return InvalidField(ErrorReason::kMalformedFile, "mesh.file",
                          "has faces that " + TooManyTriangles(limits_));
    }
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::optional<double> index = values_.Next(property.type);
      if (!index.has_value()) return EndsEarly(element, face);
      if (!(*index >= 0.0) || *index > 4294967294.0 || *index != std::floor(*index)) {
        return FaceError(face, absl::StrCat("names vertex ", *index));
      }
      soup_.face_vertices.push_back(static_cast<std::uint32_t>(*index));
    }
    soup_.face_sizes.push_back(count);
    return absl::OkStatus();
  }

  bool Skip(const PlyProperty& property) {
    if (!property.is_list) return values_.Next(property.type).has_value();
    const std::optional<double> count = values_.Next(property.count_type);
    if (!count.has_value() || !(*count >= 0.0)) return false;
    for (double k = 0; k < *count; ++k) {
      if (!values_.Next(property.type).has_value()) return false;
    }
    return true;
  }

  absl::Status EndsEarly(const PlyElement& element, std::uint64_t record) const {
    return InvalidField(ErrorReason::kMalformedFile, "mesh.file",
                        absl::StrCat("ends early or has a bad value in record ", record, " of ",
                                     element.count, " of element ", Named(element)));
  }
  static absl::Status FaceError(std::uint64_t face, const std::string& problem) {
    return InvalidField(ErrorReason::kMalformedFile, "mesh.file",
                        absl::StrCat("face ", face, " ", problem));
  }
  static std::string Named(const PlyElement& element) {
    return absl::StrCat("'", element.name.substr(0, 20), "'");
  }

  const PlyHeader& header_;
  Values values_;
  const MeshLimits& limits_;
  TriangleCounter triangles_;
  PolygonSoup soup_;
};

template <typename Values>
absl::StatusOr<PolygonSoup> ReadBody(const PlyHeader& header, std::string_view body,
                                     const MeshLimits& limits) {
  return BodyReader<Values>(header, Values(body), limits).Run();
}

}  // namespace

absl::StatusOr<PolygonSoup> ReadPly(std::span<const std::byte> bytes, const MeshLimits& limits) {
  const std::string_view text = AsText(bytes);
  CAPFIT_ASSIGN_OR_RETURN(const PlyHeader header, ReadPlyHeader(text));
  const std::string_view body = text.substr(header.size_bytes);
  switch (header.encoding) {
    case PlyEncoding::kText:
      return ReadBody<TextValues>(header, body, limits);
    case PlyEncoding::kLittleEndian:
      return ReadBody<BinaryValues<false>>(header, body, limits);
    case PlyEncoding::kBigEndian:
      return ReadBody<BinaryValues<true>>(header, body, limits);
  }
  return InvalidField(ErrorReason::kMalformedFile, "mesh.file", "has no known encoding");
}

}  // namespace capfit::mesh
