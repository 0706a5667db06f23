// The convex hull of two spheres, the collider that cloth engines call a tapered capsule.
#ifndef CAPFIT_CORE_GEOMETRY_TAPERED_CAPSULE_H_
#define CAPFIT_CORE_GEOMETRY_TAPERED_CAPSULE_H_

#include <Eigen/Core>
#include <optional>

#include "core/geometry/sphere.h"

namespace capfit::geometry {

// A closed interval of ray parameters.
struct Interval {
  double begin = 0.0;
  double end = 0.0;
};

// The parameters t at which origin + t * direction is inside the sphere; nothing if it misses.
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
  // sin of the half opening angle of the cone, (r_a - r_b) / length; 0 for a uniform capsule.
  [[nodiscard]] double sin_half_angle() const { return sin_; }
  [[nodiscard]] double cos_half_angle() const { return cos_; }
  // Unit vector from a to b; (1, 0, 0) when the centres coincide.
  [[nodiscard]] const Eigen::Vector3d& axis() const { return axis_; }

  // Signed distance to the surface, negative inside, exact on both sides. O(1), no branches to
  // speak of: this is the hot function of coverage and metrics.
  [[nodiscard]] double SignedDistance(const Eigen::Vector3d& point_m) const;
  // The same with the foot on the axis and the gradient.
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

}  // namespace capfit::geometry

#endif  // CAPFIT_CORE_GEOMETRY_TAPERED_CAPSULE_H_
