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

// Between the triangle and the plane z = 0, negative for a triangle that faces down. Over a closed
// surface the sum is the volume.
[[nodiscard]] inline double VolumeBelow(std::span<const Eigen::Vector3d> points,
                                        const Triangle& t) {
  const Eigen::Vector3d& a = points[t[0]];
  const Eigen::Vector3d& b = points[t[1]];
  const Eigen::Vector3d& c = points[t[2]];
  return ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x())) *
         (a.z() + b.z() + c.z()) / 6.0;
}

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_SURFACE_SUMS_H_
