#include "core/refine/best_fit/best_fit_settle.h"

#include <utility>

#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/best_fit_descent.h"
#include "core/refine/graph/graph_edit.h"

namespace capfit::refine {
namespace {

constexpr double kSettleCellM = 0.008;
constexpr int kLeastSteps = 150;  // and one more for each primitive

}  // namespace

OccupancyGrid BestFitGrid(const body::Body& body, const body::PartSelection& parts) {
  return MakeOccupancyGrid(body, parts, kSettleCellM, body.is_symmetric, ThreadPool(1));
}

capsule::PrimitiveSet SettleBestFit(const OccupancyGrid& grid, double first_rate_m,
                                    std::uint64_t seed, const FitObserver& observer,
                                    capsule::PrimitiveSet set) {
  if (grid.volume_m3 <= 0.0 || set.spheres.empty()) return set;
  const bool is_mirrored = grid.folded && capsule::ImagesOf(set).is_whole;
  capsule::MirroredSet graph(std::move(set), is_mirrored);
  BestFitOptions options;
  options.steps = kLeastSteps + graph.primitive_count();
  options.first_rate_m = first_rate_m;
  options.seed = seed;
  DescendBestFit(grid, options, ThreadPool(1), observer, graph);
  RemoveSwallowed(graph);
  return graph.set();
}

}  // namespace capfit::refine
