#include "core/mesh/crowded_edges.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>
#include <cstddef>
#include <utility>

namespace capfit::mesh {
namespace {

// An edge with more triangles than this is not matched (pairs grow with the square): its triangles
// come apart, which the checks that follow report.
constexpr std::size_t kMostMatched = 16;

// The triangles at crowded edges, ascending, each once.
std::vector<std::uint32_t> CrowdedTriangles(const EdgeMates& mates) {
  std::vector<std::uint32_t> found;
  found.reserve(mates.crowded.size());
  for (const HalfEdge h : mates.crowded) found.push_back(h / 3);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

template <typename Visit>
void ForEachCrowdedEdge(const EdgeMates& mates, Visit visit) {
  std::size_t first = 0;
  for (const std::uint32_t size : mates.crowded_sizes) {
    visit(std::span(mates.crowded).subspan(first, size));
    first += size;
  }
}

// Edges of one triangle only. (A half-edge without mate is open or crowded.)
class OpenEdges {
 public:
  explicit OpenEdges(const EdgeMates& mates) : mates_(mates), crowded_(mates.mate.size(), false) {
    for (const HalfEdge h : mates.crowded) crowded_[h] = true;
  }
  // Whether the triangle has one.
  [[nodiscard]] bool IsLoose(std::uint32_t triangle) const {
    for (HalfEdge h = 3 * triangle; h < 3 * triangle + 3; ++h) {
      if (mates_.mate[h] == kNoMate && !crowded_[h]) return true;
    }
    return false;
  }

 private:
  const EdgeMates& mates_;
  std::vector<bool> crowded_;
};

struct Match {
  double flatness;  // -1: folded onto each other, 1: flat
  bool opposite;    // the two run the edge in opposite directions
  HalfEdge a;
  HalfEdge b;
};

bool IsBetter(const Match& x, const Match& y) {
  if (x.opposite != y.opposite) return x.opposite;
  if (x.flatness != y.flatness) return x.flatness > y.flatness;
  return std::pair(x.a, x.b) < std::pair(y.a, y.b);
}

// The direction in which the triangle leaves the edge, at right angles to it; zero if it has no
// area.
Eigen::Vector3d Wing(std::span<const Eigen::Vector3d> positions,
                     std::span<const Triangle> triangles, HalfEdge h) {
  const Eigen::Vector3d& start = positions[StartOf(triangles, h)];
  const Eigen::Vector3d along = (positions[EndOf(triangles, h)] - start).normalized();
  const Eigen::Vector3d to_apex = positions[StartOf(triangles, PreviousInTriangle(h))] - start;
  const Eigen::Vector3d wing = to_apex - along * along.dot(to_apex);
  const double length = wing.norm();
  return length > 0.0 ? Eigen::Vector3d(wing / length) : Eigen::Vector3d::Zero();
}

// Into `matches`, the best first; `wings` is scratch space.
void FindMatches(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> triangles,
                 std::span<const HalfEdge> edge, std::vector<Eigen::Vector3d>& wings,
                 std::vector<Match>& matches) {
  wings.clear();
  matches.clear();
  for (const HalfEdge h : edge) wings.push_back(Wing(positions, triangles, h));
  for (std::size_t i = 0; i < edge.size(); ++i) {
    for (std::size_t k = i + 1; k < edge.size(); ++k) {
      const bool opposite = StartOf(triangles, edge[i]) != StartOf(triangles, edge[k]);
      matches.push_back({-wings[i].dot(wings[k]), opposite, edge[i], edge[k]});
    }
  }
  std::sort(matches.begin(), matches.end(), IsBetter);
}

}  // namespace

std::vector<std::uint32_t> FindDuplicates(std::span<const Triangle> triangles,
                                          const EdgeMates& mates) {
  std::vector<std::pair<Triangle, std::uint32_t>> sorted;
  for (const std::uint32_t t : CrowdedTriangles(mates)) {
    Triangle corners = triangles[t];
    std::sort(corners.begin(), corners.end());
    sorted.emplace_back(corners, t);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> duplicates;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first) duplicates.push_back(sorted[i].second);
  }
  std::sort(duplicates.begin(), duplicates.end());
  return duplicates;
}

std::vector<std::uint32_t> FindFins(const EdgeMates& mates) {
  const OpenEdges open_edges(mates);
  std::vector<std::uint32_t> fins;
  ForEachCrowdedEdge(mates, [&](std::span<const HalfEdge> edge) {
    std::size_t sound = 0;
    for (const HalfEdge h : edge) sound += !open_edges.IsLoose(h / 3);
    if (sound < 2) return;  // near a hole: nothing tells the fin from the rim
    for (const HalfEdge h : edge) {
      if (open_edges.IsLoose(h / 3)) fins.push_back(h / 3);
    }
  });
  std::sort(fins.begin(), fins.end());
  fins.erase(std::unique(fins.begin(), fins.end()), fins.end());
  return fins;
}

void MatchCrowdedEdges(std::span<const Eigen::Vector3d> positions,
                       std::span<const Triangle> triangles, EdgeMates& mates) {
  std::vector<Eigen::Vector3d> wings;
  std::vector<Match> matches;
  ForEachCrowdedEdge(mates, [&](std::span<const HalfEdge> edge) {
    if (edge.size() > kMostMatched) return;
    FindMatches(positions, triangles, edge, wings, matches);
    for (const Match& match : matches) {
      if (mates.mate[match.a] != kNoMate || mates.mate[match.b] != kNoMate) continue;
      mates.mate[match.a] = match.b;
      mates.mate[match.b] = match.a;
    }
  });
}

}  // namespace capfit::mesh
