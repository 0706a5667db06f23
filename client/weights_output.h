// Weights beside a result: RESULT.json, RESULT.weights.json and RESULT.weights.f32. The format is
// described in core/skinning/weights_file.h.
#ifndef CAPFIT_CLIENT_WEIGHTS_OUTPUT_H_
#define CAPFIT_CLIENT_WEIGHTS_OUTPUT_H_

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/skinning/mean_value_coordinates.h"

namespace capfit::client {

// "a/result.json" gives "a/result.weights.json".
[[nodiscard]] std::string WeightsPath(const std::string& result_path);

// Both files: the header, then the numbers.
[[nodiscard]] std::vector<std::string> WeightsPaths(const std::string& result_path);

// Writes both files. NOT_FOUND with the name of the one that cannot be written.
[[nodiscard]] absl::Status WriteWeights(const skinning::DenseWeights& weights,
                                        const std::string& result_path);

// Whether this is the name of a header, rather than of a result.
[[nodiscard]] bool IsWeightsHeader(const std::string& path);

// Reads weights, given their header or the result that they stand beside.
[[nodiscard]] absl::StatusOr<skinning::DenseWeights> ReadWeights(const std::string& path);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_WEIGHTS_OUTPUT_H_
