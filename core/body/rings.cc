#include "core/body/rings.h"

#include <algorithm>

namespace capfit::body {
namespace {

// Sums of vertices by level, each vertex shared between the two nearest levels.
class LevelSums {
 public:
  explicit LevelSums(int levels) : moments_(levels, Eigen::Vector3d::Zero()), areas_(levels, 0.0) {}

  // `t` in [0, 1].
  void Add(double t, const Eigen::Vector3d& point, double area) {
    const double at = std::clamp(t, 0.0, 1.0) * static_cast<double>(moments_.size() - 1);
    const std::size_t lower = std::min(static_cast<std::size_t>(at), moments_.size() - 2);
    const double share = at - static_cast<double>(lower);
    moments_[lower] += (1.0 - share) * area * point;
    areas_[lower] += (1.0 - share) * area;
    moments_[lower + 1] += share * area * point;
    areas_[lower + 1] += share * area;
  }
  // Levels that nothing fell into take the place of their predecessor.
  [[nodiscard]] LevelCentroids Centroids() const {
    LevelCentroids centroids(moments_.size(), Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < moments_.size(); ++i) {
      if (areas_[i] > 0.0) {
        centroids[i] = moments_[i] / areas_[i];
      } else if (i > 0) {
        centroids[i] = centroids[i - 1];
      }
    }
    return centroids;
  }

 private:
  std::vector<Eigen::Vector3d> moments_;
  std::vector<double> areas_;
};

LevelCentroids LimbCentroids(std::span<const Eigen::Vector3d> points, std::span<const double> areas,
                             const Extremities& extremities, const Limb& limb) {
  LevelSums sums(kLevels);
  const double reach = std::max(limb.tip_distance - limb.junction, 1e-9);
  for (const std::uint32_t v : limb.vertices) {
    sums.Add((extremities.distance[v] - limb.junction) / reach, points[v], areas[v]);
  }
  return sums.Centroids();
}

LevelCentroids TrunkCentroids(std::span<const Eigen::Vector3d> points,
                              std::span<const double> areas, const Extremities& extremities,
                              const std::vector<char>& is_limb) {
  double farthest = 1e-9;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!is_limb[v]) farthest = std::max(farthest, extremities.distance[v]);
  }
  LevelSums sums(kLevels);
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!is_limb[v]) sums.Add(extremities.distance[v] / farthest, points[v], areas[v]);
  }
  return sums.Centroids();
}

}  // namespace

std::vector<char> LimbMask(std::size_t count, const Extremities& extremities,
                           std::span<const Tip> tips) {
  std::vector<char> is_limb(count, 0);
  for (const Tip tip : tips) {
    const auto& limb = extremities.limb(tip);
    if (!limb) continue;
    for (const std::uint32_t v : limb->vertices) is_limb[v] = 1;
  }
  return is_limb;
}

Rings RingsOf(std::span<const Eigen::Vector3d> points, std::span<const double> areas,
              const Extremities& extremities, const std::vector<char>& is_limb) {
  Rings rings;
  for (std::size_t i = 0; i < rings.limbs.size(); ++i) {
    if (!extremities.limbs[i]) continue;
    rings.limbs[i] = LimbCentroids(points, areas, extremities, *extremities.limbs[i]);
  }
  rings.trunk = TrunkCentroids(points, areas, extremities, is_limb);
  return rings;
}

}  // namespace capfit::body
