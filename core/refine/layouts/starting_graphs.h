// What a search starts from: the stored layouts that come near to a budget.
#ifndef CAPFIT_CORE_REFINE_LAYOUTS_STARTING_GRAPHS_H_
#define CAPFIT_CORE_REFINE_LAYOUTS_STARTING_GRAPHS_H_

#include <vector>

#include "core/body/body.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/layouts/layout.h"

namespace capfit::refine {

// At least one graph: the next layouts beyond the budget, where no more than `most_spared`
// primitives of them have to go, then those of the largest number of primitives that fits. Layouts
// with spheres for head, hands and feet where any of these parts is selected and present.
[[nodiscard]] std::vector<capsule::MirroredSet> StartingGraphs(FitKind kind, const body::Body& body,
                                                               const body::PartSelection& parts,
                                                               const capsule::Budget& budget,
                                                               int most_spared);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_LAYOUTS_STARTING_GRAPHS_H_
