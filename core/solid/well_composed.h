// Node sets whose boundary is a manifold.
#ifndef CAPFIT_CORE_SOLID_WELL_COMPOSED_H_
#define CAPFIT_CORE_SOLID_WELL_COMPOSED_H_

#include <cstddef>

#include "core/base/thread_pool.h"
#include "core/solid/node_grid.h"

namespace capfit::solid {

// Adds nodes until no two nodes of the set, and no two of the rest, touch only across the diagonal
// of a square or a cube of the grid: then each cell of eight nodes holds at most one sheet of the
// boundary. Returns how many were added, about one in a thousand of the boundary's. A few passes of
// O(words).
//
// Latecki, Eckhardt and Rosenfeld, Well-composed sets, 1995.
std::size_t MakeWellComposed(const NodeGrid& grid, const ThreadPool& pool, NodeSet& set);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_WELL_COMPOSED_H_
