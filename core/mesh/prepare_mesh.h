// From the mesh as it came to the checked mesh: mended where that is safe, refused where it is not.
#ifndef CAPFIT_CORE_MESH_PREPARE_MESH_H_
#define CAPFIT_CORE_MESH_PREPARE_MESH_H_

#include <cstddef>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/warning.h"
#include "core/mesh/body_mesh.h"
#include "core/mesh/polygon_soup.h"

namespace capfit::mesh {

// Limits on what is accepted. Sizes beyond them are refused before anything is allocated.
struct MeshLimits {
  std::size_t max_vertices = 2'000'000;
  std::size_t max_faces = 2'000'000;
  std::size_t max_corners_per_face = 64;
};

struct PreparedMesh {
  BodyMesh mesh;                  // still in the caller's unit and axes
  std::vector<Warning> warnings;  // every repair, with counts
};

// Checks (finite positions, indices in range, sizes), welds equal vertices (within 1e-5 of the
// diagonal), triangulates by fans, drops degenerate and duplicate faces, keeps the part with the
// largest volume, turns faces the same way round and outward, and closes holes. O(n log n).
// Errors name the first offender: "triangle_indices[17] is 90210, must be below 6890".
[[nodiscard]] absl::StatusOr<PreparedMesh> PrepareMesh(const PolygonSoup& soup,
                                                       const MeshLimits& limits = {});

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_PREPARE_MESH_H_
