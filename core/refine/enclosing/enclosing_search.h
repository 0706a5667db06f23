// The topology of an enclosing set: from layouts to a graph that uses its budget well.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_ENCLOSING_SEARCH_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_ENCLOSING_SEARCH_H_

#include <vector>

#include "core/base/thread_pool.h"
#include "core/base/work_meter.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/enclosing/enclosing_task.h"

namespace capfit::refine {

// How much a search renews.
struct RenewalPlan {
  int rounds = 1;
  // So many graphs, the best, are renewed side by side, each in one way, and the best of all kept:
  // each change of topology leads to a local optimum, and the best may come of what was not best
  // before. One alone is renewed in several ways.
  int kept = 1;
  int found = 1;  // of those so many are given back, the best
  // The first rounds, and the starts, keep only to the sum of the limits of spheres and capsules
  // where a budget has both: a set finds its way out of a local optimum more easily where either
  // kind may make room for the other.
  int free_rounds = 0;

  // Whether a round joins graphs by the regions of the body. The first one would make them alike
  // too soon.
  [[nodiscard]] bool Joins(int round) const { return round > 0; }

  [[nodiscard]] capsule::Budget BudgetOfRound(int round, const capsule::Budget& budget) const {
    return round < free_rounds ? budget.OfAnyKind() : budget;
  }
};

// Settles each start and spares what is beyond the budget where the least is lost. The best of the
// smaller ones grows in rounds: in the graph loosened, ties between near spheres and leaves at the
// points that stick out are added where they win most at once, and the rest of the round cuts
// capsules in two where most volume lies between them and the body. The best of all are then
// renewed by the plan: up to a quarter of the primitives, what is least missed, is given up and
// spent anew in the same way, and the result kept if it is better; from the second round on, too,
// what takes each region of the body from whichever graph is best there (see JoinedGraph). What is
// left of the budget of the very best then, too little for a cut, is tried on ties and leaves.
//
// `rough` may have fewer points than `task`: starts are settled and spared by it, up to twice as
// large as the budget as they may be. `starts` must not be empty. Brings the stage from its
// beginning to `until`. Returns as many as the plan asks for, the best by `task` first, at least
// one; the first fits the budget unless cancelled. What is tried runs in parallel;
// same bits for any pool. A round takes some 6 ms on two cores at 64 primitives, 15 ms at 128, 50
// ms at 250; the starts as long as a few of these, where much of a larger one is spared.
[[nodiscard]] std::vector<capsule::MirroredSet> FindEnclosingGraphs(
    const EnclosingTask& rough, const EnclosingTask& task, const capsule::Budget& budget,
    const RenewalPlan& plan, const std::vector<capsule::MirroredSet>& starts, double until,
    const ThreadPool& pool, WorkMeter& meter);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_ENCLOSING_SEARCH_H_
