#include "core/pipeline/primitive_stage.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/capsule/build_primitives.h"
#include "core/pipeline/plan.h"
#include "core/pipeline/spend_rest.h"

namespace capfit::pipeline {
namespace {

// Primitives that may stay unused: what the cheapest mirrored pair of circles costs.
constexpr int kUnusedAllowed = 3;
constexpr int kMaxRounds = 6;

PrimitiveStage Build(std::span<const section::FeaturePolygon> polygons,
                     const std::vector<int>& circle_counts, const Overhead& overhead,
                     const capsule::PrimitiveSet& end_balls, const circle::ErrorCurves& curves) {
  PrimitiveStage stage;
  curves.Prepare(circle_counts);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    stage.approximations.push_back(curves.Approximation(static_cast<int>(i), circle_counts[i]));
  }
  stage.set = capsule::BuildPrimitives(polygons, stage.approximations, overhead.limb_links > 0);
  capsule::AddBalls(end_balls, stage.set);
  capsule::RemoveCoveredCapsules(stage.set);
  if (overhead.ball_links > 0) capsule::LinkEndBalls(stage.set);
  return stage;
}

PrimitiveStage BuildByThreshold(const body::Body& body, const FitOptions& options,
                                std::span<const section::FeaturePolygon> polygons,
                                const circle::ErrorCurves& curves) {
  const std::vector<int> counts = capsule::AllocateByThreshold(
      polygons, *options.polygon_error, curves.max_circles(), curves.AsErrorOf());
  capsule::Budget as_large;
  as_large.max_primitives = capsule::CountPrimitives(polygons, counts).total();
  const Overhead overhead = OverheadOf(body, options, as_large);
  return Build(polygons, counts, overhead,
               capsule::MakeEndBalls(body, options.parts, overhead.end_balls), curves);
}

// `budget` with `more` primitives on top of each limit that is set.
capsule::Budget Raised(capsule::Budget budget, int more) {
  for (int* limit : {&budget.max_primitives, &budget.max_spheres, &budget.max_capsules}) {
    if (*limit < capsule::kNoLimit) *limit += more;
  }
  return budget;
}

}  // namespace

PrimitiveStage BuildUnderBudget(const body::Body& body, const FitOptions& options,
                                std::span<const section::FeaturePolygon> polygons,
                                const circle::ErrorCurves& drafts,
                                const circle::ErrorCurves& curves, const ThreadPool& pool) {
  const capsule::Budget total = TotalBudget(options);
  if (options.polygon_error.has_value()) {
    PrimitiveStage stage = BuildByThreshold(body, options, polygons, curves);
    if (total.Allows(stage.set.count())) return stage;
    // More than any set may have: then the largest.
  }
  const Overhead overhead = OverheadOf(body, options, total);
  const capsule::Budget chains = ChainBudget(total, overhead);
  int bonus = 0;  // what pruning is expected to free again
  const auto allocate = [&] {
    return capsule::AllocateUnderBudget(polygons, Raised(chains, bonus), drafts.max_circles(),
                                        drafts.AsErrorOf());
  };
  std::vector<int> counts;
  capsule::PrimitiveSet end_balls;
  pool.ForEach(2, [&](std::size_t half) {
    // Last, as its own loops can use threads that come free.
    if (half == 1) counts = allocate();
    if (half == 0) end_balls = capsule::MakeEndBalls(body, options.parts, overhead.end_balls);
  });
  PrimitiveStage best;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (round > 0) {
      const std::vector<int> tried = std::exchange(counts, allocate());
      if (counts == tried) break;
    }
    PrimitiveStage stage = Build(polygons, counts, overhead, end_balls, curves);
    const bool fits = total.Allows(stage.set.count());
    const int unused = total.Unused(stage.set.count());
    if (round == 0 || (fits && unused < total.Unused(best.set.count()))) best = std::move(stage);
    if (!fits) break;
    if (unused <= kUnusedAllowed) break;
    bonus += unused;
  }
  if (total.Unused(best.set.count()) > kUnusedAllowed) SpendRest(total, best.set);
  return best;
}

std::optional<Warning> WarningOfPolygonError(
    double polygon_error, std::span<const section::FeaturePolygon> polygons,
    std::span<const circle::PolygonApproximation> approximations) {
  std::int64_t missed = 0;
  double worst = 0.0;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const double error = approximations[i].outside_area_m2 / polygons[i].outline.area_m2();
    missed += error > polygon_error ? 1 : 0;
    worst = std::max(worst, error);
  }
  if (missed == 0) return std::nullopt;
  return Warning{"POLYGON_ERROR_MISSED",
                 absl::StrFormat("%d of %d feature polygons have more error than %g, up to %.3g: "
                                 "neither a polygon nor a set may have more circles",
                                 missed, polygons.size(), polygon_error, worst),
                 missed};
}

}  // namespace capfit::pipeline
