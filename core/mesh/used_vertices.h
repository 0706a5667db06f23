// The mended surface as a mesh of its own, and which of its vertices each of the caller's became.
#ifndef CAPFIT_CORE_MESH_USED_VERTICES_H_
#define CAPFIT_CORE_MESH_USED_VERTICES_H_

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/mesh/body_mesh.h"
#include "core/mesh/surface.h"

namespace capfit::mesh {

// What mending did to vertices. Copies have the indices behind the caller's.
struct VertexChanges {
  const std::vector<std::uint32_t>& stand_in;  // of each vertex after welding; empty: itself
  const std::vector<std::uint32_t>& copied;    // of which each copy is one
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& merged;  // gave way, to whom
};

// Vertices that no triangle uses are left out; the others keep their order. `surface` must be
// closed and oriented. O(vertices + triangles).
[[nodiscard]] BodyMesh MeshOfUsed(const std::vector<Eigen::Vector3d>& positions,
                                  const VertexChanges& changes, Surface surface,
                                  const ThreadPool& pool);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_USED_VERTICES_H_
