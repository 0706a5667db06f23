#include "core/refine/enclosing/find_enclosing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "core/refine/best_fit/occupancy_grid.h"
#include "core/refine/enclosing/enclosing_moves.h"
#include "core/refine/enclosing/enclosing_search.h"
#include "core/refine/enclosing/enclosing_task.h"
#include "core/refine/graph/graph_edit.h"
#include "core/refine/layouts/kept_layout.h"
#include "core/refine/layouts/standard_layouts.h"
#include "core/refine/layouts/starting_graphs.h"

namespace capfit::refine {
namespace {

// Points of the enclosing search are this far apart over the root of the number of primitives,
// relative to the body's size; the second for the last steps.
constexpr double kSpacing = 0.216;
constexpr double kFineSpacing = 0.14;
constexpr double kLeastSpacing = 0.012;
// Of the last steps, whose small capsules fit into the meshes of a wider net: with .012 there E_r
// is 1 % more with 250 primitives and 2 to 4 % more with 346 to 700.
constexpr double kLeastFineSpacing = 0.007;
constexpr double kMostSpacing = 0.027;
constexpr int kFineSteps = 8;
constexpr double kFineLooseness = 0.5;  // the shape is found, it need not be found anew
constexpr int kFineTakeInSteps = 2;
// Of the best graph of a thorough search for many primitives that need not move: once more from
// looser, for coverage to take in as it is. Of E_r .3 to .7 % less on average at 64, 95, 128 and
// 250 primitives, for 5 % of the time; of few primitives each goes too far. A graph that is alone
// needs fewer steps before. Beyond 500 the points are too far apart for it.
constexpr int kMostLoosenedLast = 500;
constexpr int kLastSteps = 8;
constexpr double kLastLooseness = 1.0;
constexpr int kFineStepsAlone = 4;
constexpr int kHungSteps = 8;      // for a layout that is kept
constexpr int kHungFineSteps = 6;  // coverage takes in what these leave out
// Of an enclosing search: rounds of giving up and spending anew, one for so many primitives (where
// there are more of them, more can be placed better; of few a round costs little, and each place
// matters more), and how much of the time it takes.
constexpr int kPrimitivesPerRound = 36;
constexpr int kFewOfEnclosing = 60;
constexpr RenewalPlan kRenewalsOfFew = {.rounds = 4, .kept = 6, .found = 3, .free_rounds = 1};
constexpr int kSomeOfEnclosing = 80;
constexpr RenewalPlan kRenewalsOfSome = {.rounds = 3, .kept = 4, .found = 2, .free_rounds = 1};
constexpr int kLeastRounds = 3;
constexpr int kMostRounds = 8;
constexpr int kKeptOfMany = 2;
constexpr int kQuickRounds = 1;
constexpr double kSearched = 0.92;
constexpr double kFillingShare = 0.75;  // of the budget, that a standard layout must use
constexpr double kLeastExcess = 0.12;   // of the budget: a layout with less too much is passed over
constexpr double kSparedAlone = 0.8;    // of the budget: up to so much spared, nothing is grown
// Sets of more than so many must not leave cells of this size, relative to the body's, empty that
// it fills. E_r is 7 to 13 % less with 346 and 420 of bodies without head, hands and feet, of
// which one in sixteen left a tenth of the body hollow, and .6 % less on average with 95 to 299.
// Sets of fewer are too coarse for hollows.
constexpr int kMostSolid = 80;
constexpr double kFullCell = 0.015;
constexpr double kHungShapeFound = 0.35;  // of its time, as measured

// Between the points of the enclosing search.
struct Spacings {
  double rough;  // for its starts, much of which is given up again
  double usual;
  double fine;  // for the last steps
};

Spacings SpacingsFor(int primitives) {
  const double share = 1.0 / std::sqrt(static_cast<double>(primitives));
  const double usual = std::clamp(kSpacing * share, kLeastSpacing, kMostSpacing);
  return {kMostSpacing, usual, std::clamp(kFineSpacing * share, kLeastFineSpacing, usual)};
}

RenewalPlan RenewalsFor(bool thorough, int primitives) {
  if (!thorough) return {.rounds = kQuickRounds};
  if (primitives <= kFewOfEnclosing) return kRenewalsOfFew;
  if (primitives <= kSomeOfEnclosing) return kRenewalsOfSome;
  return {.rounds = std::clamp(primitives / kPrimitivesPerRound, kLeastRounds, kMostRounds),
          .kept = kKeptOfMany};
}

// No more than this is spared where a standard layout serves, beyond the budget.
int MostSparedBeside(int primitives) { return primitives / 2; }

// Standard layouts that fill the budget or have little to spare. They were chosen for how well they
// serve many bodies, and a short search seldom comes to them by itself.
std::vector<capsule::MirroredSet> StandardStarts(const body::Body& body,
                                                 const RefineOptions& options,
                                                 const capsule::Budget& budget, int primitives) {
  std::vector<capsule::MirroredSet> starts;
  for (const KeptLayout& layout : StandardLayouts()) {
    const bool fills = budget.Excess(layout.count()) <= MostSparedBeside(primitives) &&
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
                                           const capsule::Budget& budget, int primitives,
                                           const ThreadPool& pool) {
  std::vector<capsule::MirroredSet> standard = StandardStarts(body, options, budget, primitives);
  // What is spared in a larger layout leaves a better one than growth finds, but takes long and is
  // no better than a standard layout.
  std::vector<capsule::MirroredSet> starts = StartingGraphs(
      FitKind::kEnclose, body, options.parts, budget,
      {.least_spared = static_cast<int>(kLeastExcess * primitives),
       .most_spared = standard.empty() ? capsule::kNoLimit : MostSparedBeside(primitives)},
      pool);
  if (primitives > kSomeOfEnclosing) KeepSparedAlone(budget, primitives, starts);
  std::move(standard.begin(), standard.end(), std::back_inserter(starts));
  return starts;
}

}  // namespace

capsule::MirroredSet FindEnclosing(const body::Body& body, const tighten::CoverTarget& target,
                                   const RefineOptions& options, const ThreadPool& pool,
                                   WorkMeter& meter) {
  const int primitives = options.budget.UsualPrimitives();
  const RenewalPlan plan = RenewalsFor(options.thorough, primitives);
  const Spacings spacings = SpacingsFor(primitives);
  tighten::FullCells full;
  // Each thins the points out on one thread, for some milliseconds on large meshes.
  std::optional<EnclosingTask> usual, fine, rough;
  const std::array task_of = {std::pair(&usual, spacings.usual), std::pair(&fine, spacings.fine),
                              std::pair(&rough, spacings.rough)};
  const std::size_t tasks = spacings.rough > spacings.usual ? 3 : 2;
  const bool may_be_hollow = primitives > kMostSolid;
  std::vector<capsule::MirroredSet> starts;
  pool.ForEach(1 + tasks + (may_be_hollow ? 1 : 0), [&](std::size_t i) {
    if (i == 0) {
      starts = StartsOf(body, options, plan.BudgetOfRound(0, options.budget), primitives, pool);
    } else if (i <= tasks) {
      const auto& [task, spacing] = task_of[i - 1];
      const bool joins = task == &usual && plan.Joins(plan.rounds - 1);
      task->emplace(target, body.is_symmetric, options.tolerance_m, spacing,
                    may_be_hollow ? &full : nullptr, joins ? BodyRegions(body) : BodyRegions());
    } else {
      const double cell_m = kFullCell * tighten::SizeOf(target);
      full = FullCellsOf(MakeOccupancyGrid(body, options.parts, cell_m, body.is_symmetric, pool));
    }
  });
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
    if (graphs.size() > 1) values[i] = fine->Value(graphs[i], pool).total_m3;
  });
  capsule::MirroredSet& best =
      graphs[std::min_element(values.begin(), values.end()) - values.begin()];
  if (is_loosened_last) {
    fine->FindShape(kLastSteps, kLastLooseness, /*seed=*/1, pool, meter, best);
  }
  return std::move(best);
}

// A layout that hangs on the body in the places that it had on another one.
void SettleHungEnclosing(const tighten::CoverTarget& target, const RefineOptions& options,
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

}  // namespace capfit::refine
