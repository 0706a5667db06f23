#include "core/mesh/split_vertices.h"

namespace capfit::mesh {

std::vector<std::uint32_t> SplitVertices(std::size_t vertex_count, Surface& surface) {
  std::vector<std::uint32_t> copied;
  std::vector<bool> corner_seen(surface.mate.size(), false);
  std::vector<bool> vertex_seen(vertex_count, false);
  for (HalfEdge first = 0; first < surface.mate.size(); ++first) {
    if (corner_seen[first]) continue;
    const std::uint32_t vertex = StartOf(surface.triangles, first);
    std::uint32_t name = vertex;
    if (vertex_seen[vertex]) {
      name = static_cast<std::uint32_t>(vertex_count + copied.size());
      copied.push_back(vertex);
    }
    vertex_seen[vertex] = true;
    // Round the fan: the half-edges that start at the vertex.
    HalfEdge h = first;
    do {
      corner_seen[h] = true;
      surface.triangles[h / 3][h % 3] = name;
      h = surface.mate[PreviousInTriangle(h)];
    } while (h != first);
  }
  return copied;
}

}  // namespace capfit::mesh
