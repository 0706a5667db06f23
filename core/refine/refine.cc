#include "core/refine/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/status.h"
#include "core/refine/best_fit/best_fit_objective.h"
#include "core/refine/best_fit/growth.h"
#include "core/refine/best_fit/occupancy_grid.h"
#include "core/refine/best_fit/thin_out.h"
#include "core/refine/enclosing/enclosing_moves.h"
#include "core/refine/enclosing/enclosing_search.h"
#include "core/refine/enclosing/enclosing_task.h"
#include "core/refine/graph/graph_edit.h"
#include "core/refine/internal.h"
#include "core/refine/layouts/kept_layout.h"
#include "core/refine/layouts/layout.h"
#include "core/refine/layouts/standard_layouts.h"
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
// Primitives: a best fit beyond grows from a layout of this size, which ends better than what the
// next one, made on mannequins alone, leads to.
constexpr int kLargestGrown = 128;
// Points of the enclosing search are this far apart over the root of the number of primitives,
// relative to the body's size; the second for the last steps.
constexpr double kSpacing = 0.216;
constexpr double kFineSpacing = 0.14;
constexpr double kLeastSpacing = 0.012;
constexpr double kMostSpacing = 0.027;
constexpr int kFineSteps = 8;
constexpr double kFineLooseness = 0.5;  // the shape is found, it need not be found anew
constexpr int kFineTakeInSteps = 2;
// Of the best graph of a thorough search for many primitives that need not move: once more from
// looser, for coverage to take in as it is. Of E_r .3 to .7 % less on average at 64, 95, 128 and
// 250 primitives, for 5 % of the time; of few primitives each goes too far. A graph that is alone
// needs fewer steps before. Beyond 250 the points are too far apart for it: of a cut body E_r rose
// by 10 % at 346.
constexpr int kMostLoosenedLast = 250;
constexpr int kLastSteps = 8;
constexpr double kLastLooseness = 1.0;
constexpr int kFineStepsAlone = 4;
constexpr int kHungSteps = 8;      // for a layout that is kept
constexpr int kHungFineSteps = 4;  // coverage takes in what these leave out
// Of an enclosing search: rounds of giving up and spending anew, one for so many primitives (where
// there are more of them, more can be placed better; of few a round costs little), and how much of
// the time it takes.
constexpr int kPrimitivesPerRound = 50;
constexpr int kFewOfEnclosing = 60;
constexpr RenewalPlan kRenewalsOfFew = {.rounds = 3, .kept = 6};
constexpr int kSomeOfEnclosing = 80;
constexpr RenewalPlan kRenewalsOfSome = {.rounds = 3, .kept = 2};
constexpr int kLeastRounds = 2;
constexpr int kMostRounds = 6;
constexpr int kQuickRounds = 1;
constexpr double kSearched = 0.92;
constexpr double kFillingShare = 0.75;    // of the budget, that a standard layout must use
constexpr double kSparedAlone = 0.8;      // of the budget: up to so much spared, nothing is grown
constexpr double kHungShapeFound = 0.45;  // of its time, as measured
// How much of the time of a best fit has gone by when it is done with each, as measured.
constexpr double kSettled = 0.02;
constexpr double kGrown = 0.5;
constexpr double kExchanged = 0.75;
constexpr double kFinished = 0.78;

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
  plan.thorough_share = 0.15;
  plan.exchanges = ExchangesFor(options, excess);
  return plan;
}

void RemoveUseless(capsule::MirroredSet& graph) {
  MergeSwallowed(graph);
  RemoveSwallowed(graph);
}

