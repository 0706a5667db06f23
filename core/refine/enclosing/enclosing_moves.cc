#include "core/refine/enclosing/enclosing_moves.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/capsule/cut_capsules.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

constexpr int kWorstPoints = 32;   // where leaves are looked at
constexpr double kTieReach = 1.6;  // between centres, in sums of radii

// Ties between spheres near each other that no capsule ties yet; one of each pair of images.
std::vector<Edit> NearTies(const capsule::MirroredSet& graph) {
  std::vector<Edit> ties;
  for (int i = 0; i < graph.sphere_count(); ++i) {
    for (int j = i + 1; j < graph.sphere_count(); ++j) {
      const geometry::Sphere& a = graph.sphere(i);
      const geometry::Sphere& b = graph.sphere(j);
      if (IsLaterImage(graph, i, j)) continue;
      if ((a.center_m - b.center_m).norm() > kTieReach * (a.radius_m + b.radius_m)) continue;
      if (!graph.HasCapsule(i, j)) ties.push_back(EditOf(EditKind::kLink, i, j));
    }
  }
  return ties;
}

}  // namespace

capsule::PrimitiveCount CountWith(const capsule::MirroredSet& graph, const Edit& addition) {
  capsule::PrimitiveCount count = graph.count();
  const int added = HasImage(graph, addition) ? 2 : 1;
  count.capsules += added;
  if (addition.kind == EditKind::kLeaf) count.spheres += added;
  return count;
}

std::vector<Removal> RemovalsOf(const capsule::MirroredSet& graph, const GraphWorth& worth) {
  std::vector<Removal> removals;
  for (int e = 0; e < graph.capsule_count(); ++e) {
    if (!graph.IsCapsuleRepresentative(e)) continue;
    const int freed = graph.ImageOfCapsule(e) != e ? 2 : 1;
    removals.push_back({worth.edge_loss[e] / freed, EditOf(EditKind::kUnlink, e)});
  }
  std::vector<int> degree(graph.spheres().size(), 0);
  for (const capsule::CapsuleEnds& e : graph.capsules()) ++degree[e[0]], ++degree[e[1]];
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (!graph.IsRepresentative(v) || degree[v] > 2) continue;
    const int freed = (graph.ImageOf(v) != v ? 2 : 1) * (degree[v] > 0 ? 2 : 1);
    removals.push_back({worth.node_loss[v] / freed, EditOf(EditKind::kDissolve, v)});
  }
  std::stable_sort(removals.begin(), removals.end(), [](const Removal& a, const Removal& b) {
    return a.loss_per_primitive < b.loss_per_primitive;
  });
  return removals;
}

SparedGraph::SparedGraph(const capsule::MirroredSet& graph)
    : before_(graph),
      graph_(graph),
      index_(graph.spheres().size()),
      is_touched_(graph.spheres().size(), 0) {
  std::iota(index_.begin(), index_.end(), 0);
}

void SparedGraph::Remove(const Edit& edit) {
  const bool is_capsule = edit.kind == EditKind::kUnlink;
  std::vector<int> touched =
      is_capsule ? std::vector<int>{before_.ends(edit.first)[0], before_.ends(edit.first)[1]}
                 : before_.NeighboursOf(edit.first);
  if (!is_capsule) touched.push_back(edit.first);
  if (std::any_of(touched.begin(), touched.end(), [&](int v) { return is_touched_[v] != 0; })) {
    return;
  }
  const int now = is_capsule ? graph_.IndexOfCapsule(index_[touched[0]], index_[touched[1]])
                             : index_[edit.first];
  EditedGraph edited = Apply(graph_, EditOf(edit.kind, now));
  if (!edited.possible) return;
  graph_ = std::move(edited.graph);
  for (int& index : index_) {
    if (index >= 0) index = edited.new_index[index];
  }
  for (const int v : touched) is_touched_[v] = is_touched_[before_.ImageOf(v)] = 1;
}

void CutLoosest(const capsule::Budget& budget, int target, const std::vector<double>& gaps,
                capsule::MirroredSet& graph) {
  capsule::Budget limits = budget;
  limits.max_primitives = std::min(limits.max_primitives, target);
  capsule::CutWorthiest(limits, gaps, capsule::QuarterOfWhole, graph);
}

std::vector<Edit> RankedAdditions(const EnclosingTask& task, const capsule::MirroredSet& loose,
                                  const ThreadPool& pool) {
  std::vector<Edit> additions = NearTies(loose);
  for (const Eigen::Vector3d& point : task.WorstPoints(loose, kWorstPoints, pool)) {
    const std::vector<Edit> leaves = LeavesAt(loose, point);
    additions.insert(additions.end(), leaves.begin(), leaves.end());
  }
  const std::vector<double> gains = task.GainsOf(loose, additions, pool);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < additions.size(); ++k) {
    const int cost = CountWith(loose, additions[k]).total() - loose.primitive_count();
    if (gains[k] > 0.0) order.emplace_back(gains[k] / cost, k);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& x, const auto& y) { return x.first > y.first; });
  std::vector<Edit> ranked;
  for (const auto& [gain, k] : order) ranked.push_back(additions[k]);
  return ranked;
}

}  // namespace capfit::refine
