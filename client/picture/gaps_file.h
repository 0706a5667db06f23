// Signed gaps of a mesh's vertices beside a result: RESULT.json, RESULT.gaps.json, RESULT.gaps.f32.
//
// NAME.gaps.json, one object:
//   {"format": "capfit-vertex-gaps", "version": 1, "dtype": "float32", "byte_order": "little",
//    "vertices": 32002, "metres_per_unit": 0.01, "data": "NAME.gaps.f32"}
// NAME.gaps.f32: as many IEEE 754 binary32 numbers, little-endian, no padding, in the order of the
// mesh file's vertices. Each is the distance from the vertex to the surface of the primitives'
// union in the unit of the mesh file: > 0 outside, < 0 where the primitives cover the vertex, NaN
// for vertices of parts that were not fitted and for those that no face uses.
//   numpy.fromfile("NAME.gaps.f32", "<f4")
// Readers ignore members that they do not know.
#ifndef CAPFIT_CLIENT_PICTURE_GAPS_FILE_H_
#define CAPFIT_CLIENT_PICTURE_GAPS_FILE_H_

#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/picture/result_set.h"
#include "core/formats/polygon_soup.h"

namespace capfit::client {

struct VertexGaps {
  double metres_per_unit = 1.0;
  std::vector<float> gaps;
};

// "a/result.json" gives "a/result.gaps.json".
[[nodiscard]] std::string GapsPath(const std::string& result_path);

// Both files: the header, then the numbers.
[[nodiscard]] std::vector<std::string> GapsPaths(const std::string& result_path);

// Writes both files. NOT_FOUND with the name of the one that cannot be written.
[[nodiscard]] absl::Status WriteVertexGaps(std::span<const float> gaps, double metres_per_unit,
                                           const std::string& result_path);

// Reads both, given the header. NOT_FOUND where a file cannot be read; INVALID_ARGUMENT names the
// member that is missing or wrong, or the size of the numbers' file.
[[nodiscard]] absl::StatusOr<VertexGaps> ReadVertexGaps(const std::string& header_path);

// INVALID_ARGUMENT with both figures where the gaps are not those of this body and result: another
// number of vertices, or another unit than the result's.
[[nodiscard]] absl::Status CheckGapsBelong(const VertexGaps& gaps, const ResultSet& result,
                                           const formats::PolygonSoup& body);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_GAPS_FILE_H_
