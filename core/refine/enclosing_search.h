// The topology of an enclosing set: from layouts to a graph that uses its budget well.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_SEARCH_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_SEARCH_H_

#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/refine/capsule_graph.h"
#include "core/refine/enclosing_task.h"
#include "core/refine/growth.h"

namespace capfit::refine {

// Settles each start, spares what is beyond the spending where the least is lost, cuts capsules in
// two where most volume lies between them and the body, and goes on with the best. Then exchanges:
// what is least missed goes, what it cost is spent on the loosest capsules, all is settled anew,
// and the best of a few such trials is kept if it is better. What is left of the budget then, too
// little for a cut, is tried on ties between near spheres.
//
// `starts` must not be empty. Returns the best few graphs, best first, as far as the task's thinned
// points tell; they fit the spending unless cancelled. Trials run in parallel; same bits for any
// pool. About 60 ms on two cores at 64 primitives, 0.2 s at 128.
[[nodiscard]] std::vector<CapsuleGraph> FindEnclosingGraphs(const EnclosingTask& task,
                                                            const Spending& spending,
                                                            const std::vector<CapsuleGraph>& starts,
                                                            const ThreadPool& pool,
                                                            const FitObserver& observer);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_SEARCH_H_
