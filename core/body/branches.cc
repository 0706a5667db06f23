#include "core/body/branches.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace capfit::body {
namespace {

// Union-find over vertices; each set knows its farthest vertex.
class Pieces {
 public:
  explicit Pieces(std::size_t count) : parent_(count), tip_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    std::iota(tip_.begin(), tip_.end(), 0u);
  }
  std::uint32_t Find(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  [[nodiscard]] std::uint32_t Tip(std::uint32_t root) const { return tip_[root]; }
  // `child` joins `root` and takes over its tip.
  void Join(std::uint32_t child, std::uint32_t root) { parent_[child] = root; }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> tip_;
};

struct Merge {
  std::uint32_t tip = 0;
  std::uint32_t survivor = 0;  // tip of the piece it joined
  double level = 0.0;
};

// Into as many buckets as there are vertices, then in order within each.
std::vector<std::uint32_t> FarthestFirst(std::span<const double> distance) {
  const std::size_t count = distance.size();
  const double farthest = *std::max_element(distance.begin(), distance.end());
  const double per_unit = farthest > 0.0 ? static_cast<double>(count - 1) / farthest : 0.0;
  const auto bucket_of = [&](std::size_t v) {
    return count - 1 - static_cast<std::size_t>(distance[v] * per_unit);
  };
  std::vector<std::uint32_t> start(count + 1, 0);
  for (std::size_t v = 0; v < count; ++v) ++start[bucket_of(v) + 1];
  for (std::size_t k = 1; k <= count; ++k) start[k] += start[k - 1];
  std::vector<std::uint32_t> order(count);
  std::vector<std::uint32_t> free_slot(start.begin(), start.end() - 1);
  for (std::uint32_t v = 0; v < count; ++v) order[free_slot[bucket_of(v)]++] = v;
  for (std::size_t k = 0; k < count; ++k) {
    std::sort(order.begin() + start[k], order.begin() + start[k + 1],
              [&](std::uint32_t a, std::uint32_t b) {
                return distance[a] != distance[b] ? distance[a] > distance[b] : a < b;
              });
  }
  return order;
}

// Lets the level sink from the farthest vertex down and notes every junction.
std::vector<Merge> MergesFromTheTop(const SurfaceGraph& graph, std::span<const double> distance,
                                    const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> rank(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
  Pieces pieces(order.size());
  std::vector<Merge> merges;
  for (const std::uint32_t v : order) {
    for (const std::uint32_t n : graph.Neighbours(v)) {
      if (rank[n] > rank[v]) continue;
      std::uint32_t a = pieces.Find(v);
      std::uint32_t b = pieces.Find(n);
      if (a == b) continue;
      if (rank[pieces.Tip(a)] > rank[pieces.Tip(b)]) std::swap(a, b);  // a has the farther tip
      if (pieces.Tip(b) != v) merges.push_back({pieces.Tip(b), pieces.Tip(a), distance[v]});
      pieces.Join(b, a);
    }
  }
  return merges;
}

}  // namespace

std::vector<Branch> FindBranches(const SurfaceGraph& graph, std::span<const double> distance,
                                 double min_persistence) {
  if (distance.empty()) return {};
  const std::vector<std::uint32_t> order = FarthestFirst(distance);
  std::vector<Branch> branches = {{order.front(), distance[order.front()], 0.0, -1}};
  std::vector<Merge> merges = MergesFromTheTop(graph, distance, order);
  std::erase_if(merges,
                [&](const Merge& m) { return distance[m.tip] - m.level < min_persistence; });
  // The order of FarthestFirst, so that survivors come before what they swallow, ties included.
  std::sort(merges.begin(), merges.end(), [&](const Merge& a, const Merge& b) {
    return distance[a.tip] != distance[b.tip] ? distance[a.tip] > distance[b.tip] : a.tip < b.tip;
  });
  for (const Merge& m : merges) {
    // A survivor has the farther tip and goes on longer, so it is in the list already.
    const auto parent = std::find_if(branches.begin(), branches.end(),
                                     [&](const Branch& b) { return b.tip == m.survivor; });
    assert(parent != branches.end());
    const int index = static_cast<int>(std::distance(branches.begin(), parent));
    branches.push_back({m.tip, distance[m.tip], m.level, index});
  }
  return branches;
}

double JunctionLevel(std::span<const Branch> branches, int a, int b) {
  // Climb towards the root; the parent always has the lower index.
  double level = std::max(branches[a].tip_distance, branches[b].tip_distance);
  while (a != b) {
    int& lower = a > b ? a : b;
    level = std::min(level, branches[lower].saddle_distance);
    lower = branches[lower].parent;
  }
  return level;
}

}  // namespace capfit::body
