// A surface while it is edited: OpenMesh's half-edges. Only .cc files of this room include it.
#ifndef CAPFIT_CORE_MESH_HALF_EDGE_MESH_H_
#define CAPFIT_CORE_MESH_HALF_EDGE_MESH_H_

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <cstddef>
#include <span>
#include <vector>

#include "core/mesh/surface.h"

namespace capfit::mesh {

// Half-edges outside of the surface, along a hole: each begins where the one before ends, the last
// ends where the first begins, and no vertex comes twice. A filling runs them the same way.
using Rim = std::vector<OpenMesh::HalfedgeHandle>;

// The triangles of a Surface with OpenMesh's walks and collapses: face t is triangle t, and
// vertex v is vertex v. Connectivity only: the coordinates stay where they are, in doubles.
//
// Making one and taking the surface back costs about 30 ns and 70 bytes for each triangle: a
// surface with nothing to mend does without. Edges are what the surface's mates say, not what
// add_face finds: that takes 14 times as long on a body, 10 s for 32,000 triangles round one vertex
// in any order (it looks through all edges there), and refuses edges of more than two triangles.
class HalfEdgeMesh : public OpenMesh::TriConnectivity {
 public:
  // `surface` is consistently oriented, its corners are below `vertex_count`. Where fans of
  // triangles share a vertex, walks round it see one of them: SplitVertices first. O(n).
  HalfEdgeMesh(std::size_t vertex_count, const Surface& surface);

  // The rims of all holes, in the order of their vertices. Where the surface touches itself in a
  // vertex of a hole, what lies on either side is a rim by itself. From then on
  // next_halfedge_handle follows them. O(n log n).
  [[nodiscard]] std::vector<Rim> FindRims();

  // Closes a rim of three or more with the triangles of `filling`, whose corners are places on the
  // rim, as FillBySmallestArea gives them: from the last to the first each has its first two sides
  // on what is left of the rim. They come behind the others, in the order of `filling`.
  void FillRim(const Rim& rim, std::span<const Triangle> filling);

  // Makes one edge of the two of a rim: a slit between two vertices.
  void ZipRim(const Rim& rim);

  // Turns the half-edge's edge to the two other corners of its triangles, which no edge joins yet:
  // `h` ends at what was the corner across from it. In place of OpenMesh's flip, which looks for
  // the new edge round one corner or the other (Debian's library has its assertions on): where that
  // is the hub of 20,000 flat triangles, mending them takes 2 s instead of 0.02.
  void TurnEdge(OpenMesh::HalfedgeHandle h);

  // The triangles that are left, in their order.
  [[nodiscard]] Surface ToSurface() const;

 private:
  void LinkTriangles(const Surface& surface, std::span<const OpenMesh::HalfedgeHandle> handles);
  void LinkRims(const Surface& surface, std::span<const OpenMesh::HalfedgeHandle> handles);
  OpenMesh::HalfedgeHandle CutOffCorner(OpenMesh::HalfedgeHandle to_corner,
                                        OpenMesh::FaceHandle face);
};

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_HALF_EDGE_MESH_H_
