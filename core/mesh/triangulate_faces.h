// Polygons become triangles.
#ifndef CAPFIT_CORE_MESH_TRIANGULATE_FACES_H_
#define CAPFIT_CORE_MESH_TRIANGULATE_FACES_H_

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "core/mesh/body_mesh.h"
#include "core/mesh/polygon_soup.h"

namespace capfit::mesh {

struct TriangulatedFaces {
  std::vector<Triangle> triangles;  // in the order of the faces, each with three different corners
  std::size_t degenerate = 0;       // triangles without three different corners, left out
};

// Triangles as they are, quads by the diagonal from their first corner, as other programs do (so a
// mesh of quads gives the same surface as its triangulated copy). Where that would fold over more
// than one face in a hundred, as in quads that were joined from triangles and have inward corners,
// the folded ones are cut by the other diagonal. Larger faces often have inward corners: they get
// the triangulation of least area. `soup` is checked; `positions` stand for its own. O(corners) for
// the usual sizes of faces.
[[nodiscard]] TriangulatedFaces TriangulateFaces(const PolygonSoup& soup,
                                                 std::span<const Eigen::Vector3d> positions);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_TRIANGULATE_FACES_H_
