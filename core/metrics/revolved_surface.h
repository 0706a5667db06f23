// The surface of a tapered capsule as rows and columns of points.
#ifndef CAPFIT_CORE_METRICS_REVOLVED_SURFACE_H_
#define CAPFIT_CORE_METRICS_REVOLVED_SURFACE_H_

#include <Eigen/Core>
#include <cmath>

#include "core/geometry/tapered_capsule.h"

namespace capfit::metrics {

// Points of the surface by the arc length along its profile, from a's pole over the slant to b's,
// and the angle around the axis: the ring's centre + its radius * Outward(angle).
class RevolvedSurface {
 public:
  explicit RevolvedSurface(const geometry::TaperedCapsule& solid);

  [[nodiscard]] double profile_length_m() const { return slant_end_ + arc_b_; }
  [[nodiscard]] double largest_radius_m() const;

  // All points at one arc length.
  struct Ring {
    Eigen::Vector3d center_m;
    double radius_m;
  };
  [[nodiscard]] Ring RingAt(double arc_length_m) const;
  // Unit vector off the axis.
  [[nodiscard]] Eigen::Vector3d Outward(double angle_rad) const {
    return std::cos(angle_rad) * across_ + std::sin(angle_rad) * third_;
  }

 private:
  geometry::Sphere a_;
  geometry::Sphere b_;
  Eigen::Vector3d axis_;
  Eigen::Vector3d across_;
  Eigen::Vector3d third_;
  double sin_ = 0.0;
  double cos_ = 1.0;
  double arc_a_ = 0.0;      // arc length at which the slant begins
  double slant_end_ = 0.0;  // and ends
  double arc_b_ = 0.0;      // length of b's arc
};

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_REVOLVED_SURFACE_H_
