#include "tests/bench/sphere_mesh/drop_hulls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "tests/bench/sphere_mesh/sphere_mesh_distance.h"

namespace capfit::bench {
namespace {

// What one point loses with the hull that is nearest to it.
struct Pull {
  int nearest = 0, second = 0;
  double loss = 0.0;
};

class Dropper {
 public:
  Dropper(const SphereMesh& mesh, std::span<const Eigen::Vector3d> points);

  // False where all that is left must stay.
  bool DropOne();

  [[nodiscard]] int primitives() const { return primitives_; }
  [[nodiscard]] SphereMesh Left() const;

 private:
  [[nodiscard]] bool IsEdge(std::size_t hull) const { return hull < mesh_.edges.size(); }
  void Find(std::size_t point);
  [[nodiscard]] bool IsBridge(std::size_t edge) const;
  void Drop(std::size_t hull);
  void CountSides(std::size_t triangle, int change);

  const SphereMesh& mesh_;
  std::span<const Eigen::Vector3d> points_;
  SphereMeshDistance distance_;
  std::vector<Pull> pulls_;        // of each point
  std::vector<bool> is_dropped_;   // of each hull, edges first, as SphereMeshDistance has them
  std::vector<bool> is_bridge_;    // edges that must stay: once a bridge, always a bridge
  std::vector<int> triangles_of_;  // of each edge, how many are left
  std::map<std::array<int, 2>, std::size_t> edge_of_;
  int primitives_ = 0;
};

Dropper::Dropper(const SphereMesh& mesh, std::span<const Eigen::Vector3d> points)
    : mesh_(mesh),
      points_(points),
      distance_(mesh),
      pulls_(points.size()),
      is_dropped_(static_cast<std::size_t>(distance_.hulls()), false),
      is_bridge_(mesh.edges.size(), false),
      triangles_of_(mesh.edges.size(), 0),
      primitives_(PrimitiveCount(mesh)) {
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) edge_of_[mesh.edges[e]] = e;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) CountSides(t, 1);
  for (std::size_t i = 0; i < points.size(); ++i) Find(i);
}

void Dropper::CountSides(std::size_t triangle, int change) {
  const std::array<int, 3>& t = mesh_.triangles[triangle];
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
    triangles_of_[edge_of_.at({a, b})] += change;
  }
}

void Dropper::Find(std::size_t point) {
  Pull& pull = pulls_[point];
  const double with = distance_.Locate(points_[point], pull.nearest).distance;
  const double without = distance_.Locate(points_[point], pull.second, pull.nearest).distance;
  pull.loss = std::abs(without) - std::abs(with);
}

bool Dropper::IsBridge(std::size_t edge) const {
  // Whether the edge's one end is reached from the other without it.
  std::vector<bool> is_reached(mesh_.spheres.size(), false);
  is_reached[mesh_.edges[edge][0]] = true;
  for (bool is_growing = true; is_growing;) {
    is_growing = false;
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) {
      if (e == edge || is_dropped_[e]) continue;
      const auto a = static_cast<std::size_t>(mesh_.edges[e][0]);
      const auto b = static_cast<std::size_t>(mesh_.edges[e][1]);
      if (is_reached[a] == is_reached[b]) continue;
      is_reached[a] = is_reached[b] = is_growing = true;
    }
  }
  return !is_reached[mesh_.edges[edge][1]];
}

void Dropper::Drop(std::size_t hull) {
  is_dropped_[hull] = true;
  distance_.Drop(static_cast<int>(hull));
  primitives_ -= IsEdge(hull) ? 1 : 2;
  if (!IsEdge(hull)) CountSides(hull - mesh_.edges.size(), -1);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto gone = static_cast<int>(hull);
    if (pulls_[i].nearest == gone || pulls_[i].second == gone) Find(i);
  }
}

bool Dropper::DropOne() {
  std::vector<double> losses(is_dropped_.size(), 0.0);
  for (const Pull& pull : pulls_) losses[pull.nearest] += pull.loss;
  while (true) {
    std::size_t best = losses.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t hull = 0; hull < losses.size(); ++hull) {
      const bool must_stay = IsEdge(hull) && (is_bridge_[hull] || triangles_of_[hull] > 0);
      const double loss = IsEdge(hull) ? losses[hull] : 0.5 * losses[hull];
      if (is_dropped_[hull] || must_stay || loss >= least) continue;
      best = hull;
      least = loss;
    }
    if (best == losses.size()) return false;
    if (IsEdge(best) && IsBridge(best)) {
      is_bridge_[best] = true;
      continue;
    }
    Drop(best);
    return true;
  }
}

SphereMesh Dropper::Left() const {
  SphereMesh left{mesh_.spheres, {}, {}};
  for (std::size_t hull = 0; hull < is_dropped_.size(); ++hull) {
    if (is_dropped_[hull]) continue;
    if (IsEdge(hull))
      left.edges.push_back(mesh_.edges[hull]);
    else
      left.triangles.push_back(mesh_.triangles[hull - mesh_.edges.size()]);
  }
  return left;
}

}  // namespace

SphereMesh DropHulls(const SphereMesh& mesh, int budget, std::span<const Eigen::Vector3d> points) {
  if (mesh.edges.empty()) return mesh;
  Dropper dropper(mesh, points);
  while (dropper.primitives() > budget && dropper.DropOne()) {
  }
  return dropper.Left();
}

}  // namespace capfit::bench
