// The frame that a surface has by itself.
#ifndef CAPFIT_CORE_MESH_PRINCIPAL_FRAME_H_
#define CAPFIT_CORE_MESH_PRINCIPAL_FRAME_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/mesh/surface_measures.h"

namespace capfit::mesh {

// Area 1, centroid of the volume at the origin, along the vertices' principal axes (turned by their
// third moments where an axis may point either way).
struct PrincipalFrame {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // in the mesh's frame
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // rows, in the mesh's frame; right-handed
  double unit = 1.0;                                   // length of 1 here, in the mesh's unit

  // A point of the mesh's frame, not snapped.
  [[nodiscard]] Eigen::Vector3d FromMesh(const Eigen::Vector3d& p) const {
    return axes * ((p - centroid) / unit);
  }
};

// `measures` are those of the surface with these vertices; its volume is above 0. O(n).
[[nodiscard]] PrincipalFrame FindPrincipalFrame(std::span<const Eigen::Vector3d> vertices,
                                                const SurfaceMeasures& measures,
                                                const ThreadPool& pool);

// The vertices in that frame, on a grid (see snap.h): copies of a mesh that were turned, moved or
// scaled get the same points bit by bit, and so does all that is computed from them. (But for a bit
// in a thousand bodies; and noise far above rounding's, as in files of few digits, stays.) O(n).
[[nodiscard]] std::vector<Eigen::Vector3d> SnappedPoints(std::span<const Eigen::Vector3d> vertices,
                                                         const PrincipalFrame& frame,
                                                         const ThreadPool& pool);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_PRINCIPAL_FRAME_H_
