#include "core/coverage/point_distances.h"

#include <algorithm>
#include <utility>

#include "core/base/chunk_sums.h"
#include "core/coverage/surface_probe.h"

namespace capfit::coverage {
namespace {

constexpr double kRoundingM = 1e-9;

// Whether the ball `now` contains the ball `then`.
bool Contains(const geometry::Sphere& now, const geometry::Sphere& then) {
  return (now.center_m - then.center_m).norm() <= now.radius_m - then.radius_m + kRoundingM;
}

bool IsSame(const geometry::Sphere& a, const geometry::Sphere& b) {
  return a.center_m == b.center_m && a.radius_m == b.radius_m;
}

}  // namespace

bool PointDistances::IsMeasured() const {
  return std::equal(measured_.begin(), measured_.end(), set_.spheres.begin(), set_.spheres.end(),
                    IsSame);
}

bool PointDistances::HasOnlyGrown() const {
  return std::equal(set_.spheres.begin(), set_.spheres.end(), measured_.begin(), measured_.end(),
                    Contains);
}

void PointDistances::Measure() {
  if (IsMeasured()) return;
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(set_);
  if (HasOnlyGrown()) {
    points_.Lower(solids, ChangedSolids(), at_points_, pool_);
  } else {
    at_points_ = points_.DistancesTo(solids, -size_m_, pool_);
  }
  measured_ = set_.spheres;
  is_by_target_index_ = false;
}

std::vector<std::int32_t> PointDistances::ChangedSolids() const {
  const auto is_same = [this](int sphere) {
    return IsSame(set_.spheres[sphere], measured_[sphere]);
  };
  std::vector<std::int32_t> changed;
  for (std::size_t k = 0; k < variables_.solids().size(); ++k) {
    const auto [a, b] = variables_.solids()[k];
    if (!is_same(a) || !is_same(b)) changed.push_back(static_cast<std::int32_t>(k));
  }
  return changed;
}

const tighten::UnionDistances& PointDistances::ByTargetIndex() {
  Measure();
  if (std::exchange(is_by_target_index_, true)) return by_target_index_;
  by_target_index_ = InCallersOrder(points_, at_points_, pool_);
  std::vector<std::int32_t>& solids = by_target_index_.solid;
  pool_.ForChunks(solids.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (target_.points_m[i].x() >= 0.0) continue;
      solids[i] = static_cast<std::int32_t>(variables_.image_of_solid(solids[i]));
    }
  });
  return by_target_index_;
}

}  // namespace capfit::coverage
