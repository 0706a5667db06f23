// A tapered capsule boiled down to what the inner loops need: a dozen floats, no branches.
#ifndef CAPFIT_CORE_REFINE_GRAPH_CONE_H_
#define CAPFIT_CORE_REFINE_GRAPH_CONE_H_

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "core/capsule/mirrored_set.h"

namespace capfit::refine {

// Tangent hull of two spheres in single precision (0.3 um at 2 m; geometry::TaperedCapsule is the
// exact one). Where one end contains the other it is the larger sphere, `is_sphere`, and both
// `node_a` and `node_b` name that one's end first.
struct Cone {
  float ax, ay, az;          // centre of the sphere at node_a
  float ux, uy, uz;          // unit axis; zero for a sphere
  float length, radius_a;    // length 0 for a sphere
  float slope;               // (r_b - r_a) / length
  float foot_slope;          // tan of the angle by which a foot point moves along the axis
  float sin_half, cos_half;  // of the half opening angle, (r_a - r_b) / length
  int node_a, node_b;
  bool is_sphere;
};

[[nodiscard]] Cone MakeCone(const capsule::MirroredSet& graph, int a, int b);

// One cone for each edge, in order, then one for each node without an edge.
[[nodiscard]] std::vector<Cone> ConesOf(const capsule::MirroredSet& graph);

// Signed distance of (x, y, z), negative inside; exact on both sides up to rounding.
[[nodiscard]] inline float SignedDistance(const Cone& cone, float x, float y, float z) {
  const float px = x - cone.ax, py = y - cone.ay, pz = z - cone.az;
  const float along = px * cone.ux + py * cone.uy + pz * cone.uz;
  const float square = px * px + py * py + pz * pz - along * along;
  const float across2 = square > 0.0f ? square : 0.0f;
  float foot = along + std::sqrt(across2) * cone.foot_slope;
  foot = foot > 0.0f ? foot : 0.0f;
  foot = foot < cone.length ? foot : cone.length;
  const float rest = along - foot;
  return std::sqrt(across2 + rest * rest) - (cone.radius_a + cone.slope * foot);
}

// The gradient of the distance, and the cone's radius at the foot of the point.
struct ConeFoot {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double radius_m = 0.0;
};
[[nodiscard]] ConeFoot Locate(const Cone& cone, const Eigen::Vector3d& point_m);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_GRAPH_CONE_H_
