// Quads that share vertices: the cage of the mannequin and what grows from it.
#ifndef CAPFIT_CORE_MANNEQUIN_QUAD_MESH_H_
#define CAPFIT_CORE_MANNEQUIN_QUAD_MESH_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace capfit::mannequin {

using Quad = std::array<std::uint32_t, 4>;  // counter-clockwise seen from outside
using Edge = std::array<std::uint32_t, 2>;

// Any unit. Manifold, with or without boundary.
struct QuadMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Quad> quads;
  std::vector<Edge> creases;  // edges that stay sharp
};

// The left half (x >= 0) of a mirror-symmetric closed mesh. Its boundary runs in the plane x = 0,
// and exactly the vertices with x == 0 lie there.
//
// Returns both halves in one: first the vertices and quads of `half`, then the mirror images of the
// quads in the same order and of the vertices off the plane.
[[nodiscard]] QuadMesh WithMirrorImage(const QuadMesh& half);

}  // namespace capfit::mannequin

#endif  // CAPFIT_CORE_MANNEQUIN_QUAD_MESH_H_
