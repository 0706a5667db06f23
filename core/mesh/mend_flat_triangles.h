// Triangles without area give way to ones that have some.
#ifndef CAPFIT_CORE_MESH_MEND_FLAT_TRIANGLES_H_
#define CAPFIT_CORE_MESH_MEND_FLAT_TRIANGLES_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/mesh/surface.h"

namespace capfit::mesh {

// Whether the triangle's least height is at most `tolerance`.
[[nodiscard]] bool IsFlat(std::span<const Eigen::Vector3d> positions, const Triangle& triangle,
                          double tolerance);

struct MendedTriangles {
  std::size_t flipped = 0;
  // Vertices that gave way to another (first to second) in the same place, in that order.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> merged;
};

// Makes flat triangles of a closed, oriented surface without touching vertices give way: where two
// corners lie in one place they are merged, and where a corner lies on the opposite edge that edge
// is turned to it. The surface stays where it is and stays closed; what would break that is left
// flat. O(n) for the usual few.
[[nodiscard]] MendedTriangles MendFlatTriangles(std::span<const Eigen::Vector3d> positions,
                                                double tolerance, Surface& surface);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_MEND_FLAT_TRIANGLES_H_
