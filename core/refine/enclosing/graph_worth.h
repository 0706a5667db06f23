// What each capsule and sphere of an enclosing set does: which is least missed, which is loose.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_GRAPH_WORTH_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_GRAPH_WORTH_H_

#include <vector>

#include "core/capsule/mirrored_set.h"
#include "core/tighten/point_grid.h"

namespace capfit::refine {

// What the parts of a graph do, in cubic metres; of a mirrored pair both together.
struct GraphWorth {
  std::vector<double> edge_gap;   // between each capsule and the surface that it covers
  std::vector<double> edge_loss;  // about what has to grow elsewhere when the capsule goes
  // The same for each sphere with its capsules, its two neighbours tied instead where it has two.
  std::vector<double> node_loss;
};

// By the points of the surface, each with the area that it stands for (`areas_m2`, by the caller's
// index). No solid grows further than `furthest_m` to make up for what goes. O(points * (solids
// near each)).
[[nodiscard]] GraphWorth WorthOf(const capsule::MirroredSet& graph, const tighten::PointGrid& grid,
                                 const std::vector<double>& areas_m2, double furthest_m);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_GRAPH_WORTH_H_
