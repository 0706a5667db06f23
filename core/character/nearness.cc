#include "core/character/nearness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "absl/container/flat_hash_map.h"
#include "core/base/disjoint_sets.h"

namespace capfit::character {
namespace {

using Cell = std::array<std::int64_t, 3>;

// Cells are told apart within 2^20 in each direction; beyond they meet again, which only joins what
// lies a million cells apart.
constexpr std::int64_t kMask = (1 << 20) - 1;
// A facet's side is sampled at most this often.
constexpr int kMostSamples = 32;

std::uint64_t KeyOf(const Cell& c) {
  return static_cast<std::uint64_t>((c[0] & kMask) << 40 | (c[1] & kMask) << 20 | (c[2] & kMask));
}

Cell CellOf(const Eigen::Vector3d& point, double cell) {
  Cell at{};
  for (int k = 0; k < 3; ++k) {
    const double share = std::clamp(std::floor(point[k] / cell), -1e15, 1e15);
    at[k] = static_cast<std::int64_t>(share);
  }
  return at;
}

template <typename Visit>
void ForSamples(const Facet& facet, double cell, const Visit& visit) {
  const double edge = facet.LongestEdge();
  const int n = static_cast<int>(std::clamp(std::ceil(edge / cell), 1.0, double{kMostSamples}));
  const Eigen::Vector3d u = (facet.corner[1] - facet.corner[0]) / n;
  const Eigen::Vector3d v = (facet.corner[2] - facet.corner[0]) / n;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) visit(Eigen::Vector3d(facet.corner[0] + i * u + j * v));
  }
}

template <typename Visit>
void ForNeighbours(const Cell& c, const Visit& visit) {
  for (std::int64_t x = -1; x <= 1; ++x) {
    for (std::int64_t y = -1; y <= 1; ++y) {
      for (std::int64_t z = -1; z <= 1; ++z) visit(KeyOf({c[0] + x, c[1] + y, c[2] + z}));
    }
  }
}

}  // namespace

void CellSet::Add(const Facet& facet) {
  ForSamples(facet, cell_,
             [&](const Eigen::Vector3d& p) { cells_.insert(KeyOf(CellOf(p, cell_))); });
}

bool CellSet::IsNear(const Eigen::Vector3d& point) const {
  bool is_near = false;
  ForNeighbours(CellOf(point, cell_),
                [&](std::uint64_t key) { is_near = is_near || cells_.contains(key); });
  return is_near;
}

std::vector<std::uint32_t> ClustersOf(const Shells& shells, double gap,
                                      const std::vector<char>& taken) {
  struct Entry {
    Cell cell;
    std::uint32_t shell;
  };
  absl::flat_hash_map<std::uint64_t, Entry> first;
  DisjointSets clusters(shells.shells.size());
  for (std::uint32_t s = 0; s < clusters.size(); ++s) {
    if (taken[s] == 0) continue;
    for (std::size_t f = shells.first_facet[s]; f < shells.first_facet[s + 1]; ++f) {
      ForSamples(shells.facets[f], gap, [&](const Eigen::Vector3d& p) {
        const Cell cell = CellOf(p, gap);
        const auto [entry, is_new] = first.try_emplace(KeyOf(cell), Entry{cell, s});
        if (!is_new && entry->second.shell != s) clusters.Join(entry->second.shell, s);
      });
    }
  }
  for (const auto& known : first) {
    const Entry& entry = known.second;
    ForNeighbours(entry.cell, [&](std::uint64_t neighbour) {
      const auto other = first.find(neighbour);
      if (other != first.end()) clusters.Join(entry.shell, other->second.shell);
    });
  }
  return std::move(clusters).All();
}

}  // namespace capfit::character
