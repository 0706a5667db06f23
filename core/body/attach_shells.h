// A body whose mesh was made around many shells gets the shells themselves.
#ifndef CAPFIT_CORE_BODY_ATTACH_SHELLS_H_
#define CAPFIT_CORE_BODY_ATTACH_SHELLS_H_

#include <Eigen/Core>
#include <span>

#include "core/base/thread_pool.h"
#include "core/body/body.h"

namespace capfit::body {

// Sets body.shells. `positions`: all of the caller's vertices, in the caller's frame; `triangles`
// of the shells that belong to the character. Each vertex belongs to the segment of the nearest
// vertex of body.mesh, which must be found already. O(n) where the shells lie near the mesh.
void AttachShells(std::span<const Eigen::Vector3d> positions,
                  std::span<const mesh::Triangle> triangles, const ThreadPool& pool, Body& body);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_ATTACH_SHELLS_H_
