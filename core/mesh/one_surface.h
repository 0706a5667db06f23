// Whether a surface without open edges is a single one as it came.
#ifndef CAPFIT_CORE_MESH_ONE_SURFACE_H_
#define CAPFIT_CORE_MESH_ONE_SURFACE_H_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/mesh/edge_mates.h"

namespace capfit::mesh {

// True where the triangles hang together by their edges, use all of the vertices and meet at each
// vertex in a single ring. `mates` are those of closed, oriented triangles. Close to O(n). It is
// the two steps that follow.
[[nodiscard]] bool IsOneSurface(std::span<const Triangle> triangles,
                                std::span<const HalfEdge> mates, std::size_t vertex_count,
                                const ThreadPool& pool);

// For each vertex the lowest vertex of the triangles around it, itself included. Nothing where the
// triangles at some vertex are more than one ring. In parallel.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> LowestInRings(
    std::span<const Triangle> triangles, std::span<const HalfEdge> mates, std::size_t vertex_count,
    const ThreadPool& pool);
// Whether edges lead from each vertex to every other; `lowest` as LowestInRings gives it. On the
// caller's thread alone.
[[nodiscard]] bool HangsTogether(std::span<const Triangle> triangles,
                                 std::vector<std::uint32_t> lowest);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_ONE_SURFACE_H_
