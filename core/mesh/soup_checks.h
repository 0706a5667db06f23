// Whether arrays from a caller make sense as a mesh at all.
#ifndef CAPFIT_CORE_MESH_SOUP_CHECKS_H_
#define CAPFIT_CORE_MESH_SOUP_CHECKS_H_

#include "absl/status/status.h"
#include "core/mesh/polygon_soup.h"
#include "core/mesh/prepare_mesh.h"

namespace capfit::mesh {

// Sizes within `limits` and consistent, positions finite and within 1e12, indices in range.
// INVALID_ARGUMENT names the first offender. O(n), allocates nothing.
[[nodiscard]] absl::Status CheckSoup(const PolygonSoup& soup, const MeshLimits& limits);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_SOUP_CHECKS_H_
