#include "core/mesh/join_triangles.h"

#include <utility>

#include "core/mesh/crowded_edges.h"
#include "core/mesh/edge_mates.h"
#include "core/mesh/weld_vertices.h"

namespace capfit::mesh {
namespace {

// Fins that hang on fins are dropped from outside in, a layer a round. No export has many layers.
constexpr int kMostFinRounds = 16;
// Triangles that all rounds together may look at: in a million random triangles every round finds
// more of them.
constexpr std::size_t kMostFinLooks = 8'000'000;

class TriangleJoiner {
 public:
  TriangleJoiner(std::span<const Eigen::Vector3d> positions, std::vector<Triangle> triangles,
                 double weld_tolerance, const FitObserver& observer)
      : positions_(positions),
        weld_tolerance_(weld_tolerance),
        observer_(observer),
        triangles_(std::move(triangles)) {}

  JoinedTriangles Run(EdgeMates mates) {
    if (!mates.IsClosedAndOriented()) {
      mates = DropDuplicates(std::move(mates));
      if (mates.open > 0 && !observer_.IsCancelled()) mates = Weld(std::move(mates));
      mates = DropFins(std::move(mates));
      if (observer_.IsCancelled()) return {};
      result_.crowded = mates.crowded_sizes.size();
      MatchCrowdedEdges(positions_, triangles_, mates);
    }
    result_.surface = {std::move(triangles_), std::move(mates.mate)};
    return std::move(result_);
  }

 private:
  [[nodiscard]] EdgeMates FindMates() const { return FindEdgeMates(triangles_, positions_.size()); }

  EdgeMates DropDuplicates(EdgeMates mates) {
    if (mates.crowded_sizes.empty()) return mates;
    const std::vector<std::uint32_t> copies = FindDuplicates(triangles_, mates);
    if (copies.empty()) return mates;
    result_.duplicates += copies.size();
    Drop(copies);
    return FindMates();
  }

  // First what is equal, then, where that leaves edges open, what is close.
  EdgeMates Weld(EdgeMates mates) {
    const std::vector<std::uint32_t> equal = WeldEqual(positions_, OpenVertices(mates));
    mates = Replace(equal, std::move(mates));
    if (mates.open == 0 || !(weld_tolerance_ > 0.0)) return mates;
    const std::vector<std::uint32_t> close =
        WeldWithin(positions_, OpenVertices(mates), weld_tolerance_);
    return Replace(close, std::move(mates));
  }

  // The vertices at edges without just two triangles: closed parts that touch are left alone.
  [[nodiscard]] std::vector<std::uint32_t> OpenVertices(const EdgeMates& mates) const {
    std::vector<bool> open(positions_.size(), false);
    for (HalfEdge h = 0; h < mates.mate.size(); ++h) {
      if (mates.mate[h] != kNoMate) continue;
      open[StartOf(triangles_, h)] = open[EndOf(triangles_, h)] = true;
    }
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < open.size(); ++v) {
      if (open[v]) vertices.push_back(v);
    }
    return vertices;
  }

  EdgeMates Replace(const std::vector<std::uint32_t>& standing_for, EdgeMates mates) {
    std::size_t welded = 0;
    for (std::uint32_t v = 0; v < standing_for.size(); ++v) welded += standing_for[v] != v;
    if (welded == 0) return mates;
    result_.welded += welded;
    if (result_.stand_in.empty()) {
      result_.stand_in = standing_for;
    } else {
      for (std::uint32_t& v : result_.stand_in) v = standing_for[v];
    }
    const std::vector<Triangle> old = std::move(triangles_);
    triangles_.clear();
    triangles_.reserve(old.size());
    for (const Triangle& t : old) {
      const Triangle n = {standing_for[t[0]], standing_for[t[1]], standing_for[t[2]]};
      if (n[0] == n[1] || n[1] == n[2] || n[2] == n[0]) {
        ++result_.degenerate;
      } else {
        triangles_.push_back(n);
      }
    }
    return DropDuplicates(FindMates());
  }

  // A dropped fin may leave the next one loose.
  EdgeMates DropFins(EdgeMates mates) {
    std::size_t looks = 0;
    for (int round = 0; round < kMostFinRounds && !mates.crowded_sizes.empty(); ++round) {
      looks += triangles_.size();
      if (looks > kMostFinLooks || observer_.IsCancelled()) break;
      const std::vector<std::uint32_t> fins = FindFins(mates);
      if (fins.empty()) break;
      result_.fins += fins.size();
      Drop(fins);
      mates = FindMates();
    }
    return mates;
  }

  // `triangles` is ascending.
  void Drop(const std::vector<std::uint32_t>& triangles) {
    std::size_t kept = triangles.front();
    auto next = triangles.begin();
    for (std::uint32_t t = triangles.front(); t < triangles_.size(); ++t) {
      if (next != triangles.end() && *next == t) {
        ++next;
      } else {
        triangles_[kept++] = triangles_[t];
      }
    }
    triangles_.resize(kept);
  }

  std::span<const Eigen::Vector3d> positions_;
  double weld_tolerance_;
  const FitObserver& observer_;
  std::vector<Triangle> triangles_;
  JoinedTriangles result_;
};

}  // namespace

JoinedTriangles JoinTriangles(std::span<const Eigen::Vector3d> positions,
                              std::vector<Triangle> triangles, EdgeMates mates,
                              double weld_tolerance, const FitObserver& observer) {
  return TriangleJoiner(positions, std::move(triangles), weld_tolerance, observer)
      .Run(std::move(mates));
}

}  // namespace capfit::mesh
