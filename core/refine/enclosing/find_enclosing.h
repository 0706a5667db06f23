// The enclosing set of least volume: from layouts to a graph that coverage takes the last in for.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_FIND_ENCLOSING_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_FIND_ENCLOSING_H_

#include "core/base/thread_pool.h"
#include "core/base/work_meter.h"
#include "core/body/body.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/refine_options.h"
#include "core/tighten/cover_target.h"

namespace capfit::refine {

// Searches from the layouts that come near to the budget (FindEnclosingGraphs) and settles what is
// kept on denser points; the best by those. Takes the meter to 1. Same bits for any pool; on
// cancellation the graph so far.
[[nodiscard]] capsule::MirroredSet FindEnclosing(const body::Body& body,
                                                 const tighten::CoverTarget& target,
                                                 const RefineOptions& options,
                                                 const ThreadPool& pool, WorkMeter& meter);

// Moves and sizes a graph that hangs on the body in the places that it had on another one; its
// topology stays.
void SettleHungEnclosing(const tighten::CoverTarget& target, const RefineOptions& options,
                         const ThreadPool& pool, WorkMeter& meter, capsule::MirroredSet& graph);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_FIND_ENCLOSING_H_
