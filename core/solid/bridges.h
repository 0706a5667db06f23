// Pieces that nearly touch become one.
#ifndef CAPFIT_CORE_SOLID_BRIDGES_H_
#define CAPFIT_CORE_SOLID_BRIDGES_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "core/base/thread_pool.h"
#include "core/solid/grid_lines.h"
#include "core/solid/node_grid.h"

namespace capfit::solid {

// Fills the gap between two regions of `set` that do not hang together, where their surfaces face
// each other across less than `reach` (in the grid's unit): a hand that ends short of its sleeve, a
// head above its collar, the pieces of a jointed doll. The narrowest gaps come first, and what is
// joined already is not joined again: a hand beside a thigh stays free. Returns how many nodes were
// added. O(columns + runs) where there is nothing to join.
std::size_t BridgeRegions(const NodeGrid& grid, const std::array<GridLines, 3>& lines,
                          std::span<const Eigen::Vector3f> normals, double reach,
                          const ThreadPool& pool, NodeSet& set);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_BRIDGES_H_
