// Small graphs for the tests of core/refine.
#ifndef CAPFIT_TESTS_CORE_REFINE_GRAPHS_H_
#define CAPFIT_TESTS_CORE_REFINE_GRAPHS_H_

#include <limits>

#include "core/base/random.h"
#include "core/refine/graph/capsule_graph.h"
#include "core/refine/graph/cone.h"

namespace capfit::refine {

// Two mid-plane spheres, a hip and a foot on each side: a trunk on two legs.
inline CapsuleGraph LeggedGraph(bool symmetric) {
  CapsuleGraph graph;
  graph.symmetric = symmetric;
  const int chest = graph.AddNode({0.0, 1.2, 0.01}, 0.12, true);
  const int belly = graph.AddNode({0.0, 1.0, 0.02}, 0.10, true);
  const int hip = graph.AddNode({0.08, 0.85, 0.0}, 0.09, false);
  const int foot = graph.AddNode({0.12, 0.2, 0.03}, 0.05, false);
  graph.AddEdge(chest, belly);
  graph.AddEdge(belly, hip);
  graph.AddEdge(hip, foot);
  return graph;
}

inline Eigen::Vector3d RandomPoint(Random& random) {
  return {random.NextIn(-0.4, 0.4), random.NextIn(0.0, 1.5), random.NextIn(-0.3, 0.3)};
}

// Distance to the union by trying every cone.
inline float UnionDistance(const CapsuleGraph& graph, const Eigen::Vector3d& point) {
  const Eigen::Vector3f p = point.cast<float>();
  float least = std::numeric_limits<float>::max();
  for (const Cone& cone : ConesOf(graph)) {
    least = std::min(least, SignedDistance(cone, p.x(), p.y(), p.z()));
  }
  return least;
}

// Whether the graph is its own image, bit for bit, in geometry and in its bookkeeping.
inline bool IsExactlyMirrored(const CapsuleGraph& graph) {
  for (int v = 0; v < graph.sphere_count(); ++v) {
    const Node& node = graph.nodes[static_cast<std::size_t>(v)];
    if (node.mirror < 0 || node.mirror >= graph.sphere_count()) return false;
    const Node& image = graph.nodes[static_cast<std::size_t>(node.mirror)];
    if (image.mirror != v || image.radius_m != node.radius_m) return false;
    if (image.center_m.x() != -node.center_m.x() || image.center_m.y() != node.center_m.y() ||
        image.center_m.z() != node.center_m.z()) {
      return false;
    }
  }
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const Edge& edge = graph.edges[e];
    if (edge.a >= edge.b || edge.mirror < 0) return false;
    if (graph.edges[static_cast<std::size_t>(edge.mirror)].mirror != static_cast<int>(e)) {
      return false;
    }
  }
  return true;
}

}  // namespace capfit::refine

#endif  // CAPFIT_TESTS_CORE_REFINE_GRAPHS_H_
