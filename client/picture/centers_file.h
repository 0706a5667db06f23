// Sphere centres of an animation, as `animate` writes and `render --centers` reads them, and their
// radii (`--radii`):
// little-endian float32, frames x spheres x 3, or in a file whose name ends in .json
//   {"frames": [[[x, y, z], ...], ...]}
#ifndef CAPFIT_CLIENT_PICTURE_CENTERS_FILE_H_
#define CAPFIT_CLIENT_PICTURE_CENTERS_FILE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace capfit::client {

// The file's bytes in the form that its name asks for; "-" asks for float32.
[[nodiscard]] std::string FormatCenters(const std::vector<std::vector<Eigen::Vector3d>>& frames,
                                        const std::string& path);

// The radii of each frame, in the same way: frames x spheres, or {"frames": [[r, ...], ...]}.
[[nodiscard]] std::string FormatRadii(const std::vector<std::vector<double>>& frames,
                                      const std::string& path);

// The centres as float32, whichever form the file has. NOT_FOUND where it cannot be read;
// INVALID_ARGUMENT names what is no list of points ("centers[3][1] must be three finite numbers").
[[nodiscard]] absl::StatusOr<std::string> ReadCenters(const std::string& path);

// The same of radii.
[[nodiscard]] absl::StatusOr<std::string> ReadRadii(const std::string& path);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_CENTERS_FILE_H_
