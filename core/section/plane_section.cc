#include "core/section/plane_section.h"

#include "core/mesh/plane_cut.h"

namespace capfit::section {

std::vector<SectionLoop> CutMesh(const mesh::BodyMesh& mesh, const geometry::PlaneFrame& plane) {
  const Eigen::Vector3d normal = plane.Normal();
  std::vector<double> heights;
  heights.reserve(mesh.vertices().size());
  for (const Eigen::Vector3d& v : mesh.vertices()) {
    heights.push_back((v - plane.origin_m).dot(normal));
  }
  std::vector<mesh::CutPiece> pieces;
  for (const mesh::Triangle& t : mesh.triangles()) {
    mesh::CutTriangle(mesh.vertices(), t, {heights[t[0]], heights[t[1]], heights[t[2]]}, pieces);
  }
  std::vector<SectionLoop> loops;
  for (const mesh::CutLoop& linked : mesh::LinkPieces(pieces)) {
    SectionLoop& loop = loops.emplace_back();
    for (const std::uint32_t piece : linked.pieces) {
      loop.push_back({plane.ToPlane(pieces[piece].start), pieces[piece].nearest_vertex});
    }
  }
  return loops;
}

}  // namespace capfit::section
