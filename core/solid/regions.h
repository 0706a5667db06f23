// Regions of a node set that hang together by the grid's edges.
#ifndef CAPFIT_CORE_SOLID_REGIONS_H_
#define CAPFIT_CORE_SOLID_REGIONS_H_

#include <cstddef>
#include <vector>

#include "core/solid/node_grid.h"

namespace capfit::solid {

// Adds every node that cannot be reached from the outermost nodes without passing `set`: whatever a
// closed surface encloses. Returns how many. O(columns + runs of nodes).
std::size_t FillCavities(const NodeGrid& grid, NodeSet& set);

// Leaves only the largest region. Returns the sizes of all regions, the largest first.
std::vector<std::size_t> KeepLargestRegion(const NodeGrid& grid, NodeSet& set);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_REGIONS_H_
