// The surface as the rest of this room works on it: no unit, no place, neighbours near in memory.
#ifndef CAPFIT_CORE_BODY_WORKING_COPY_H_
#define CAPFIT_CORE_BODY_WORKING_COPY_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/mesh/body_mesh.h"

namespace capfit::body {

// Vertices and triangles are sorted along a space-filling curve, which makes everything that
// follows several times as fast; nothing that is computed depends on the order.
struct WorkingCopy {
  std::vector<Eigen::Vector3d> points;     // surface area 1, centroid of the volume at the origin
  std::vector<double> vertex_areas;        // a third of the triangles around; they sum to 1
  std::vector<mesh::Triangle> triangles;   // of the working vertices
  std::vector<std::uint32_t> mesh_vertex;  // the mesh's vertex for each of these
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // in the mesh's frame
  double unit = 1.0;                                   // length of 1, in the mesh's unit
};

// O(vertices + triangles).
[[nodiscard]] WorkingCopy MakeWorkingCopy(const mesh::BodyMesh& mesh);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_WORKING_COPY_H_
