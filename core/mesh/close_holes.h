// Closes the holes of a surface with triangles between its own vertices.
#ifndef CAPFIT_CORE_MESH_CLOSE_HOLES_H_
#define CAPFIT_CORE_MESH_CLOSE_HOLES_H_

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "absl/status/statusor.h"
#include "core/mesh/surface.h"

namespace capfit::mesh {

struct ClosedHoles {
  std::size_t holes = 0;
  double area = 0.0;                                         // of all new triangles
  double longest_perimeter = 0.0;                            // of the largest hole
  Eigen::Vector3d largest_middle = Eigen::Vector3d::Zero();  // mean of its vertices
};

// Fills each open loop of a consistently oriented `surface`; the new triangles come last and match
// their neighbours' orientation. No vertex is added: each must be one of the caller's. Where loops
// touch in a vertex each is closed by itself. No edge gets more than two triangles.
// FAILED_PRECONDITION (HOLE_NOT_CLOSED) where a loop cannot be filled so.
[[nodiscard]] absl::StatusOr<ClosedHoles> CloseHoles(std::span<const Eigen::Vector3d> positions,
                                                     Surface& surface);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_CLOSE_HOLES_H_
