// The rims of a surface.
#ifndef CAPFIT_CORE_MESH_OPEN_LOOPS_H_
#define CAPFIT_CORE_MESH_OPEN_LOOPS_H_

#include <optional>
#include <vector>

#include "core/mesh/edge_mates.h"
#include "core/mesh/surface.h"

namespace capfit::mesh {

// Open half-edges, each beginning where the one before ends, the last back at the first.
using OpenLoop = std::vector<HalfEdge>;

// Takes the open half-edges of a consistently oriented surface apart into loops that visit no
// vertex twice. Nothing where they do not form loops. O(n log n).
[[nodiscard]] std::optional<std::vector<OpenLoop>> FindOpenLoops(const Surface& surface);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_OPEN_LOOPS_H_
