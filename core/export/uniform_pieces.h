// Capsules of one radius, cylinders and balls in place of a tapered capsule, with nothing of it
// out.
#ifndef CAPFIT_CORE_EXPORT_UNIFORM_PIECES_H_
#define CAPFIT_CORE_EXPORT_UNIFORM_PIECES_H_

#include <Eigen/Core>
#include <vector>

#include "absl/status/status.h"
#include "core/geometry/tapered_capsule.h"

namespace capfit::exports {

// How far pieces may stand out of the hull they replace, in metres, and the range that makes sense.
// 5 mm: on bodies of 31 capsules about 100 pieces; half of it doubles them.
inline constexpr double kDefaultOvershootM = 0.005;
inline constexpr double kMinOvershootM = 0.0002;
inline constexpr double kMaxOvershootM = 0.5;

// OK, or INVALID_ARGUMENT where it is out of that range.
[[nodiscard]] absl::Status CheckOvershoot(double max_overshoot_m);

// The points within `radius_m` of the segment from a to b. a == b: a ball.
struct UniformPiece {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double radius_m = 0.0;

  [[nodiscard]] bool IsBall() const { return a == b; }
};

// From the first sphere to the second. Their union contains the hull and is nowhere more than
// `max_overshoot_m` > 0 away from it. The axis is cut in equal lengths, each with its larger
// radius; a piece ends where its own round end reaches what it must hold. One piece where the radii
// are equal, one ball where the hull is one.
[[nodiscard]] std::vector<UniformPiece> UniformPieces(const geometry::TaperedCapsule& hull,
                                                      double max_overshoot_m);

// Cylinders from a to b, whose flat ends lie across the axis, for the part between the two circles
// at which the hull's cone touches its spheres. Their union with the two spheres contains the hull
// and is nowhere more than `max_overshoot_m` > 0 away from it. Empty where the hull is a ball.
[[nodiscard]] std::vector<UniformPiece> ConeCylinders(const geometry::TaperedCapsule& hull,
                                                      double max_overshoot_m);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_UNIFORM_PIECES_H_
