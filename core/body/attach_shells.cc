#include "core/body/attach_shells.h"

#include <cstddef>
#include <cstdint>

#include "core/base/chunk_sums.h"
#include "core/mesh/nearest_vertex.h"

namespace capfit::body {

void AttachShells(std::span<const Eigen::Vector3d> positions,
                  std::span<const mesh::Triangle> triangles, const ThreadPool& pool, Body& body) {
  ShellSurface shells;
  shells.vertex_of_source.assign(positions.size(), -1);
  shells.triangles.assign(triangles.begin(), triangles.end());
  for (mesh::Triangle& t : shells.triangles) {
    for (std::uint32_t& v : t) {
      std::int32_t& place = shells.vertex_of_source[v];
      if (place < 0) {
        place = static_cast<std::int32_t>(shells.vertices_m.size());
        shells.vertices_m.push_back(body.body_from_caller.Apply(positions[v]));
      }
      v = static_cast<std::uint32_t>(place);
    }
  }
  const mesh::NearestVertex of_mesh(body.mesh.vertices());
  shells.vertex_segments.resize(shells.vertices_m.size());
  pool.ForChunks(shells.vertices_m.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      shells.vertex_segments[v] = body.vertex_segments[of_mesh.At(shells.vertices_m[v])];
    }
  });
  const mesh::NearestVertex of_shells(shells.vertices_m);
  shells.nearest_of_mesh.resize(body.mesh.vertices().size());
  pool.ForChunks(shells.nearest_of_mesh.size(), kMeshChunk,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t v = begin; v < end; ++v) {
                     shells.nearest_of_mesh[v] = of_shells.At(body.mesh.vertices()[v]);
                   }
                 });
  body.shells = std::move(shells);
}

}  // namespace capfit::body
