// Where the surface runs out into tips: the merge tree of a distance field.
#ifndef CAPFIT_CORE_BODY_BRANCHES_H_
#define CAPFIT_CORE_BODY_BRANCHES_H_

#include <cstdint>
#include <span>
#include <vector>

#include "core/body/surface_graph.h"

namespace capfit::body {

// A local maximum of the field with what lies above the level at which it stops being a piece of
// its own. Distances are those of the field.
struct Branch {
  std::uint32_t tip = 0;
  double tip_distance = 0.0;
  double saddle_distance = 0.0;  // level of the junction; 0 for the highest of all
  int parent = -1;               // the branch with the farther tip that it joins there; -1: none

  [[nodiscard]] double Persistence() const { return tip_distance - saddle_distance; }
};

// Branches that stand out by at least `min_persistence`, the farthest tip first. O(n log n).
[[nodiscard]] std::vector<Branch> FindBranches(const SurfaceGraph& graph,
                                               std::span<const double> distance,
                                               double min_persistence,
                                               const ThreadPool& pool = ThreadPool(1));

// Level at which the branches `a` and `b` join, directly or through others.
[[nodiscard]] double JunctionLevel(std::span<const Branch> branches, int a, int b);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_BRANCHES_H_
