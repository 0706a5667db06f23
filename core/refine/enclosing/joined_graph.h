// A graph put together of others: each region of the body from the one that is best there.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_JOINED_GRAPH_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_JOINED_GRAPH_H_

#include <optional>
#include <span>
#include <vector>

#include "core/capsule/budget.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/enclosing/body_regions.h"

namespace capfit::refine {

// A graph that regions may be taken from.
struct Donor {
  const capsule::MirroredSet* graph = nullptr;
  std::vector<Region> regions;  // of each sphere; images alike. A capsule is in the later of two
  ByRegion<double> costs{};     // of the graph in each region, >= 0
};

// The regions' costs add up to the least that the budget allows. Where a capsule reaches into a
// region that is another donor's it ends in the most similar sphere there; the spheres are to be
// settled anew. Nothing where one donor alone is best, or none fits. Donors are all mirrored or
// none is.
[[nodiscard]] std::optional<capsule::MirroredSet> JoinedGraph(std::span<const Donor> donors,
                                                              const capsule::Budget& budget);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_JOINED_GRAPH_H_
