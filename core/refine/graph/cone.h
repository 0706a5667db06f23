// The capsules of a set as the inner loops of the best fit need them.
#ifndef CAPFIT_CORE_REFINE_GRAPH_CONE_H_
#define CAPFIT_CORE_REFINE_GRAPH_CONE_H_

#include <Eigen/Core>
#include <vector>

#include "core/capsule/mirrored_set.h"
#include "core/tighten/distance_kernel.h"

namespace capfit::refine {

// A capsule of a set for loops in single precision. Where one end contains the other it is the
// larger sphere, `is_sphere`, and both `node_a` and `node_b` name that one's end first.
struct Cone : tighten::FloatKernel {
  float sin_half = 0, cos_half = 1;  // of the half opening angle, (r_a - r_b) / length
  int node_a = -1, node_b = -1;
  bool is_sphere = true;
  [[nodiscard]] float length() const { return highest; }  // 0 for a sphere
};

[[nodiscard]] Cone MakeCone(const capsule::MirroredSet& graph, int a, int b);

// One cone for each edge, in order, then one for each node without an edge.
[[nodiscard]] std::vector<Cone> ConesOf(const capsule::MirroredSet& graph);
// The same, in place of what is there.
void FindCones(const capsule::MirroredSet& graph, std::vector<Cone>& cones);

// By cone, as ConesOf: the index of its mirror image; its own where it lies on the plane.
[[nodiscard]] std::vector<int> ImagesOfCones(const capsule::MirroredSet& graph);

// The gradient of the distance, and the cone's radius at the foot of the point.
struct ConeFoot {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double radius_m = 0.0;
};
[[nodiscard]] ConeFoot Locate(const Cone& cone, const Eigen::Vector3d& point_m);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_GRAPH_CONE_H_
