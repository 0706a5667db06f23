#include "core/refine/enclosing/enclosing_moves.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

// Either half of a cut capsule is taken to be this much as loose as the whole.
constexpr double kGapOfHalf = 0.25;
constexpr int kWorstPoints = 32;   // where leaves are looked at
constexpr double kTieReach = 1.6;  // between centres, in sums of radii

bool IsPair(const CapsuleGraph& graph, int index, int image) {
  return graph.symmetric && image != index;
}

// Ties between spheres near each other that no capsule ties yet; one of each pair of images.
std::vector<Edit> NearTies(const CapsuleGraph& graph) {
  std::vector<Edit> ties;
  for (int i = 0; i < graph.sphere_count(); ++i) {
    for (int j = i + 1; j < graph.sphere_count(); ++j) {
      const Node& a = graph.nodes[U(i)];
      const Node& b = graph.nodes[U(j)];
      if (graph.symmetric && std::minmax(a.mirror, b.mirror) < std::minmax(i, j)) continue;
      if ((a.center_m - b.center_m).norm() > kTieReach * (a.radius_m + b.radius_m)) continue;
      if (!graph.HasEdge(i, j)) ties.push_back(EditOf(EditKind::kLink, i, j));
    }
  }
  return ties;
}

}  // namespace

std::vector<Removal> RemovalsOf(const CapsuleGraph& graph, const GraphWorth& worth) {
  std::vector<Removal> removals;
  for (int e = 0; e < graph.capsule_count(); ++e) {
    if (!graph.IsEdgeRepresentative(e)) continue;
    const int freed = IsPair(graph, e, graph.edges[U(e)].mirror) ? 2 : 1;
    removals.push_back({worth.edge_loss[U(e)] / freed, EditOf(EditKind::kUnlink, e)});
  }
  std::vector<int> degree(graph.nodes.size(), 0);
  for (const Edge& e : graph.edges) ++degree[U(e.a)], ++degree[U(e.b)];
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (!graph.IsNodeRepresentative(v) || degree[U(v)] > 2) continue;
    const int freed =
        (IsPair(graph, v, graph.nodes[U(v)].mirror) ? 2 : 1) * (degree[U(v)] > 0 ? 2 : 1);
    removals.push_back({worth.node_loss[U(v)] / freed, EditOf(EditKind::kDissolve, v)});
  }
  std::stable_sort(removals.begin(), removals.end(), [](const Removal& a, const Removal& b) {
    return a.loss_per_primitive < b.loss_per_primitive;
  });
  return removals;
}

void CutLoosest(const capsule::Budget& budget, int target, const std::vector<double>& gaps,
                CapsuleGraph& graph) {
  using Ends = std::pair<int, int>;
  std::map<Ends, double> gap_of;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    gap_of[{graph.edges[e].a, graph.edges[e].b}] = gaps[e];
  }
  capsule::Budget limits = budget;
  limits.max_primitives = std::min(limits.max_primitives, target);
  for (;;) {
    int loosest = -1;
    double most = 0.0;
    for (int e = 0; e < graph.capsule_count(); ++e) {
      const Edge& edge = graph.edges[U(e)];
      const int cost = IsPair(graph, e, edge.mirror) ? 2 : 1;
      if (!graph.IsEdgeRepresentative(e) || cost > limits.Without(graph.count()).Cuts()) continue;
      const double gap = gap_of[{edge.a, edge.b}] / cost;
      if (gap > most) most = gap, loosest = e;
    }
    if (loosest < 0) return;
    const Edge cut = graph.edges[U(loosest)];
    const double half = kGapOfHalf * gap_of[{cut.a, cut.b}];
    const int first_new = graph.sphere_count();
    graph = Apply(graph, EditOf(EditKind::kSplit, loosest)).graph;
    for (const Edge& e : graph.edges) {
      if (e.b >= first_new) gap_of.emplace(Ends{e.a, e.b}, half);
    }
  }
}

std::vector<Edit> RankedAdditions(const EnclosingTask& task, const CapsuleGraph& loose,
                                  const ThreadPool& pool) {
  std::vector<Edit> additions = NearTies(loose);
  for (const Eigen::Vector3d& point : task.WorstPoints(loose, kWorstPoints, pool)) {
    const std::vector<Edit> leaves = LeavesAt(loose, point);
    additions.insert(additions.end(), leaves.begin(), leaves.end());
  }
  const std::vector<double> gains = task.GainsOf(loose, additions, pool);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < additions.size(); ++k) {
    const int cost =
        (additions[k].kind == EditKind::kLeaf ? 2 : 1) * (HasImage(loose, additions[k]) ? 2 : 1);
    if (gains[k] > 0.0) order.emplace_back(gains[k] / cost, k);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& x, const auto& y) { return x.first > y.first; });
  std::vector<Edit> ranked;
  for (const auto& [gain, k] : order) ranked.push_back(additions[k]);
  return ranked;
}

}  // namespace capfit::refine
