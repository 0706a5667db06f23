// The forms that are finer than the cage: breasts, buttocks, face, hands, and the flat soles.
#ifndef CAPFIT_CORE_MANNEQUIN_BODY_DETAILS_H_
#define CAPFIT_CORE_MANNEQUIN_BODY_DETAILS_H_

#include <Eigen/Core>
#include <vector>

#include "core/mannequin/body_cage.h"

namespace capfit::mannequin {

// Pushes whatever lies within an ellipsoid, most at its centre, smoothly to nothing at its surface.
struct Bump {
  Eigen::Vector3d center;
  Eigen::Matrix3d axes;  // columns: the ellipsoid's axes, length 1
  Eigen::Vector3d radii;
  Eigen::Vector3d push;
};

// The bumps of the left half and the middle, in body heights.
[[nodiscard]] std::vector<Bump> BodyBumps(const BodyShape& shape, const BodyCage& cage);

// Moves points of the left half. Bumps off the middle act together with their mirror images, so
// that points in the mirror plane stay there. Last, what would be under the soles is pressed flat
// onto y = 0.
void ApplyBumps(const std::vector<Bump>& bumps, std::vector<Eigen::Vector3d>& points);

}  // namespace capfit::mannequin

#endif  // CAPFIT_CORE_MANNEQUIN_BODY_DETAILS_H_
