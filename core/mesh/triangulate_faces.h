// Polygons become triangles.
#ifndef CAPFIT_CORE_MESH_TRIANGULATE_FACES_H_
#define CAPFIT_CORE_MESH_TRIANGULATE_FACES_H_

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "core/formats/polygon_soup.h"
#include "core/mesh/body_mesh.h"

namespace capfit::mesh {

struct TriangulatedFaces {
  std::vector<Triangle> triangles;  // in the order of the faces, each with three different corners
  std::size_t degenerate = 0;       // triangles without three different corners, left out
};

// The faces of a checked soup whose faces have three corners each, as they are: the soup's own
// array. Some may be degenerate.
[[nodiscard]] std::span<const Triangle> FacesAsTriangles(const formats::PolygonSoup& soup);

// Triangles as they are, quads by the diagonal from their first corner, as other programs do (so a
// mesh of quads gives the same surface as its triangulated copy, to the bit). Where that would fold
// over more than one face in a hundred, the quads were joined from triangles: then the folded ones
// are cut by the other diagonal.
//
// Why a share of the file and not each face by itself: a quad alone does not tell. Modelled quads
// have an inward corner too, at ears, lips and toes, about one in a thousand, and their
// triangulated copies are folded there; a rule for single faces (by convexity, or the shorter or
// flatter diagonal) would give the two another surface. Joining uneven triangles without looking,
// on the other hand, makes an inward corner in one quad of six or so, for two triangles join to a
// convex quad only where both ends of their edge are narrow enough. One in a hundred lies well
// between: any share from 1/500 to 1/50 decides the same for every file at hand. (Even triangles
// join to convex quads, and what is below the share does as little harm as in a modelled mesh.)
//
// Larger faces often have inward corners: they get the triangulation of least area
// (beyond some millions of corners or some hundreds in one face, one by cutting ears). `soup` is
// checked; `positions` stand for its own. O(corners) for the usual sizes of faces.
[[nodiscard]] TriangulatedFaces TriangulateFaces(const formats::PolygonSoup& soup,
                                                 std::span<const Eigen::Vector3d> positions);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_TRIANGULATE_FACES_H_
