// An order of vertices and triangles that the file has no say in.
#ifndef CAPFIT_CORE_MESH_CANONICAL_ORDER_H_
#define CAPFIT_CORE_MESH_CANONICAL_ORDER_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/mesh/body_mesh.h"

namespace capfit::mesh {

// Sorts vertices by y, then z, then x, and triangles by their corners, each beginning with its
// lowest; the surface and its orientation stay. So the same surface gives the same arrays, whatever
// the order in which a file lists it, and everything that is computed from them has the same bits
// (sums depend on their order, and choices among near equals on sums). Vertices in one place keep
// the order in which they came. Returns the new index of each vertex. O(n log n), O(n) for the
// usual coordinates.
[[nodiscard]] std::vector<std::uint32_t> PutInCanonicalOrder(std::vector<Eigen::Vector3d>& vertices,
                                                             std::vector<Triangle>& triangles);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_CANONICAL_ORDER_H_
