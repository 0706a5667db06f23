// The surface as the rest of this room works on it: no unit, no place, no axes of the caller's.
#ifndef CAPFIT_CORE_BODY_WORKING_COPY_H_
#define CAPFIT_CORE_BODY_WORKING_COPY_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/mesh/body_mesh.h"

namespace capfit::body {

// Area 1, centroid of the volume at the origin, along the surface's principal axes (turned by its
// third moments where an axis may point either way), coordinates on a grid (see snap.h): copies of
// a mesh that were turned, moved or scaled get the same working copy bit by bit, and so does all
// that is computed from it. (But for a bit in a thousand bodies; and noise far above rounding's, as
// in files of few digits, stays.)
//
// Vertices and triangles are sorted along a space-filling curve, which makes everything that
// follows several times as fast; the order in which a file lists them has no say in it.
struct WorkingCopy {
  std::vector<Eigen::Vector3d> points;
  std::vector<mesh::Triangle> triangles;      // of the working vertices, lowest corners first
  std::vector<mesh::HalfEdge> mates;          // of the triangles' half-edges
  std::vector<std::uint32_t> first_triangle;  // of those that begin at each vertex; the last: end
  std::vector<std::uint32_t> mesh_vertex;     // the mesh's vertex for each of these
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // in the mesh's frame
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // rows: the copy's axes in the mesh's frame
  double unit = 1.0;                                   // length of 1, in the mesh's unit

  // A point of the mesh's frame, not snapped.
  [[nodiscard]] Eigen::Vector3d FromMesh(const Eigen::Vector3d& p) const {
    return axes * (p - centroid) / unit;
  }
};

// O(vertices + triangles). Not whole where the observer cancels.
[[nodiscard]] WorkingCopy MakeWorkingCopy(const mesh::BodyMesh& mesh, const ThreadPool& pool,
                                          const FitObserver& observer);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_WORKING_COPY_H_
