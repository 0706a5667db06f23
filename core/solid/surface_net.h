// The boundary of a node set as a surface.
#ifndef CAPFIT_CORE_SOLID_SURFACE_NET_H_
#define CAPFIT_CORE_SOLID_SURFACE_NET_H_

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/mesh/edge_mates.h"
#include "core/solid/grid_lines.h"
#include "core/solid/node_grid.h"

namespace capfit::solid {

struct NetSurface {
  std::vector<Eigen::Vector3d> vertices;  // in the caller's frame
  std::vector<mesh::Triangle> triangles;  // outward
  RawVector<mesh::HalfEdge> mates;        // of the half-edges; empty: not closed after all
  std::vector<std::uint32_t> cells;       // of each vertex
};

// One vertex in each cell of eight nodes that the boundary of `set` (well-composed) passes, near
// all planes in which the shells' triangles cross the cell's edges; two triangles for each edge
// between a node inside and one outside. Closed and consistently oriented, one sheet in each cell.
// Then cells are taken together by eights where the surface is flat, so that the number of
// triangles falls to a third or so and hands, faces and hems keep theirs. O(words + cells).
//
// Gibson, Constrained elastic surface nets, 1998; Ju et al., Dual contouring of Hermite data, 2002.
[[nodiscard]] NetSurface ExtractSurface(const NodeGrid& grid, const NodeSet& set,
                                        const std::array<GridLines, 3>& lines,
                                        std::span<const Eigen::Vector3f> normals,
                                        const ThreadPool& pool);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_SURFACE_NET_H_
