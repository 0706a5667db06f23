// What a search starts from: the stored layouts that come near to a budget.
#ifndef CAPFIT_CORE_REFINE_LAYOUTS_STARTING_GRAPHS_H_
#define CAPFIT_CORE_REFINE_LAYOUTS_STARTING_GRAPHS_H_

#include <vector>

#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/layouts/layout.h"

namespace capfit::refine {

// Which layouts are worth starting from, by primitives.
struct StartSizes {
  // Of what has to go of a layout beyond the budget; less only where none has so much.
  int least_spared = 1;
  int most_spared = capsule::kNoLimit;
  int largest_grown = capsule::kNoLimit;  // of a layout that fits, or has less to spare
};

// At least one graph: the next layouts beyond the budget, where so much of them has to go, then
// those of the largest number of primitives that fits. Layouts with spheres for head, hands and
// feet where any of these parts is selected and present.
[[nodiscard]] std::vector<capsule::MirroredSet> StartingGraphs(FitKind kind, const body::Body& body,
                                                               const body::PartSelection& parts,
                                                               const capsule::Budget& budget,
                                                               const StartSizes& sizes,
                                                               const ThreadPool& pool);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_LAYOUTS_STARTING_GRAPHS_H_
