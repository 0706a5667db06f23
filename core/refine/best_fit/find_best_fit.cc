#include "core/refine/best_fit/find_best_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/refine/best_fit/best_fit_objective.h"
#include "core/refine/best_fit/growth.h"
#include "core/refine/best_fit/occupancy_grid.h"
#include "core/refine/best_fit/respend.h"
#include "core/refine/best_fit/thin_out.h"
#include "core/refine/graph/graph_edit.h"
#include "core/refine/layouts/layout.h"
#include "core/refine/layouts/starting_graphs.h"

namespace capfit::refine {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double kCellM = 0.008;  // of the occupancy grid
// Of the points that tell what is left out by far, which several in each cell do: a dozen
// centimetres count, not millimetres.
constexpr double kThinnedCellM = 0.03;
// What a sphere or chain that hangs on nothing counts beside its primitives in a best fit: in one
// piece is what users want, but it costs a twentieth to a tenth of the error.
constexpr double kPieceCost = 0.45;
constexpr int kFewOfBestFit = 40;  // primitives: up to here each matters much
// Rounds that give up primitives of a best fit and spend them elsewhere. The more there was to
// spare the less they pay: nothing where a start had three quarters of the budget too much.
struct Exchanges {
  int of_few, of_much_spared, of_spared, of_others;
};
constexpr Exchanges kExchanges = {8, 0, 1, 2};
constexpr Exchanges kQuickExchanges = {1, 0, 0, 1};
constexpr double kMuchSpared = 0.75;  // of the budget
// Rounds that respend. What sparing leaves has little that does nothing: with 128 primitives two
// rounds win less than 1 % and take a quarter of the time.
constexpr int kRespendsOfSpared = 0;
// Primitives: a best fit beyond grows from a layout of this size, which ends better than what the
// next one, made on mannequins alone, leads to.
constexpr int kLargestGrown = 128;
// How much of the time of a best fit has gone by when it is done with each, as measured.
constexpr double kSettled = 0.02;
constexpr double kGrown = 0.4;
constexpr double kExchanged = 0.6;
constexpr double kFinished = 0.65;
constexpr double kGrownLast = 0.7;
// The same of a set that does not grow.
constexpr double kSettledFirst = 0.1;

// The vertices of the selected parts; folded to x >= 0 where symmetric. Of mirrored vertices both
// stay: thinning out keeps one of them.
std::vector<Eigen::Vector3f> SelectedPoints(const body::Body& body, const RefineOptions& options,
                                            bool symmetric) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t v = 0; v < body.mesh.vertices().size(); ++v) {
    if (!options.parts.Includes(body::PartOf(body.vertex_segments[v]))) continue;
    points.push_back(body.mesh.vertices()[v].cast<float>());
    if (symmetric) points.back().x() = std::abs(points.back().x());
  }
  return points;
}

bool IsOfFew(const capsule::Budget& budget) {
  return std::min(budget.max_primitives, budget.max_spheres) <= kFewOfBestFit;
}

// Of a start that has `excess` primitives too many.
int ExchangesFor(const RefineOptions& options, int excess) {
  const Exchanges& exchanges = options.thorough ? kExchanges : kQuickExchanges;
  if (IsOfFew(options.budget)) return exchanges.of_few;
  if (excess >= kMuchSpared * options.budget.UsualPrimitives()) return exchanges.of_much_spared;
  return excess > 0 ? exchanges.of_spared : exchanges.of_others;
}

// How best fits are grown: their edits show late what they are worth.
GrowthOptions PlanGrowth(const RefineOptions& options, int excess) {
  GrowthOptions plan;
  plan.piece_cost = kPieceCost;
  plan.thorough_share = 0.3;
  plan.exchanges = ExchangesFor(options, excess);
  return plan;
}

// Of a set that is still to be settled.
void RemoveUseless(capsule::MirroredSet& graph) {
  MergeSwallowed(graph);
  RemoveSwallowed(graph);
}

// Whether growing by trials brings a start up to the budget. Respending alone takes a third of the
// time: E_r is up to 4 % more with 160 to 350 primitives, and much more of few.
bool GrowsByTrials(const RefineOptions& options, bool was_spared) {
  return options.thorough || was_spared || IsOfFew(options.budget);
}

