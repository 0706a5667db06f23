// What sums over surfaces are made of: of a closed one, the area vectors add up to nothing and
// their z times the middles' z to the volume.
#ifndef CAPFIT_CORE_MESH_SURFACE_SUMS_H_
#define CAPFIT_CORE_MESH_SURFACE_SUMS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/edge_mates.h"

namespace capfit::mesh {

// Along the normal of the triangle, as long as its area is large.
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

// Of the tetrahedron between the origin and the triangle, > 0 where its normal points away. Over a
// closed surface these add up to its volume; a nearby origin keeps their digits.
[[nodiscard]] inline double SignedVolume(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                         const Eigen::Vector3d& c) {
  return a.dot(b.cross(c)) / 6.0;
}

[[nodiscard]] inline double AreaOf(std::span<const Eigen::Vector3d> points,
                                   std::span<const Triangle> triangles) {
  double area = 0.0;
  for (const Triangle& t : triangles) area += Area(points, t);
  return area;
}

// Adds a third of each triangle's area to each of its corners' entries; returns the whole area.
inline double AddVertexAreas(std::span<const Eigen::Vector3d> points,
                             std::span<const Triangle> triangles, std::vector<double>& areas) {
  double sum = 0.0;
  for (const Triangle& t : triangles) {
    const double area = Area(points, t);
    for (const std::uint32_t corner : t) areas[corner] += area / 3.0;
    sum += area;
  }
  return sum;
}

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_SURFACE_SUMS_H_
