#include "core/section/plane_section.h"

#include "core/mesh/plane_cut.h"

namespace capfit::section {

std::vector<SectionLoop> CutMesh(const mesh::PlaneCutter& mesh, const geometry::PlaneFrame& plane) {
  const std::vector<mesh::CutPiece> pieces = mesh.Cut(plane.origin_m, plane.Normal());
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
