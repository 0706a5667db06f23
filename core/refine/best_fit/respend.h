// What a finished best fit has wasted, spent anew where the error is.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_RESPEND_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_RESPEND_H_

#include "core/base/thread_pool.h"
#include "core/base/work_meter.h"
#include "core/capsule/budget.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/best_fit_objective.h"

namespace capfit::refine {

struct RespendOptions {
  double piece_cost = 0.0;  // as GrowthOptions
  int rounds = 12;          // at most, and four that only spend what is left
  // A round settles so far. After less than kFinish what the rounds have won is finished.
  Effort effort = Effort::kRound;
  double until = 1.0;  // what the meter shows in the end
};

// Gives up what fills least that nothing else fills, cuts the capsules with most error beside them
// in two with what that frees and what the budget has left, and settles all; as long as the value
// falls, which can leave some of the budget. One look at the cells tells what all of it is worth,
// where growing tries each edit by itself: of some hundred primitives it leads further in less
// time. A round takes hardly more than its settling, 10 to 100 ms for 64 to 350 primitives. Same
// bits for any pool.
void Respend(const BestFitObjective& objective, const capsule::Budget& budget,
             const RespendOptions& options, const ThreadPool& pool, WorkMeter& meter,
             capsule::MirroredSet& graph);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_RESPEND_H_
