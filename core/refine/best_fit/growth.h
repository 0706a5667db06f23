// Spending a budget where it pays most: growing, sparing and exchanging primitives.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_GROWTH_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_GROWTH_H_

#include "core/base/thread_pool.h"
#include "core/base/work_meter.h"
#include "core/capsule/budget.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/best_fit_objective.h"

namespace capfit::refine {

struct GrowthOptions {
  int worst_points = 16;         // where leaves are tried in each round
  double batch_share = 0.4;      // of the room left, spent in one round (at least one edit)
  double thorough_share = 0.35;  // of the edits glanced at, how many are tried in earnest
  int exchanges = 0;             // rounds that give up the least and spend it elsewhere
  // What each further piece of the graph counts, in primitives: sets in one piece are preferred.
  double piece_cost = 0.0;
  double until = 1.0;  // what the meter shows when this growing is done
};

// Removes what costs least until the graph is within the budget.
void Spare(const BestFitObjective& objective, const capsule::Budget& budget,
           const GrowthOptions& options, const ThreadPool& pool, WorkMeter& meter,
           capsule::MirroredSet& graph);

// Adds what gains most per primitive until nothing fits or nothing gains. Each round tries all
// edits, settled near by, in parallel; the best ones that do not touch each other are kept.
void Grow(const BestFitObjective& objective, const capsule::Budget& budget,
          const GrowthOptions& options, const ThreadPool& pool, WorkMeter& meter,
          capsule::MirroredSet& graph);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_GROWTH_H_
