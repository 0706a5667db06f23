// Which nodes of the grid are inside the union of shells.
#ifndef CAPFIT_CORE_SOLID_OCCUPANCY_H_
#define CAPFIT_CORE_SOLID_OCCUPANCY_H_

#include <Eigen/Core>
#include <array>
#include <span>

#include "core/base/thread_pool.h"
#include "core/solid/grid_lines.h"
#include "core/solid/node_grid.h"

namespace capfit::solid {

// The nodes inside; besides, what falls between the nodes: a sheet thinner than a step gets the
// nodes nearest to it, and a crack narrower than most of a step is filled. `lines` are those along
// u, v and w, `normals` the triangles' unit normals as u, v, w.
[[nodiscard]] NodeSet FindOccupied(const NodeGrid& grid, const std::array<GridLines, 3>& lines,
                                   std::span<const Eigen::Vector3f> normals,
                                   const ThreadPool& pool);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_OCCUPANCY_H_
