// The topology of an enclosing set: from layouts to a graph that uses its budget well.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_ENCLOSING_SEARCH_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_ENCLOSING_SEARCH_H_

#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/growth.h"
#include "core/refine/enclosing/enclosing_task.h"

namespace capfit::refine {

// Settles each start and spares what is beyond the budget where the least is lost. The small ones
// grow in rounds, two at a time and each in two ways: in the graph loosened, ties between near
// spheres and leaves at the points that stick out are added where they win most at once, and the
// rest of the round cuts capsules in two where most volume lies between them and the body. Then, of
// few primitives, exchanges: what is least missed goes, what it cost is spent again, and the best
// of a few such trials is kept if it is better; of many, up to a quarter is given up and spent anew
// at once. What is left of the budget then, too little for a cut, is tried on ties and leaves.
//
// `starts` must not be empty. Tells the observer the fraction of its own work. Returns the best few
// graphs, best first, as far as the task's thinned points tell; they fit the budget unless
// cancelled. Trials run in parallel, and searches may run side by side; same bits for any pool.
// About 0.1 s on two cores at 64 primitives, 0.25 s at 128, 1 s at 250.
[[nodiscard]] std::vector<capsule::MirroredSet> FindEnclosingGraphs(
    const EnclosingTask& task, const capsule::Budget& budget,
    const std::vector<capsule::MirroredSet>& starts, const ThreadPool& pool, FitObserver& observer);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_ENCLOSING_SEARCH_H_
