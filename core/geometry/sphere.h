// A ball in space.
#ifndef CAPFIT_CORE_GEOMETRY_SPHERE_H_
#define CAPFIT_CORE_GEOMETRY_SPHERE_H_

#include <Eigen/Core>

namespace capfit::geometry {

struct Sphere {
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;  // >= 0

  friend bool operator==(const Sphere&, const Sphere&) = default;
};

// The image in the plane x = 0, the mid-plane of the body frame. Exact: twice is what it was.
[[nodiscard]] inline Sphere MirrorImage(const Sphere& sphere) {
  return {{-sphere.center_m.x(), sphere.center_m.y(), sphere.center_m.z()}, sphere.radius_m};
}

// Distance from `point_m` to the surface, negative inside. Exact.
[[nodiscard]] inline double SignedDistance(const Sphere& sphere, const Eigen::Vector3d& point_m) {
  return (point_m - sphere.center_m).norm() - sphere.radius_m;
}

}  // namespace capfit::geometry

#endif  // CAPFIT_CORE_GEOMETRY_SPHERE_H_
