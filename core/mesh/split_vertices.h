// Vertices in which a surface touches itself become several.
#ifndef CAPFIT_CORE_MESH_SPLIT_VERTICES_H_
#define CAPFIT_CORE_MESH_SPLIT_VERTICES_H_

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/mesh/surface.h"

namespace capfit::mesh {

// Gives each fan of triangles round a vertex of a closed, consistently oriented `surface` a vertex
// of its own: the fan with the lowest triangle keeps it, the others get new ones from
// `vertex_count` on. Returns which vertex each new one copies. O(n).
[[nodiscard]] std::vector<std::uint32_t> SplitVertices(std::size_t vertex_count, Surface& surface);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_SPLIT_VERTICES_H_
