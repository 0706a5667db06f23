// The surface as the rest of this room works on it: no unit, no place, no axes of the caller's.
#ifndef CAPFIT_CORE_BODY_WORKING_COPY_H_
#define CAPFIT_CORE_BODY_WORKING_COPY_H_

#include <Eigen/Core>
#include <span>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/mesh/body_mesh.h"

namespace capfit::body {

// Copies of a mesh that were turned, moved or scaled get the same points bit by bit (see
// principal_frame.h), and so does all that is computed from them; the order in which a file lists
// vertices and triangles has no say in it.
struct WorkingCopy {
  mesh::BodyMesh mesh;  // in the order of a curve, in the caller's frame
  mesh::PrincipalFrame frame;
  std::span<const Eigen::Vector3d> points;  // the vertices in the frame, snapped: the mesh's own
};

// O(vertices + triangles). Not whole where the observer cancels.
[[nodiscard]] inline WorkingCopy MakeWorkingCopy(const mesh::BodyMesh& mesh, const ThreadPool& pool,
                                                 const FitObserver& observer) {
  WorkingCopy copy = {mesh.InCurveOrder(pool, observer), {}, {}};
  if (!copy.mesh.frame()) return copy;  // cancelled
  copy.frame = *copy.mesh.frame();
  copy.points = copy.mesh.snapped();
  return copy;
}

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_WORKING_COPY_H_
