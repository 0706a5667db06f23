#include "core/refine/best_fit/best_fit_settle.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/refine/best_fit/best_fit_descent.h"
#include "core/refine/graph/capsule_graph.h"
#include "core/refine/graph/graph_edit.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

constexpr double kSettleCellM = 0.008;
constexpr int kLeastSteps = 150;  // and one more for each primitive

// Nodes and edges in the order of the set.
CapsuleGraph SettledGraphOf(const capsule::PrimitiveSet& set, bool symmetric) {
  CapsuleGraph graph;
  graph.symmetric = symmetric;
  for (std::size_t i = 0; i < set.spheres.size(); ++i) {
    const geometry::Sphere& sphere = set.spheres[i];
    graph.nodes.push_back(
        {sphere.center_m, sphere.radius_m, symmetric ? set.origins[i].mirror : -1});
  }
  for (const capsule::CapsuleEnds& ends : set.capsules) {
    graph.edges.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1]), -1});
  }
  graph.LinkEdges();
  graph.CopyToImages();
  return graph;
}

bool NamesAllImages(const capsule::PrimitiveSet& set) {
  CapsuleGraph graph = SettledGraphOf(set, false);
  const auto mirror = [&set](int v) { return set.origins[U(v)].mirror; };
  return std::all_of(set.origins.begin(), set.origins.end(),
                     [](const capsule::SphereOrigin& origin) { return origin.mirror >= 0; }) &&
         std::all_of(graph.edges.begin(), graph.edges.end(),
                     [&](const Edge& e) { return graph.HasEdge(mirror(e.a), mirror(e.b)); });
}

// `index` tells where the spheres of `before` are among the nodes, -1 for those that are gone.
capsule::PrimitiveSet SettledSetOf(const CapsuleGraph& graph, const std::vector<int>& index,
                                   const capsule::PrimitiveSet& before) {
  capsule::PrimitiveSet set;
  for (const Node& node : graph.nodes) set.spheres.push_back({node.center_m, node.radius_m});
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] < 0) continue;
    capsule::SphereOrigin origin = before.origins[i];
    if (origin.mirror >= 0) origin.mirror = index[U(origin.mirror)];
    set.origins.push_back(origin);
  }
  for (const Edge& edge : graph.edges) set.capsules.push_back({edge.a, edge.b});
  return set;
}

}  // namespace

OccupancyGrid BestFitGrid(const body::Body& body, const body::PartSelection& parts) {
  return MakeOccupancyGrid(body, parts, kSettleCellM, body.is_symmetric);
}

capsule::PrimitiveSet SettleBestFit(const OccupancyGrid& grid, double first_rate_m,
                                    std::uint64_t seed, capsule::PrimitiveSet set) {
  if (grid.volume_m3 <= 0.0 || set.spheres.empty()) return set;
  CapsuleGraph graph = SettledGraphOf(set, grid.folded && NamesAllImages(set));
  BestFitOptions options;
  options.steps = kLeastSteps + graph.primitive_count();
  options.first_rate_m = first_rate_m;
  options.seed = seed;
  DescendBestFit(grid, options, graph);
  const std::vector<int> index = RemoveSwallowed(graph);
  return SettledSetOf(graph, index, set);
}

}  // namespace capfit::refine
