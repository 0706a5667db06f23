// Triangles with their neighbours, while the mesh room mends them.
#ifndef CAPFIT_CORE_MESH_SURFACE_H_
#define CAPFIT_CORE_MESH_SURFACE_H_

#include <vector>

#include "core/base/raw_vector.h"
#include "core/mesh/body_mesh.h"
#include "core/mesh/edge_mates.h"

namespace capfit::mesh {

// `mate` is what counts: where more than two triangles share the two vertices of an edge it says
// who is joined to whom, and corners decide nothing. Size: 3 * triangles.
struct Surface {
  std::vector<Triangle> triangles;
  RawVector<HalfEdge> mate;
};

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_SURFACE_H_
