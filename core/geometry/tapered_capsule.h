// The convex hull of two spheres, the collider that cloth engines call a tapered capsule.
#ifndef CAPFIT_CORE_GEOMETRY_TAPERED_CAPSULE_H_
#define CAPFIT_CORE_GEOMETRY_TAPERED_CAPSULE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "core/geometry/sphere.h"

namespace capfit::geometry {

// A closed interval of ray parameters.
struct Interval {
  double begin = 0.0;
  double end = 0.0;
};

// The parameters t at which origin + t * direction is inside the sphere; nothing if it misses.
// `direction` need not have length 1; t counts in multiples of it.
[[nodiscard]] std::optional<Interval> Intersect(const Sphere& sphere,
                                                const Eigen::Vector3d& origin_m,
                                                const Eigen::Vector3d& direction);

// Where a point stands relative to a capsule.
struct CapsuleDistance {
  double distance_m = 0.0;      // negative inside; exact on both sides
  double axis_parameter = 0.0;  // t in [0, 1] of the sphere a(1-t) + bt whose surface is nearest
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // unit gradient of the distance
};

// Tangent hull of the spheres a and b (NvCloth, Unity Cloth, Jolt, KHR_implicit_shapes). Where one
// end sphere contains the other (length <= |difference of radii|) the hull is the larger sphere;
// that is decided once, at construction.
class TaperedCapsule {
 public:
  TaperedCapsule(const Sphere& a, const Sphere& b);

  [[nodiscard]] const Sphere& a() const { return a_; }
  [[nodiscard]] const Sphere& b() const { return b_; }
  // The hull is just the larger of the two spheres.
  [[nodiscard]] bool IsSphere() const { return is_sphere_; }
  [[nodiscard]] double length_m() const { return length_m_; }
  // sin of the half opening angle of the cone, (r_a - r_b) / length; 0 for a uniform capsule and
  // where IsSphere(). The cone's outward normal is sin * axis + cos * (unit vector off the axis).
  [[nodiscard]] double sin_half_angle() const { return sin_; }
  [[nodiscard]] double cos_half_angle() const { return cos_; }
  // Unit vector from a to b; (1, 0, 0) when the centres coincide.
  [[nodiscard]] const Eigen::Vector3d& axis() const { return axis_; }

  // Signed distance to the surface, negative inside, exact on both sides. O(1), no branches to
  // speak of: this is the hot function of coverage and metrics.
  [[nodiscard]] double SignedDistance(const Eigen::Vector3d& point_m) const;
  // The same with the foot on the axis and the gradient. On the axis itself, where the gradient is
  // not unique, it is one of the steepest directions.
  [[nodiscard]] CapsuleDistance Locate(const Eigen::Vector3d& point_m) const;
  // The one interval in which the ray runs inside (the hull is convex); nothing if it misses.
  [[nodiscard]] std::optional<Interval> Intersect(const Eigen::Vector3d& origin_m,
                                                  const Eigen::Vector3d& direction) const;
  // Whether the whole ball is inside (within `tolerance_m`): exact, because the distance is.
  [[nodiscard]] bool Contains(const Sphere& ball, double tolerance_m = 0.0) const {
    return SignedDistance(ball.center_m) <= -ball.radius_m + tolerance_m;
  }
  // Exact volume of the hull.
  [[nodiscard]] double Volume_m3() const;

 private:
  Sphere a_;
  Sphere b_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitX();
  double length_m_ = 0.0;
  double sin_ = 0.0;
  double cos_ = 1.0;
  bool is_sphere_ = false;
  bool a_is_larger_ = true;
};

inline double TaperedCapsule::SignedDistance(const Eigen::Vector3d& point_m) const {
  const Eigen::Vector3d from_a = point_m - a_.center_m;
  const double squared = from_a.squaredNorm();
  if (is_sphere_) {
    return a_is_larger_ ? std::sqrt(squared) - a_.radius_m
                        : (point_m - b_.center_m).norm() - b_.radius_m;
  }
  // In the half plane through the axis the nearest surface is the arc of a, the slanted line or the
  // arc of b; the coordinate along the slant tells which.
  const double axial = from_a.dot(axis_);
  const double radial = (from_a - axial * axis_).norm();
  const double slant = cos_ * axial - sin_ * radial;
  if (slant <= 0.0) return std::sqrt(squared) - a_.radius_m;
  if (slant >= cos_ * length_m_) return (point_m - b_.center_m).norm() - b_.radius_m;
  return cos_ * radial + sin_ * axial - a_.radius_m;
}

}  // namespace capfit::geometry

#endif  // CAPFIT_CORE_GEOMETRY_TAPERED_CAPSULE_H_
