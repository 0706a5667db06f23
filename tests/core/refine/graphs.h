// Small graphs for the tests of core/refine.
#ifndef CAPFIT_TESTS_CORE_REFINE_GRAPHS_H_
#define CAPFIT_TESTS_CORE_REFINE_GRAPHS_H_

#include <limits>

#include "core/base/random.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/graph/cone.h"
#include "tests/core/capsule/mirrored.h"

namespace capfit::refine {

// Two mid-plane spheres, a hip and a foot on each side: a trunk on two legs.
inline capsule::MirroredSet LeggedGraph(bool symmetric) {
  capsule::MirroredSet graph(symmetric);
  const int chest = graph.AddSphere({{0.0, 1.2, 0.01}, 0.12}, true);
  const int belly = graph.AddSphere({{0.0, 1.0, 0.02}, 0.10}, true);
  const int hip = graph.AddSphere({{0.08, 0.85, 0.0}, 0.09}, false);
  const int foot = graph.AddSphere({{0.12, 0.2, 0.03}, 0.05}, false);
  graph.AddCapsule(chest, belly);
  graph.AddCapsule(belly, hip);
  graph.AddCapsule(hip, foot);
  return graph;
}

inline Eigen::Vector3d RandomPoint(Random& random) {
  return {random.NextIn(-0.4, 0.4), random.NextIn(0.0, 1.5), random.NextIn(-0.3, 0.3)};
}

// Distance to the union by trying every cone.
inline float UnionDistance(const capsule::MirroredSet& graph, const Eigen::Vector3d& point) {
  const Eigen::Vector3f p = point.cast<float>();
  float least = std::numeric_limits<float>::max();
  for (const Cone& cone : ConesOf(graph)) {
    least = std::min(least, cone.SignedDistance(p.x(), p.y(), p.z()));
  }
  return least;
}

}  // namespace capfit::refine

#endif  // CAPFIT_TESTS_CORE_REFINE_GRAPHS_H_