// Settles the start and brings it up to the budget.
capsule::MirroredSet FindSet(const BestFitObjective& objective, const RefineOptions& options,
                             const ThreadPool& pool, double until, WorkMeter& meter,
                             capsule::MirroredSet graph) {
  const capsule::Budget& budget = options.budget;
  const double begin = meter.until();
  const auto at = [&](double share) { return begin + share * (until - begin); };
  const bool was_spared = budget.Excess(graph.count()) > 0;
  GrowthOptions plan = PlanGrowth(options, budget.Excess(graph.count()));
  GrowthOptions at_first = plan;
  at_first.exchanges = 0;
  at_first.until = at(kGrown);
  plan.until = at(kExchanged);
  meter.Expect(at(kSettled), 1);
  objective.Settle(Effort::kRough, pool, meter.observer(), graph);
  RemoveUseless(graph);
  Spare(objective, budget, at_first, pool, meter, graph);
  const bool grows = GrowsByTrials(options, was_spared);
  if (grows) {
    Grow(objective, budget, at_first, pool, meter, graph);
    Grow(objective, budget, plan, pool, meter, graph);
  }
  meter.Expect(at(grows ? kFinished : kSettledFirst), 1);
  objective.Settle(Effort::kFinish, pool, meter.observer(), graph);
  RemoveSwallowed(graph);
  // What has become useless in the end is spent once more.
  const int used = graph.primitive_count();
  GrowthOptions last;
  last.piece_cost = kPieceCost;
  last.until = at(kGrownLast);
  if (grows) Grow(objective, budget, last, pool, meter, graph);
  if (graph.primitive_count() != used)
    objective.Settle(Effort::kTighten, pool, meter.observer(), graph);
  RespendOptions respends;
  respends.piece_cost = kPieceCost;
  if (was_spared) respends.rounds = kRespendsOfSpared;
  respends.effort = options.thorough ? Effort::kFinish : Effort::kRound;
  respends.until = until;
  Respend(objective, budget, respends, pool, meter, graph);
  return graph;
}

BestFitObjective MakeBestFitObjective(const body::Body& body, const RefineOptions& options,
                                      bool symmetric, const ThreadPool& pool) {
  OccupancyGrid grid;
  std::vector<Vec3> thinned;
  pool.ForEach(2, [&](std::size_t i) {
    if (i == 0) {
      grid = MakeOccupancyGrid(body, options.parts, kCellM, symmetric, pool);
      return;
    }
    for (const Eigen::Vector3f& p :
         ThinOut(SelectedPoints(body, options, symmetric), kThinnedCellM)) {
      thinned.push_back(p.cast<double>());
    }
  });
  SurfacePoints points{tighten::PointGrid(thinned), options.tolerance_m};
  return {std::move(grid), std::move(points), options.seed};
}

// Of the larger layouts and those that fit. What is left of a much larger one serves the single
// body better than what a smaller one grows to, by a tenth at half its size; only of few primitives
// either may end better, and much larger ones fall into more pieces.
std::vector<capsule::MirroredSet> BestFitStarts(const body::Body& body,
                                                const RefineOptions& options,
                                                const ThreadPool& pool) {
  StartSizes sizes{.largest_grown = kLargestGrown};
  if (!IsOfFew(options.budget)) {
    sizes.least_spared = static_cast<int>(kMuchSpared * options.budget.UsualPrimitives());
  }
  std::vector<capsule::MirroredSet> starts =
      StartingGraphs(FitKind::kBestFit, body, options.parts, options.budget, sizes, pool);
  if (!IsOfFew(options.budget)) starts.resize(1);
  return starts;
}

}  // namespace

capsule::MirroredSet FindBestFit(const body::Body& body, const RefineOptions& options,
                                 const ThreadPool& pool, WorkMeter& meter) {
  const BestFitObjective objective = MakeBestFitObjective(body, options, body.is_symmetric, pool);
  std::vector<capsule::MirroredSet> starts = BestFitStarts(body, options, pool);
  capsule::MirroredSet best;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double until = static_cast<double>(i + 1) / static_cast<double>(starts.size());
    capsule::MirroredSet graph =
        FindSet(objective, options, pool, until, meter, std::move(starts[i]));
    if (meter.IsCancelled()) return graph;
    // Over the budget only where nothing more could be spared.
    const double value = objective.Value(graph, pool) + options.budget.Excess(graph.count());
    if (value < least) {
      least = value;
      best = std::move(graph);
    }
  }
  return best;
}

capsule::MirroredSet SettleBestFit(const body::Body& body, const RefineOptions& options,
                                   const ThreadPool& pool, WorkMeter& meter,
                                   capsule::PrimitiveSet set) {
  const bool is_mirrored = body.is_symmetric && capsule::ImagesOf(set).is_whole;
  const BestFitObjective objective = MakeBestFitObjective(body, options, is_mirrored, pool);
  capsule::MirroredSet graph(std::move(set), is_mirrored);
  meter.Expect(kSettledFirst, 1);
  objective.Settle(Effort::kRough, pool, meter.observer(), graph);
  RemoveUseless(graph);
  // Of few primitives nothing may be left to spend, and no round settles them.
  objective.Settle(Effort::kFinish, pool, meter.observer(), graph);
  RespendOptions respends;
  respends.piece_cost = kPieceCost;
  Respend(objective, options.budget, respends, pool, meter, graph);
  return graph;
}

void SettleHungBestFit(const body::Body& body, const RefineOptions& options, const ThreadPool& pool,
                       WorkMeter& meter, capsule::MirroredSet& graph) {
  meter.Expect(1.0, 1);
  const BestFitObjective objective = MakeBestFitObjective(body, options, graph.is_mirrored(), pool);
  objective.Settle(Effort::kRough, pool, meter.observer(), graph);
  objective.Settle(Effort::kFinish, pool, meter.observer(), graph);
}

}  // namespace capfit::refine
