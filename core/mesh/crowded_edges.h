// Edges with three or more triangles: which triangles are too many, and who belongs to whom.
#ifndef CAPFIT_CORE_MESH_CROWDED_EDGES_H_
#define CAPFIT_CORE_MESH_CROWDED_EDGES_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/body_mesh.h"
#include "core/mesh/edge_mates.h"

namespace capfit::mesh {

// Triangles at crowded edges that have the same three corners as an earlier one, whichever way
// round; ascending. (A copy always makes its edges crowded, unless the two are a part of their
// own.)
[[nodiscard]] std::vector<std::uint32_t> FindDuplicates(std::span<const Triangle> triangles,
                                                        const EdgeMates& mates);

// Triangles with an open edge that hang on a crowded edge which has two triangles without open
// edges: what sticks out of a surface that is whole without it. Ascending.
[[nodiscard]] std::vector<std::uint32_t> FindFins(const EdgeMates& mates);

// Pairs the triangles at each crowded edge two by two in `mates.mate`: those that run the edge in
// opposite directions first, the flattest pair first. What is left over stays without a mate.
void MatchCrowdedEdges(std::span<const Eigen::Vector3d> positions,
                       std::span<const Triangle> triangles, EdgeMates& mates);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_CROWDED_EDGES_H_
