// Areas and volumes of triangles, for sums over surfaces.
#ifndef CAPFIT_CORE_MESH_SURFACE_SUMS_H_
#define CAPFIT_CORE_MESH_SURFACE_SUMS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

#include "core/mesh/body_mesh.h"

namespace capfit::mesh {

// Along the normal of the triangle, as long as its area.
[[nodiscard]] inline Eigen::Vector3d AreaVector(std::span<const Eigen::Vector3d> points,
                                                const Triangle& t) {
  const Eigen::Vector3d& a = points[t[0]];
  return 0.5 * (points[t[1]] - a).cross(points[t[2]] - a);
}

[[nodiscard]] inline double Area(std::span<const Eigen::Vector3d> points, const Triangle& t) {
  return AreaVector(points, t).norm();
}

[[nodiscard]] inline Eigen::Vector3d Middle(std::span<const Eigen::Vector3d> points,
                                            const Triangle& t) {
  return (points[t[0]] + points[t[1]] + points[t[2]]) / 3.0;
}

// Between the triangle and the plane z = 0, negative for a triangle that faces down. Over a closed
// surface the sum is the volume.
[[nodiscard]] inline double VolumeBelow(std::span<const Eigen::Vector3d> points,
                                        const Triangle& t) {
  return AreaVector(points, t).z() * Middle(points, t).z();
}

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_SURFACE_SUMS_H_
