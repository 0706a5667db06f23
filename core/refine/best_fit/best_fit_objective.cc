#include "core/refine/best_fit/best_fit_objective.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/refine/best_fit/best_fit_descent.h"
#include "core/refine/best_fit/far_misses.h"
#include "core/refine/best_fit/fill_error.h"
#include "core/refine/graph/points_apart.h"

namespace capfit::refine {
namespace {

constexpr double kBestFitLeafDistanceM = 0.04;  // between the points where leaves are tried
constexpr double kLeastMissM = 0.002;           // points nearer to the set than this need no leaf
constexpr double kRoughRateM = 0.008;           // of the first step
constexpr double kRateM = 0.003;
// Of more primitives, which are smaller, such steps would undo more than they find.
constexpr double kFullRatePrimitives = 160.0;

int StepsOf(Effort effort, int primitives) {
  switch (effort) {
    case Effort::kTouch:
      return 30;
    case Effort::kTighten:
      return 60;
    case Effort::kRough:
      return 80;
    case Effort::kRound:
      return 240;
    case Effort::kFinish:
      return 240 + std::max(0, primitives - 64);
  }
  return 0;
}

double FirstRateM(Effort effort, int primitives) {
  if (effort == Effort::kRough) return kRoughRateM;
  return kRateM *
         std::sqrt(kFullRatePrimitives / std::max<double>(kFullRatePrimitives, primitives));
}

}  // namespace

BestFitObjective::BestFitObjective(OccupancyGrid grid, SurfacePoints points, std::uint64_t seed)
    : grid_(std::move(grid)),
      coarse_(CoarserGrid(grid_)),
      points_(std::make_unique<const SurfacePoints>(std::move(points))),
      groups_(*points_),
      seed_(seed) {}

void BestFitObjective::Settle(Effort effort, const ThreadPool& pool, const FitObserver& observer,
                              capsule::MirroredSet& graph) const {
  BestFitOptions options;
  options.seed = seed_;
  options.steps = StepsOf(effort, graph.primitive_count());
  options.first_rate_m = FirstRateM(effort, graph.primitive_count());
  DescendBestFit(grid_, options, pool, observer, graph);
}

double BestFitObjective::Value(const capsule::MirroredSet& graph, const ThreadPool& pool) const {
  double missed_m = 0.0;
  for (const double miss : FarMisses(*points_, graph, pool)) missed_m += miss;
  return GridError(grid_, graph, pool) + MissPenalty(*points_, missed_m);
}

std::vector<double> BestFitObjective::MissedWithout(const capsule::MirroredSet& graph,
                                                    const ThreadPool& pool) const {
  std::vector<double> missed =
      refine::MissedWithout(*points_, ConesOf(graph), ImagesOfCones(graph), pool);
  for (double& value : missed) value = MissPenalty(*points_, value) * grid_.volume_m3;
  return missed;
}

BestFitRound BestFitObjective::StartRound(const capsule::MirroredSet& graph,
                                          const ThreadPool& pool) const {
  return {grid_, coarse_, *points_, groups_, seed_, graph, pool};
}

std::vector<Eigen::Vector3d> BestFitObjective::WorstPoints(const capsule::MirroredSet& graph,
                                                           int count,
                                                           const ThreadPool& pool) const {
  const std::vector<double> excess = ExcessOf(*points_, graph, pool);
  std::vector<Eigen::Vector3d> positions;
  std::vector<double> scores;
  for (std::size_t i = 0; i < excess.size(); ++i) {
    if (excess[i] < kLeastMissM) continue;
    positions.push_back(points_->grid.point(i));
    scores.push_back(excess[i]);
  }
  return BestApart(positions, scores, kBestFitLeafDistanceM, count);
}

}  // namespace capfit::refine