// Settles the start and brings it up to the budget.
capsule::MirroredSet FindSet(const BestFitObjective& objective, const RefineOptions& options,
                             const ThreadPool& pool, double until, WorkMeter& meter,
                             capsule::MirroredSet graph) {
  const capsule::Budget& budget = options.budget;
  const double begin = meter.until();
  const auto at = [&](double share) { return begin + share * (until - begin); };
  GrowthOptions plan = PlanGrowth(options, budget.Excess(graph.count()));
  GrowthOptions at_first = plan;
  at_first.exchanges = 0;
  at_first.until = at(kGrown);
  plan.until = at(kExchanged);
  meter.Expect(at(kSettled), 1);
  objective.Settle(Effort::kRough, pool, meter.observer(), graph);
  RemoveUseless(graph);
  Spare(objective, budget, at_first, pool, meter, graph);
  Grow(objective, budget, at_first, pool, meter, graph);
  Grow(objective, budget, plan, pool, meter, graph);
  meter.Expect(at(kFinished), 1);
  objective.Settle(Effort::kFinish, pool, meter.observer(), graph);
  RemoveUseless(graph);
  // What has become useless in the end is spent once more.
  const int used = graph.primitive_count();
  GrowthOptions last;
  last.piece_cost = kPieceCost;
  last.until = until;
  Grow(objective, budget, last, pool, meter, graph);
  if (graph.primitive_count() != used)
    objective.Settle(Effort::kTighten, pool, meter.observer(), graph);
  meter.Expect(until, 1);
  SpendByCutting(objective, budget, pool, meter, graph);
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

// Between the points of the enclosing search.
struct Spacings {
  double rough;  // for its starts, much of which is given up again
  double usual;
  double fine;  // for the last steps
};

Spacings SpacingsFor(int primitives) {
  const double share = 1.0 / std::sqrt(static_cast<double>(primitives));
  const double usual = std::clamp(kSpacing * share, kLeastSpacing, kMostSpacing);
  return {kMostSpacing, usual, std::clamp(kFineSpacing * share, kLeastSpacing, usual)};
}

RenewalPlan RenewalsFor(bool thorough, int primitives) {
  if (!thorough) return {.rounds = kQuickRounds};
  if (primitives <= kFewOfEnclosing) return kRenewalsOfFew;
  if (primitives <= kSomeOfEnclosing) return kRenewalsOfSome;
  return {.rounds = std::clamp(primitives / kPrimitivesPerRound, kLeastRounds, kMostRounds)};
}

// No more than this is spared where a standard layout serves, beyond the budget.
int MostSparedBeside(int primitives) { return primitives / 2; }

// Standard layouts that fill the budget or have little to spare. They were chosen for how well they
// serve many bodies, and a short search seldom comes to them by itself.
std::vector<capsule::MirroredSet> StandardStarts(const body::Body& body,
                                                 const RefineOptions& options, int primitives) {
  std::vector<capsule::MirroredSet> starts;
  for (const KeptLayout& layout : StandardLayouts()) {
    const bool fills = options.budget.Excess(layout.count()) <= MostSparedBeside(primitives) &&
                       static_cast<double>(layout.count().total()) >= kFillingShare * primitives;
    if (!fills || layout.parts() != options.parts) continue;
    absl::StatusOr<capsule::MirroredSet> graph = HangLayout(layout, body);
    if (graph.ok()) starts.push_back(*std::move(graph));
  }
  return starts;
}

// Where a larger layout has not much too much, what smaller ones grow to often looks better on few
// points and ends up to a tenth worse.
void KeepSparedAlone(const capsule::Budget& budget, int primitives,
                     std::vector<capsule::MirroredSet>& starts) {
  const int excess = budget.Excess(starts.front().count());  // the larger ones come first
  if (excess <= 0 || excess > kSparedAlone * primitives) return;
  std::erase_if(
      starts, [&](const capsule::MirroredSet& graph) { return budget.Excess(graph.count()) <= 0; });
}

// What the enclosing search starts from.
std::vector<capsule::MirroredSet> StartsOf(const body::Body& body, const RefineOptions& options,
                                           int primitives, const ThreadPool& pool) {
  std::vector<capsule::MirroredSet> standard = StandardStarts(body, options, primitives);
  // What is spared in a larger layout leaves a better one than growth finds, but takes long and is
  // no better than a standard layout.
  std::vector<capsule::MirroredSet> starts = StartingGraphs(
      FitKind::kEnclose, body, options.parts, options.budget,
      {.most_spared = standard.empty() ? capsule::kNoLimit : MostSparedBeside(primitives)}, pool);
  if (primitives > kSomeOfEnclosing) KeepSparedAlone(options.budget, primitives, starts);
  std::move(standard.begin(), standard.end(), std::back_inserter(starts));
  return starts;
}

capsule::MirroredSet FindEnclosing(const body::Body& body, const tighten::CoverTarget& target,
                                   const RefineOptions& options, const ThreadPool& pool,
                                   WorkMeter& meter) {
  const int primitives = options.budget.UsualPrimitives();
  const Spacings spacings = SpacingsFor(primitives);
  // Each thins the points out on one thread, for some milliseconds on large meshes.
  std::optional<EnclosingTask> usual, fine, rough;
  const std::array task_of = {std::pair(&usual, spacings.usual), std::pair(&fine, spacings.fine),
                              std::pair(&rough, spacings.rough)};
  std::vector<capsule::MirroredSet> starts;
  pool.ForEach(spacings.rough > spacings.usual ? 4 : 3, [&](std::size_t i) {
    if (i == 0) {
      starts = StartsOf(body, options, primitives, pool);
      return;
    }
    const auto& [task, spacing] = task_of[i - 1];
    task->emplace(target, body.is_symmetric, options.tolerance_m, spacing);
  });
  const RenewalPlan plan = RenewalsFor(options.thorough, primitives);
  std::vector<capsule::MirroredSet> graphs = FindEnclosingGraphs(
      rough ? *rough : *usual, *usual, options.budget, plan, starts, kSearched, pool, meter);
  const bool is_loosened_last = options.thorough && !options.will_move &&
                                primitives > kFewOfEnclosing && primitives <= kMostLoosenedLast;
  const int steps = is_loosened_last && graphs.size() == 1 ? kFineStepsAlone : kFineSteps;
  const int graph_steps = (steps + kFineTakeInSteps) * static_cast<int>(graphs.size()) +
                          (is_loosened_last ? kLastSteps : 0);
  meter.Expect(1.0, std::int64_t{graph_steps} * graphs.front().primitive_count());
  // Few points tell graphs apart less well than all of them do.
  std::vector<double> values(graphs.size(), 0.0);
  pool.ForEach(graphs.size(), [&](std::size_t i) {
    fine->FindShape(steps, kFineLooseness, /*seed=*/1, pool, meter, graphs[i]);
    JoinNearPairs(graphs[i]);  // what that saves is spent again
    CutLoosest(options.budget, primitives, fine->Weigh(graphs[i]).edge_gap, graphs[i]);
    fine->TakeIn(kFineTakeInSteps, /*seed=*/2, pool, meter, graphs[i]);
    if (graphs.size() > 1) values[i] = fine->Value(graphs[i], pool);
  });
  capsule::MirroredSet& best =
      graphs[std::min_element(values.begin(), values.end()) - values.begin()];
  if (is_loosened_last) {
    fine->FindShape(kLastSteps, kLastLooseness, /*seed=*/1, pool, meter, best);
  }
  return std::move(best);
}

// A layout that hangs on the body in the places that it had on another one.
void Enclose(const tighten::CoverTarget& target, const RefineOptions& options,
             const ThreadPool& pool, WorkMeter& meter, capsule::MirroredSet& graph) {
  const Spacings spacings = SpacingsFor(graph.primitive_count());
  const auto work = [&](int steps) { return std::int64_t{steps} * graph.primitive_count(); };
  meter.Expect(kHungShapeFound, work(kHungSteps));
  const EnclosingTask task(target, graph.is_mirrored(), options.tolerance_m, spacings.usual);
  task.FindShape(kHungSteps, 1.0, /*seed=*/1, pool, meter, graph);
  meter.Expect(1.0, work(kHungFineSteps));
  const EnclosingTask fine(target, graph.is_mirrored(), options.tolerance_m, spacings.fine);
  fine.FindShape(kHungFineSteps, kFineLooseness, /*seed=*/1, pool, meter, graph);
}

void FitBest(const body::Body& body, const RefineOptions& options, const ThreadPool& pool,
             WorkMeter& meter, capsule::MirroredSet& graph) {
  meter.Expect(1.0, 1);
  const BestFitObjective objective = MakeBestFitObjective(body, options, graph.is_mirrored(), pool);
  objective.Settle(Effort::kRough, pool, meter.observer(), graph);
  objective.Settle(Effort::kFinish, pool, meter.observer(), graph);
}

body::Part PartAt(const body::Body& body, const Vec3& point_m) {
  double least = std::numeric_limits<double>::max();
  std::size_t nearest = 0;
  const auto vertices = body.mesh.vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double distance = (vertices[v] - point_m).squaredNorm();
    if (distance < least) least = distance, nearest = v;
  }
  return body::PartOf(body.vertex_segments[nearest]);
}

