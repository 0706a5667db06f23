// How far a point is from the solid of a sphere mesh, and which spheres that distance hangs on.
#ifndef CAPFIT_TESTS_BENCH_SPHERE_MESH_SPHERE_MESH_DISTANCE_H_
#define CAPFIT_TESTS_BENCH_SPHERE_MESH_SPHERE_MESH_DISTANCE_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/tapered_capsule.h"
#include "tests/bench/sphere_mesh/sphere_mesh.h"

namespace capfit::bench {

// The interpolated sphere whose surface is nearest: shares[k] of the sphere spheres[k], shares >= 0
// with the sum 1. A change of that sphere by (dc, dr) changes the distance by
// -shares[k] * (normal . dc + dr).
struct Foot {
  double distance = 0.0;  // signed, negative inside
  std::array<int, 3> spheres{0, 0, 0};
  std::array<double, 3> shares{1.0, 0.0, 0.0};
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // unit gradient of the distance
};

// Point and hull of three spheres. The two planes that touch all three bound it between the hulls
// of its sides; where a sphere lies in the hull of the others there are none, and the sides are
// all.
class TrianglePlates {
 public:
  TrianglePlates(const geometry::Sphere& a, const geometry::Sphere& b, const geometry::Sphere& c);

  // Whether a plate is nearest to `point`; then `foot`'s distance, shares and normal are of it.
  [[nodiscard]] bool Locate(const Eigen::Vector3d& point, Foot& foot) const;

 private:
  geometry::Sphere a_;
  Eigen::Matrix<double, 3, 2> sides_;  // from a to b and to c
  Eigen::Vector2d growth_;             // of the radius along them
  Eigen::Matrix<double, 2, 3> shares_of_;
  Eigen::Vector3d across_ = Eigen::Vector3d::Zero();  // unit normal of the centres' plane
  Eigen::Vector3d lean_ = Eigen::Vector3d::Zero();    // the plates' normals along that plane
  double rise_ = 0.0;                                 // and off it; 0: there are no plates
};

// Keeps a copy of all that it needs.
class SphereMeshDistance {
 public:
  explicit SphereMeshDistance(const SphereMesh& mesh);

  // Locate then knows nothing of this hull.
  void Drop(int hull) { hulls_[hull].is_dropped = true; }

  // The edges come first, then the triangles. A mesh without edges: one for each sphere.
  [[nodiscard]] int hulls() const { return static_cast<int>(hulls_.size()); }

  // The least of the hulls' signed distances: exact outside of the solid, a bound on the depth
  // inside. `hint` is any hull, the likelier the nearest the faster, and becomes the nearest. As if
  // the hull `without` were not there; one must be left.
  [[nodiscard]] Foot Locate(const Eigen::Vector3d& point, int& hint, int without = -1) const;

 private:
  struct Hull {
    Eigen::Vector3d middle;
    double reach;  // all of it is within this of `middle`
    std::int32_t edge = -1, triangle = -1;
    bool is_dropped = false;
  };
  [[nodiscard]] bool IsNearer(const Hull& hull, const Eigen::Vector3d& point, Foot& best) const;

  std::vector<Hull> hulls_;
  std::vector<geometry::TaperedCapsule> capsules_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<TrianglePlates> plates_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace capfit::bench

#endif  // CAPFIT_TESTS_BENCH_SPHERE_MESH_SPHERE_MESH_DISTANCE_H_
