#include "core/refine/best_fit/far_misses.h"

#include <algorithm>
#include <limits>

namespace capfit::refine {
namespace {

constexpr double kMissWeightPerM = 10.0;
constexpr float kNowhereM = 1e6f;
constexpr std::size_t kPointsAtOnce = 64;  // that one thread looks up

// Of one point: the cone that reaches furthest beyond it, and how far from it that one is and the
// nearest that is no image of it.
struct NearestCones {
  int cone = -1;
  float distance_m = kNowhereM, other_m = kNowhereM;
};

NearestCones NearestConesOf(const Eigen::Vector3f& point, const std::vector<Cone>& cones,
                            const std::vector<int>& images) {
  NearestCones nearest;
  for (int i = 0; i < static_cast<int>(cones.size()); ++i) {
    const float distance = cones[i].SignedDistance(point.x(), point.y(), point.z());
    if (nearest.cone >= 0 && (nearest.cone == i || nearest.cone == images[i])) {
      nearest.distance_m = std::min(nearest.distance_m, distance);
    } else if (distance < nearest.distance_m) {
      nearest = {i, distance, nearest.distance_m};
    } else {
      nearest.other_m = std::min(nearest.other_m, distance);
    }
  }
  return nearest;
}

}  // namespace

std::vector<double> ExcessOf(const SurfacePoints& points, const capsule::MirroredSet& graph,
                             const ThreadPool& pool) {
  std::vector<double> excess =
      points.grid.DistancesTo(capsule::Solids(graph.set()), /*ignore_below_m=*/0.0, pool)
          .distance_m;
  for (double& value : excess) value -= points.allowed_m;
  return excess;
}

std::vector<double> FarMisses(const SurfacePoints& points, const capsule::MirroredSet& graph,
                              const ThreadPool& pool) {
  std::vector<double> misses = ExcessOf(points, graph, pool);
  for (double& miss : misses) miss = std::max(0.0, miss - kFarMissM);
  return misses;
}

std::vector<double> MissedWithout(const SurfacePoints& points, const std::vector<Cone>& cones,
                                  const std::vector<int>& images, const ThreadPool& pool) {
  std::vector<NearestCones> nearest(points.grid.size());
  pool.ForChunks(nearest.size(), kPointsAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      nearest[i] = NearestConesOf(points.grid.point(i).cast<float>(), cones, images);
    }
  });
  const auto allowed = static_cast<float>(kFarMissM + points.allowed_m);
  std::vector<double> more_m(cones.size(), 0.0);
  for (const NearestCones& of_point : nearest) {
    if (of_point.cone < 0) continue;
    const double more =
        std::max(0.0f, of_point.other_m - allowed) - std::max(0.0f, of_point.distance_m - allowed);
    more_m[of_point.cone] += more;
    if (images[of_point.cone] != of_point.cone) more_m[images[of_point.cone]] += more;
  }
  return more_m;
}

PointGroups::PointGroups(const SurfacePoints& points) : points_(points) {
  for (std::size_t first = 0; first < points.grid.size(); first += kLane) {
    Eight& group = groups_.emplace_back();
    for (std::size_t k = 0; k < kLane; ++k) {
      // What the last group lacks is beyond all boxes.
      const bool is_there = first + k < points.grid.size();
      const Eigen::Vector3f point =
          is_there ? Eigen::Vector3f(points.grid.point(first + k).cast<float>())
                   : Eigen::Vector3f(Eigen::Vector3f::Constant(kNowhereM));
      group.x[k] = point.x(), group.y[k] = point.y(), group.z[k] = point.z();
      if (is_there) group.box.extend(point);
    }
  }
}

PointGroups::Misses PointGroups::Group(const std::vector<double>& misses_m) const {
  Misses misses;
  misses.by_group_m.resize(groups_.size());
  misses.any.resize(groups_.size(), 0);
  for (std::size_t i = 0; i < misses_m.size(); ++i) {
    misses.by_group_m[i / kLane][i % kLane] = static_cast<float>(misses_m[i]);
    if (misses_m[i] > 0.0) misses.any[i / kLane] = 1;
  }
  return misses;
}

double PointGroups::LessMissed(const Misses& before, const Box& box,
                               const std::vector<Cone>& cones) const {
  const Eigen::AlignedBox3f reach(box[0].cast<float>(), box[1].cast<float>());
  const Eigen::Vector3f low = reach.min(), high = reach.max();
  double less_m = 0.0;
  std::size_t near = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Eight& group = groups_[g];
    if (!reach.intersects(group.box)) continue;
    std::array<float, kLane> misses;
    if (!FindMisses(group, cones, near, misses) && !before.any[g]) continue;
    for (std::size_t k = 0; k < kLane; ++k) {
      const bool is_in = group.x[k] >= low.x() && group.x[k] <= high.x() && group.y[k] >= low.y() &&
                         group.y[k] <= high.y() && group.z[k] >= low.z() && group.z[k] <= high.z();
      if (is_in) less_m += before.by_group_m[g][k] - misses[k];
    }
  }
  return less_m;
}

bool PointGroups::FindMisses(const Eight& group, const std::vector<Cone>& cones, std::size_t& near,
                             std::array<float, kLane>& misses_m) const {
  const auto allowed = static_cast<float>(kFarMissM + points_.allowed_m);
  misses_m.fill(std::numeric_limits<float>::max());
  const auto misses_with = [&](const Cone& cone) {
    for (std::size_t k = 0; k < kLane; ++k) {
      const float miss = cone.SignedDistance(group.x[k], group.y[k], group.z[k]) - allowed;
      misses_m[k] = miss < misses_m[k] ? miss : misses_m[k];
    }
    return *std::max_element(misses_m.begin(), misses_m.end()) > 0.0f;
  };
  bool is_missed = near >= cones.size() || misses_with(cones[near]);
  for (std::size_t j = 0; is_missed && j < cones.size(); ++j) {
    is_missed = misses_with(cones[j]);
    if (!is_missed) near = j;
  }
  for (float& miss : misses_m) miss = std::max(0.0f, miss);
  return is_missed;
}

double MissPenalty(const SurfacePoints& points, double miss_m) {
  return kMissWeightPerM * miss_m /
         static_cast<double>(std::max<std::size_t>(1, points.grid.size()));
}

}  // namespace capfit::refine
