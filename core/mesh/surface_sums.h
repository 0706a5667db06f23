// What sums over surfaces are made of: of a closed one, the area vectors add up to nothing and
// their z times the middles' z to the volume.
#ifndef CAPFIT_CORE_MESH_SURFACE_SUMS_H_
#define CAPFIT_CORE_MESH_SURFACE_SUMS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

#include "core/mesh/body_mesh.h"

namespace capfit::mesh {

// Along the normal of the triangle, as long as its area is large.
[[nodiscard]] inline Eigen::Vector3d AreaVector(std::span<const Eigen::Vector3d> points,
                                                const Triangle& t) {
  const Eigen::Vector3d& a = points[t[0]];
  return 0.5 * (points[t[1]] - a).cross(points[t[2]] - a);
}

[[nodiscard]] inline Eigen::Vector3d Middle(std::span<const Eigen::Vector3d> points,
                                            const Triangle& t) {
  return (points[t[0]] + points[t[1]] + points[t[2]]) / 3.0;
}

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_SURFACE_SUMS_H_
