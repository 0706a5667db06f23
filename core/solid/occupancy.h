// Which nodes of the grid are inside the union of shells.
#ifndef CAPFIT_CORE_SOLID_OCCUPANCY_H_
#define CAPFIT_CORE_SOLID_OCCUPANCY_H_

#include <Eigen/Core>
#include <array>
#include <span>

#include "core/base/thread_pool.h"
#include "core/solid/grid_lines.h"
#include "core/solid/node_grid.h"
#include "core/solid/shells.h"

namespace capfit::solid {

// The nodes inside; besides, what falls between the nodes: a sheet thinner than a step gets the
// nodes nearest to it, a crack narrower than most of a step is filled, and so is the space of up to
// some steps under a shell that is a plate or a cloth of its own (armour, a coat with a lining).
// `lines` are those along u, v and w, `normals` the triangles' unit normals as u, v, w.
[[nodiscard]] NodeSet FindOccupied(const NodeGrid& grid, const Shells& shells,
                                   const std::array<GridLines, 3>& lines,
                                   std::span<const Eigen::Vector3f> normals,
                                   const ThreadPool& pool);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_OCCUPANCY_H_
