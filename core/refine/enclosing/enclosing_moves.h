// Where an enclosing graph may change: what is least missed, where another primitive would win.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_ENCLOSING_MOVES_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_ENCLOSING_MOVES_H_

#include <vector>

#include "core/base/thread_pool.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/growth.h"
#include "core/refine/enclosing/enclosing_task.h"
#include "core/refine/graph/graph_edit.h"

namespace capfit::refine {

struct Removal {
  double loss_per_primitive = 0.0;  // cubic metres that have to grow elsewhere
  Edit edit;                        // kUnlink or kDissolve
};

// All that may go, what is least missed first.
[[nodiscard]] std::vector<Removal> RemovalsOf(const capsule::MirroredSet& graph,
                                              const GraphWorth& worth);

// A graph that several removals are taken from which were all found in it.
class SparedGraph {
 public:
  explicit SparedGraph(const capsule::MirroredSet& graph);

  // Nothing happens where a sphere that the removal touches was touched by one before, or where it
  // is not possible.
  void Remove(const Edit& edit);
  [[nodiscard]] const capsule::MirroredSet& graph() const { return graph_; }

 private:
  const capsule::MirroredSet& before_;
  capsule::MirroredSet graph_;
  std::vector<int> index_;        // in `graph_`, by sphere of the graph before; -1: gone
  std::vector<char> is_touched_;  // by sphere of the graph before
};

// What the graph has with a tie or leaf more, and its image.
[[nodiscard]] capsule::PrimitiveCount CountWith(const capsule::MirroredSet& graph,
                                                const Edit& addition);

// Ties between near spheres, and leaves at the points that stick out most, which win at once in a
// loosened graph (see EnclosingTask::Loosen); what wins most for a primitive first.
[[nodiscard]] std::vector<Edit> RankedAdditions(const EnclosingTask& task,
                                                const capsule::MirroredSet& loose,
                                                const ThreadPool& pool);

// Cuts the loosest capsules in two until there are `target` primitives or nothing may be cut. The
// spheres in the middle change nothing yet. `gaps`: GraphWorth::edge_gap.
void CutLoosest(const capsule::Budget& budget, int target, const std::vector<double>& gaps,
                capsule::MirroredSet& graph);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_ENCLOSING_MOVES_H_
