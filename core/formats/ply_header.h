// The header of a PLY file: which elements with which properties follow.
#ifndef CAPFIT_CORE_FORMATS_PLY_HEADER_H_
#define CAPFIT_CORE_FORMATS_PLY_HEADER_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace capfit::formats {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

// Bytes of one value in a binary file.
[[nodiscard]] std::size_t SizeOf(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;  // of the value, or of the items of a list
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  // of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  // as claimed: check against MinimumBytes before allocating
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { kText, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kText;
  std::vector<PlyElement> elements;
  std::size_t size_bytes = 0;  // where the data begin
  std::size_t lines = 0;       // of the header

  // As the header claims; 0 where it has no element 'vertex'.
  [[nodiscard]] std::uint64_t vertex_count() const;
};

// Reads up to and including the line `end_header`. INVALID_ARGUMENT names the line.
[[nodiscard]] absl::StatusOr<PlyHeader> ReadPlyHeader(std::string_view text);

// The fewest bytes that one record of the element can take.
[[nodiscard]] std::size_t MinimumBytes(const PlyElement& element, PlyEncoding encoding);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_PLY_HEADER_H_
