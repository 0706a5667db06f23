// A closed chain of points in space filled with triangles, without new points.
#ifndef CAPFIT_CORE_MESH_TRIANGULATE_LOOP_H_
#define CAPFIT_CORE_MESH_TRIANGULATE_LOOP_H_

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/body_mesh.h"

namespace capfit::mesh {

// Whether points i and j of the loop, which are not neighbours on it, may be joined by an edge.
using MayJoin = std::function<bool(std::uint32_t i, std::uint32_t j)>;

// The triangles (indices into `loop`, running the loop's edges in its own direction) of least area,
// with a small price on long edges that decides between the many flat ones. From the last to the
// first triangle each has its first two sides on what is left of the loop, and its third cuts them
// off. Nothing where the allowed edges leave no way. O(n^3) time, O(n^2) memory.
//
// Barequet and Sharir, Filling gaps in the boundary of a polyhedron, 1995.
[[nodiscard]] std::optional<std::vector<Triangle>> FillBySmallestArea(
    std::span<const Eigen::Vector3d> loop, const MayJoin& may_join);

// The same by cutting off the sharpest corner again and again: O(n log n), for loops that are too
// long for the former. On winding loops triangles may cover each other. They come as they were cut
// off: here it is from the first to the last that each has two sides on what is left.
[[nodiscard]] std::optional<std::vector<Triangle>> FillByCuttingEars(
    std::span<const Eigen::Vector3d> loop, const MayJoin& may_join);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_TRIANGULATE_LOOP_H_
