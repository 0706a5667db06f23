// Volume, centroid, area and extent of a surface.
#ifndef CAPFIT_CORE_MESH_SURFACE_MEASURES_H_
#define CAPFIT_CORE_MESH_SURFACE_MEASURES_H_

#include <Eigen/Core>
#include <span>

#include "core/base/thread_pool.h"
#include "core/geometry/similarity.h"
#include "core/mesh/edge_mates.h"

namespace capfit::mesh {

// Axis-parallel.
struct BoundingBox {
  Eigen::Vector3d low;
  Eigen::Vector3d high;

  BoundingBox& operator+=(const BoundingBox& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
    return *this;
  }
};

// Around points, of which there is one at least. O(n).
[[nodiscard]] BoundingBox BoundingBoxOf(std::span<const Eigen::Vector3d> points,
                                        const ThreadPool& pool);

// In the unit of the vertices, its square and its cube.
struct SurfaceMeasures {
  double volume = 0.0;                                 // below 0 where the triangles face inward
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // of the volume
  double area = 0.0;
  double least_triangle_area = 0.0;
  Eigen::Vector3d box_min = Eigen::Vector3d::Zero();  // of all vertices
  Eigen::Vector3d box_max = Eigen::Vector3d::Zero();

  [[nodiscard]] double diagonal() const { return (box_max - box_min).norm(); }
};

// Those of the same surface once it was moved, turned and scaled to `vertices`. O(vertices).
[[nodiscard]] SurfaceMeasures Moved(const SurfaceMeasures& measures,
                                    const geometry::Similarity& similarity,
                                    std::span<const Eigen::Vector3d> vertices,
                                    const ThreadPool& pool);

// Volume and centroid mean something where the triangles are closed. There is a vertex. O(n).
[[nodiscard]] SurfaceMeasures Measure(std::span<const Eigen::Vector3d> vertices,
                                      std::span<const Triangle> triangles, const ThreadPool& pool);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_SURFACE_MEASURES_H_
