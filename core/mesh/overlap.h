// How much of a surface's inside it encloses more than once.
#ifndef CAPFIT_CORE_MESH_OVERLAP_H_
#define CAPFIT_CORE_MESH_OVERLAP_H_

#include <Eigen/Core>
#include <span>

#include "core/mesh/body_mesh.h"

namespace capfit::mesh {

struct Overlap {
  double volume = 0.0;  // enclosed twice or more, counted once
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
};

// Of a closed surface with outward faces, such as a body whose arms sink into its hips. Measured
// along columns parallel to the longest side of the box, 128 to that side's length: what is thinner
// than a column is missed or not by chance. Nothing (volume 0) where so many large triangles lie
// over each other that it would take long. O(triangles) for the usual sizes.
[[nodiscard]] Overlap MeasureOverlap(const BodyMesh& mesh);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_OVERLAP_H_
