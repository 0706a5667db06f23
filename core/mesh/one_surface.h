// Whether a surface without open edges is a single one as it came.
#ifndef CAPFIT_CORE_MESH_ONE_SURFACE_H_
#define CAPFIT_CORE_MESH_ONE_SURFACE_H_

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/thread_pool.h"
#include "core/mesh/edge_mates.h"

namespace capfit::mesh {

// True where the triangles hang together by their edges, use all of the vertices and meet at each
// vertex in a single ring. `mates` are those of closed, oriented triangles. Close to O(n).
[[nodiscard]] bool IsOneSurface(std::span<const Triangle> triangles,
                                std::span<const HalfEdge> mates, std::size_t vertex_count,
                                const ThreadPool& pool);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_ONE_SURFACE_H_
