#include "core/refine/best_fit/far_misses.h"

#include <algorithm>

namespace capfit::refine {
namespace {

constexpr double kMissWeightPerM = 10.0;

}  // namespace

std::vector<double> ExcessOf(const SurfacePoints& points, const capsule::MirroredSet& graph) {
  const ThreadPool alone(1);
  std::vector<double> excess =
      points.grid.DistancesTo(capsule::Solids(graph.set()), /*ignore_below_m=*/0.0, alone)
          .distance_m;
  for (double& value : excess) value -= points.allowed_m;
  return excess;
}

std::vector<double> FarMisses(const SurfacePoints& points, const capsule::MirroredSet& graph) {
  std::vector<double> misses = ExcessOf(points, graph);
  for (double& miss : misses) miss = std::max(0.0, miss - kFarMissM);
  return misses;
}

double MissPenalty(const SurfacePoints& points, double miss_m) {
  return kMissWeightPerM * miss_m /
         static_cast<double>(std::max<std::size_t>(1, points.grid.size()));
}

}  // namespace capfit::refine
