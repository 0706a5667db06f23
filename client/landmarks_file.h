// The file of --landmarks: {"left_wrist": [x, y, z], ...} in the mesh's unit and axes.
#ifndef CAPFIT_CLIENT_LANDMARKS_FILE_H_
#define CAPFIT_CLIENT_LANDMARKS_FILE_H_

#include <Eigen/Core>
#include <map>
#include <string>

#include "absl/status/statusor.h"
#include "core/body/anatomy.h"

namespace capfit::client {

// A whole RESULT.json does as well: its "landmarks" are taken. INVALID_ARGUMENT names the landmark
// that is unknown or has no three finite numbers.
[[nodiscard]] absl::StatusOr<std::map<body::LandmarkId, Eigen::Vector3d>> ParseLandmarks(
    const std::string& json_text);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_LANDMARKS_FILE_H_
