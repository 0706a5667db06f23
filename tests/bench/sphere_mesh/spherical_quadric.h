// The spherical quadric: how far a sphere is from touching a set of planes from within.
#ifndef CAPFIT_TESTS_BENCH_SPHERE_MESH_SPHERICAL_QUADRIC_H_
#define CAPFIT_TESTS_BENCH_SPHERE_MESH_SPHERICAL_QUADRIC_H_

#include <Eigen/Core>
#include <optional>

#include "core/geometry/sphere.h"

namespace capfit::bench {

// Sum over weighted planes (point p, outward unit normal n) of w * (n . (p - center) - radius)^2: a
// quadratic in the four numbers of the sphere, 0 for one that touches every plane from behind.
// Thiery, Guy and Boubekeur 2013, section 3.
class SphericalQuadric {
 public:
  // The plane through `point` with the outward unit normal `normal`; weight >= 0, mostly an area.
  void AddPlane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double weight);

  SphericalQuadric& operator+=(const SphericalQuadric& other);

  // >= 0, in weight times length squared.
  [[nodiscard]] double Error(const geometry::Sphere& sphere) const;

  // The sphere of least error whose radius is in [0, max_radius]. Nothing where the planes leave it
  // open (all parallel, or all along one axis): then MinimiseOnSegment decides.
  [[nodiscard]] std::optional<geometry::Sphere> Minimise(double max_radius) const;

  // The sphere of least error whose center is on the segment from `a` to `b`. Where several are
  // equal, one of them.
  [[nodiscard]] geometry::Sphere MinimiseOnSegment(const Eigen::Vector3d& a,
                                                   const Eigen::Vector3d& b,
                                                   double max_radius) const;

 private:
  [[nodiscard]] std::optional<Eigen::Vector3d> CenterFor(double radius) const;

  // Error(s) = s.A.s - 2 b.s + c for s = (center, radius).
  Eigen::Matrix4d a_ = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b_ = Eigen::Vector4d::Zero();
  double c_ = 0.0;
};

}  // namespace capfit::bench

#endif  // CAPFIT_TESTS_BENCH_SPHERE_MESH_SPHERICAL_QUADRIC_H_
