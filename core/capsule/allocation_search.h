// The least waste among all allocations near a given one: dynamic programming along the chains.
#ifndef CAPFIT_CORE_CAPSULE_ALLOCATION_SEARCH_H_
#define CAPFIT_CORE_CAPSULE_ALLOCATION_SEARCH_H_

#include <optional>
#include <vector>

#include "core/capsule/allocation.h"

namespace capfit::capsule {

// One polygon's choices: counts from `lowest` on, with the waste of each.
struct CountChoices {
  int lowest = 1;
  std::vector<double> waste;
};

// Polygons in order along a chain. `copies` is 2 where a mirrored chain takes the same counts and
// costs the same again; the waste is that of all copies.
struct ChainChoices {
  std::vector<CountChoices> polygons;
  int copies = 1;
};

// Counts by chain and polygon that fit the budget with least waste, those that leave at most
// `slack` of max_primitives unused first (where only max_primitives is limited), then those that
// leave least. Nothing where no choice fits, and where the budget is so large in two dimensions
// that the tables would be slow. Exact; a few milliseconds at most.
[[nodiscard]] std::optional<std::vector<std::vector<int>>> SearchAllocation(
    const std::vector<ChainChoices>& chains, const Budget& budget, int slack);

}  // namespace capfit::capsule

#endif  // CAPFIT_CORE_CAPSULE_ALLOCATION_SEARCH_H_