// The two of a pair belong to the two parts of a pair, and what lies in the middle to the trunk.
void MirrorParts(const body::PartSelection& parts, capsule::PrimitiveSet& set) {
  for (std::size_t v = 0; v < set.origins.size(); ++v) {
    body::Part& part = set.origins[v].part;
    const int image = set.origins[v].mirror;
    if (std::cmp_greater(image, v)) set.origins[image].part = body::MirrorPart(part);
    if (std::cmp_equal(image, v) && body::MirrorPart(part) != part && parts.torso) {
      part = body::Part::kTorso;
    }
  }
}

}  // namespace

capsule::PrimitiveSet RefineSet(const body::Body& body, const tighten::CoverTarget& target,
                                const RefineOptions& options, const ThreadPool& pool,
                                FitObserver& observer) {
  WorkMeter meter(observer);
  const capsule::MirroredSet graph = options.enclose
                                         ? FindEnclosing(body, target, options, pool, meter)
                                         : FindBestFit(body, options, pool, meter);
  meter.Expect(1.0, 1);
  capsule::PrimitiveSet set = graph.set();
  pool.ForEach(graph.spheres().size(), [&](std::size_t v) {
    // An image's part is the image of a part.
    if (observer.IsCancelled() || !graph.IsRepresentative(static_cast<int>(v))) return;
    set.origins[v].part = PartAt(body, graph.spheres()[v].center_m);
  });
  if (graph.is_mirrored()) MirrorParts(options.parts, set);
  return set;
}

absl::StatusOr<capsule::PrimitiveSet> FitToLayout(const body::Body& body,
                                                  const tighten::CoverTarget& target,
                                                  const KeptLayout& layout,
                                                  const RefineOptions& options,
                                                  const ThreadPool& pool, FitObserver& observer) {
  CAPFIT_ASSIGN_OR_RETURN(capsule::MirroredSet graph, HangLayout(layout, body));
  WorkMeter meter(observer);
  if (options.enclose) {
    Enclose(target, options, pool, meter, graph);
  } else {
    FitBest(body, options, pool, meter, graph);
  }
  return graph.set();
}

}  // namespace capfit::refine
