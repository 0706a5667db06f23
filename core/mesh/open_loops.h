// The rims of a surface.
#ifndef CAPFIT_CORE_MESH_OPEN_LOOPS_H_
#define CAPFIT_CORE_MESH_OPEN_LOOPS_H_

#include <cstdint>
#include <vector>

#include "core/mesh/surface.h"

namespace capfit::mesh {

struct OpenLoop {
  std::vector<std::uint32_t> vertices;  // each once, in the direction in which a filling runs
  std::uint32_t triangle = 0;           // one of those along it
};

// The loops of open edges of a consistently oriented surface, in the order of their vertices. Where
// it touches itself in a vertex of a hole, what lies on either side is a loop by itself.
// O(n log n); a closed surface costs no more than a look at its mates.
[[nodiscard]] std::vector<OpenLoop> FindOpenLoops(const Surface& surface);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_OPEN_LOOPS_H_
