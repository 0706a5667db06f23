// The file of --landmarks: {"left_wrist": [x, y, z], ...} in the mesh's unit and axes, or a whole
// RESULT.json.
#ifndef CAPFIT_CLIENT_LANDMARKS_FILE_H_
#define CAPFIT_CLIENT_LANDMARKS_FILE_H_

#include <Eigen/Core>
#include <map>
#include <string>

#include "absl/status/statusor.h"
#include "core/body/anatomy.h"

namespace capfit::client {

// Of a RESULT.json all "landmarks" are taken, whatever their method and confidence.
// INVALID_ARGUMENT names the landmark that is unknown or has no three finite numbers.
[[nodiscard]] absl::StatusOr<std::map<body::LandmarkId, Eigen::Vector3d>> ParseLandmarks(
    const std::string& json_text);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_LANDMARKS_FILE_H_
