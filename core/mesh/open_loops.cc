#include "core/mesh/open_loops.h"

#include <algorithm>
#include <cstddef>

#include "core/mesh/half_edge_mesh.h"

namespace capfit::mesh {

std::vector<OpenLoop> FindOpenLoops(const Surface& surface) {
  std::vector<OpenLoop> loops;
  if (std::find(surface.mate.begin(), surface.mate.end(), kNoMate) == surface.mate.end()) {
    return loops;
  }
  std::uint32_t highest = 0;
  for (const Triangle& t : surface.triangles) highest = std::max({highest, t[0], t[1], t[2]});
  HalfEdgeMesh mesh(std::size_t{highest} + 1, surface);
  for (const Rim& rim : mesh.FindRims()) {
    OpenLoop& loop = loops.emplace_back();
    const auto beside = mesh.face_handle(mesh.opposite_halfedge_handle(rim.front()));
    loop.triangle = static_cast<std::uint32_t>(beside.idx());
    for (const auto h : rim) {
      loop.vertices.push_back(static_cast<std::uint32_t>(mesh.from_vertex_handle(h).idx()));
    }
  }
  return loops;
}

}  // namespace capfit::mesh
