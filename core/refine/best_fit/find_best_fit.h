// The set of least E_r: from layouts to a graph that spends its budget where that pays most.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_FIND_BEST_FIT_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_FIND_BEST_FIT_H_

#include "core/base/thread_pool.h"
#include "core/base/work_meter.h"
#include "core/body/body.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/refine_options.h"

namespace capfit::refine {

// Each start, spared or grown to the budget, and exchanges; the best of what they come to. Takes
// the meter to 1. Same bits for any pool; on cancellation the graph so far.
[[nodiscard]] capsule::MirroredSet FindBestFit(const body::Body& body, const RefineOptions& options,
                                               const ThreadPool& pool, WorkMeter& meter);

// The same from a set that is there, without trials.
[[nodiscard]] capsule::MirroredSet SettleBestFit(const body::Body& body,
                                                 const RefineOptions& options,
                                                 const ThreadPool& pool, WorkMeter& meter,
                                                 capsule::PrimitiveSet set);

// Moves and sizes a graph that hangs on the body in the places that it had on another one; its
// topology stays.
void SettleHungBestFit(const body::Body& body, const RefineOptions& options, const ThreadPool& pool,
                       WorkMeter& meter, capsule::MirroredSet& graph);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_FIND_BEST_FIT_H_
