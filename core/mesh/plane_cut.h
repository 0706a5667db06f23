// The cut of a plane through triangles: pieces, one in each, linked to loops.
#ifndef CAPFIT_CORE_MESH_PLANE_CUT_H_
#define CAPFIT_CORE_MESH_PLANE_CUT_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/edge_mates.h"

namespace capfit::mesh {

// An edge that the plane passes, by its two vertices.
using EdgeKey = std::uint64_t;

// The piece of the cut inside one triangle, from one of its edges to another. Both triangles at an
// edge get the same point there, bit for bit.
struct CutPiece {
  EdgeKey from = 0;
  EdgeKey to = 0;
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  // on the edge `from`
  std::uint32_t nearest_vertex = 0;                 // the nearer end of it
};

// Adds the triangle's piece, if there is one. `heights`: of its corners over the plane; 0 counts as
// above, so that every loop of a closed surface closes, whatever the plane touches. The surface's
// inside lies to the left of a piece where the plane's normal points to the viewer.
inline void CutTriangle(std::span<const Eigen::Vector3d> points, const Triangle& triangle,
                        const std::array<double, 3>& heights, std::vector<CutPiece>& pieces);

// Bit k tells whether corner k is above; 0 or 7: the plane misses the triangle.
[[nodiscard]] inline std::size_t CornersAbove(const std::array<double, 3>& heights) {
  return (heights[0] >= 0.0 ? 1U : 0U) + (heights[1] >= 0.0 ? 2U : 0U) +
         (heights[2] >= 0.0 ? 4U : 0U);
}

// The same for a triangle that the plane passes, with its corners above.
void CutPassedTriangle(std::span<const Eigen::Vector3d> points, const Triangle& triangle,
                       const std::array<double, 3>& heights, std::size_t above,
                       std::vector<CutPiece>& pieces);

struct CutLoop {
  std::vector<std::uint32_t> pieces;  // by index, in order
  bool is_closed = false;             // open where triangles end
};

// All loops, in the order of their first piece; where an edge has more than two triangles, one of
// the ways on. O(pieces).
[[nodiscard]] std::vector<CutLoop> LinkPieces(const std::vector<CutPiece>& pieces);

// Here, because most triangles end with the first question.
inline void CutTriangle(std::span<const Eigen::Vector3d> points, const Triangle& triangle,
                        const std::array<double, 3>& heights, std::vector<CutPiece>& pieces) {
  const std::size_t above = CornersAbove(heights);
  if (above == 0 || above == 7) return;
  CutPassedTriangle(points, triangle, heights, above, pieces);
}

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_PLANE_CUT_H_
