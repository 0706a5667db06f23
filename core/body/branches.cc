#include "core/body/branches.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <numeric>
#include <utility>

#include "absl/container/flat_hash_map.h"
#include "core/base/chunk_sums.h"
#include "core/base/disjoint_sets.h"

namespace capfit::body {
namespace {

struct Merge {
  std::uint32_t tip = 0;
  std::uint32_t survivor = 0;  // tip of the piece it joined
  double level = 0.0;
};

// A vertex next to one that lies farther out and belongs to another tip.
struct Saddle {
  double level = 0.0;
  std::uint32_t vertex = 0;
  std::uint32_t tip = 0;  // of the vertex
  std::uint32_t other_tip = 0;

  // The order in which pieces join: the farthest out first.
  bool operator<(const Saddle& other) const {
    return level != other.level ? level > other.level : vertex < other.vertex;
  }
};

// Of those between the same two tips only the first joins anything: it stands for all.
struct Saddles {
  std::vector<Saddle> list;
  absl::flat_hash_map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> place;  // by tips

  void Add(const Saddle& saddle) {
    const auto [least, most] = std::minmax(saddle.tip, saddle.other_tip);
    const auto [known, is_new] = place.try_emplace({least, most}, list.size());
    if (is_new) {
      list.push_back(saddle);
    } else if (saddle < list[known->second]) {
      list[known->second] = saddle;
    }
  }
  Saddles& operator+=(const Saddles& more) {
    for (const Saddle& saddle : more.list) Add(saddle);
    return *this;
  }
};

// The farthest vertices come first, of equals the first.
class FarthestFirst {
 public:
  explicit FarthestFirst(std::span<const double> distance) : distance_(distance) {}
  bool operator()(std::uint32_t a, std::uint32_t b) const {
    return distance_[a] != distance_[b] ? distance_[a] > distance_[b] : a < b;
  }

 private:
  std::span<const double> distance_;
};

// The tip that each vertex comes to when it always climbs to its farthest neighbour.
std::vector<std::uint32_t> NearestTips(const SurfaceGraph& graph, const FarthestFirst& is_farther,
                                       const ThreadPool& pool) {
  std::vector<std::uint32_t> tip(graph.vertex_count());
  pool.ForChunks(tip.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      auto farthest = static_cast<std::uint32_t>(v);
      for (const std::uint32_t n : graph.Neighbours(farthest)) {
        if (is_farther(n, farthest)) farthest = n;
      }
      tip[v] = farthest;
    }
  });
  for (std::uint32_t v = 0; v < tip.size(); ++v) tip[v] = FollowLinks(tip, v);
  return tip;
}

// Lets the level sink from the farthest vertex down and notes every junction. Only where the slopes
// of two tips meet can there be one.
std::vector<Merge> MergesFromTheTop(const SurfaceGraph& graph, std::span<const double> distance,
                                    const ThreadPool& pool) {
  const FarthestFirst is_farther(distance);
  const std::vector<std::uint32_t> tip = NearestTips(graph, is_farther, pool);
  const auto saddles_in = [&](std::size_t begin, std::size_t end) {
    Saddles found;
    for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
      for (const std::uint32_t n : graph.Neighbours(v)) {
        if (tip[n] == tip[v] || !is_farther(n, v)) continue;
        found.Add({distance[v], v, tip[v], tip[n]});
      }
    }
    return found;
  };
  std::vector<Saddle> saddles = SumOverChunks(pool, tip.size(), Saddles{}, saddles_in).list;
  std::stable_sort(saddles.begin(), saddles.end());
  std::vector<std::uint32_t> survivor(tip.size());  // of each tip
  std::iota(survivor.begin(), survivor.end(), 0u);
  std::vector<Merge> merges;
  for (const Saddle& saddle : saddles) {
    std::uint32_t a = FollowLinks(survivor, saddle.tip);
    std::uint32_t b = FollowLinks(survivor, saddle.other_tip);
    if (a == b) continue;
    if (is_farther(b, a)) std::swap(a, b);
    merges.push_back({b, a, saddle.level});
    survivor[b] = a;
  }
  return merges;
}

}  // namespace

std::vector<Branch> FindBranches(const SurfaceGraph& graph, std::span<const double> distance,
                                 double min_persistence, const ThreadPool& pool) {
  if (distance.empty()) return {};
  const auto farthest = static_cast<std::uint32_t>(
      std::max_element(distance.begin(), distance.end()) - distance.begin());
  std::vector<Branch> branches = {{farthest, distance[farthest], 0.0, -1}};
  std::vector<Merge> merges = MergesFromTheTop(graph, distance, pool);
  std::erase_if(merges,
                [&](const Merge& m) { return distance[m.tip] - m.level < min_persistence; });
  // So that survivors come before what they swallow.
  std::sort(merges.begin(), merges.end(), [is_farther = FarthestFirst(distance)](auto& a, auto& b) {
    return is_farther(a.tip, b.tip);
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
