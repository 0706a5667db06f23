// Loose triangles become one surface where they touch.
#ifndef CAPFIT_CORE_MESH_JOIN_TRIANGLES_H_
#define CAPFIT_CORE_MESH_JOIN_TRIANGLES_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/mesh/surface.h"

namespace capfit::mesh {

struct JoinedTriangles {
  Surface surface;
  // For each vertex the one that stands for it after welding; empty: each for itself.
  std::vector<std::uint32_t> stand_in;
  std::size_t welded = 0;      // vertices that another stands for
  std::size_t degenerate = 0;  // triangles dropped because two corners became one
  std::size_t duplicates = 0;  // triangles dropped as copies of others
  std::size_t fins = 0;        // loose triangles dropped at edges that have two already
  std::size_t crowded = 0;     // edges of more than two triangles that remained and were matched
};

// `triangles` (corners in range and different within each) with their neighbours. Where those do
// not make a closed, oriented surface at once: drops copies of triangles, welds the vertices of
// open edges (equal ones first, then those within `weld_tolerance`, if positive), drops fins, and
// matches what meets at crowded edges. O(n).
//
// Where `observer` cancels, what is there so far comes back, of no further use.
[[nodiscard]] JoinedTriangles JoinTriangles(std::span<const Eigen::Vector3d> positions,
                                            std::vector<Triangle> triangles, EdgeMates mates,
                                            double weld_tolerance, const FitObserver& observer);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_JOIN_TRIANGLES_H_
