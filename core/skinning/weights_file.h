// Dense weights as files: a JSON header and, beside it, nothing but numbers.
//
// NAME.weights.json, one object:
//   {"format": "capfit-dense-weights", "version": 1, "dtype": "float32", "byte_order": "little",
//    "layout": "row-major", "spheres": 64, "vertices": 32002, "data": "NAME.weights.f32"}
// NAME.weights.f32: spheres * vertices IEEE 754 binary32 numbers, little-endian, no padding: first
// all weights of sphere 0 in the order of the caller's vertices, then those of sphere 1, and so on.
//   numpy.fromfile("NAME.weights.f32", "<f4").reshape(spheres, vertices) @ vertices_xyz
// are the spheres' centres. Readers ignore members that they do not know.
#ifndef CAPFIT_CORE_SKINNING_WEIGHTS_FILE_H_
#define CAPFIT_CORE_SKINNING_WEIGHTS_FILE_H_

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/skinning/mean_value_coordinates.h"

namespace capfit::skinning {

// What the header says.
struct WeightsHeader {
  std::size_t sphere_count = 0;
  std::size_t vertex_count = 0;
  std::string data_file;  // name of the numbers' file, relative to the header

  [[nodiscard]] std::uint64_t data_bytes() const {
    return std::uint64_t{4} * sphere_count * vertex_count;
  }
};

// Both counts lie in [0, 2^31) and the numbers take at most 16 GiB; readers refuse more before they
// allocate anything.
inline constexpr std::uint64_t kMaxWeightsBytes = std::uint64_t{16} << 30;

// The header's text, ending with a newline. `data_file` is the name to put into it.
[[nodiscard]] std::string FormatWeightsHeader(const DenseWeights& weights,
                                              const std::string& data_file);

// INVALID_ARGUMENT names the member that is missing, of the wrong kind or out of range.
[[nodiscard]] absl::StatusOr<WeightsHeader> ParseWeightsHeader(const std::string& text);

// Writes the numbers. DATA_LOSS when the stream fails.
[[nodiscard]] absl::Status WriteWeightsData(const DenseWeights& weights, std::ostream& out);

// Reads the numbers. INVALID_ARGUMENT when the stream holds fewer or more bytes than the header
// says, or a number is not finite ("weights[3][17] is nan, must be finite").
[[nodiscard]] absl::StatusOr<DenseWeights> ReadWeightsData(const WeightsHeader& header,
                                                           std::istream& in);

}  // namespace capfit::skinning

#endif  // CAPFIT_CORE_SKINNING_WEIGHTS_FILE_H_
