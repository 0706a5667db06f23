// RESULT.json as far as a picture needs it.
#ifndef CAPFIT_CLIENT_PICTURE_RESULT_SET_H_
#define CAPFIT_CLIENT_PICTURE_RESULT_SET_H_

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/geometry/sphere.h"

namespace capfit::client {

struct ResultSet {
  std::vector<geometry::Sphere> spheres;     // in the mesh's own frame and unit
  std::vector<std::array<int, 2>> capsules;  // indices into spheres
  std::vector<std::string> sphere_parts;     // same size as spheres; "" where not told
  std::map<std::string, Eigen::Vector3d> landmarks;
  std::map<std::string, double> metrics;  // those that are numbers
};

// Errors: INVALID_ARGUMENT naming the field ("capsules[3][1] is 40, must be below 32").
[[nodiscard]] absl::StatusOr<ResultSet> ParseResultSet(const std::string& json_text);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_RESULT_SET_H_
