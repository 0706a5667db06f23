// What a finished best fit has wasted, spent anew where the error is.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_RESPEND_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_RESPEND_H_

#include "core/base/thread_pool.h"
#include "core/base/work_meter.h"
#include "core/capsule/budget.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/best_fit_objective.h"

namespace capfit::refine {

// Gives up what fills least that nothing else fills, cuts the capsules with most error beside them
// in two with what that frees and what the budget left, and settles all; again and again as long as
// the value falls. Where growing tries every edit of its own, this takes the word of one look at
// the cells: a hundred edits cost what one trial does, and of hundreds of primitives it leads
// further. `piece_cost`: as GrowthOptions.
void Respend(const BestFitObjective& objective, const capsule::Budget& budget, double piece_cost,
             const ThreadPool& pool, WorkMeter& meter, capsule::MirroredSet& graph);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_RESPEND_H_
