// Which blocks of nodes a surface passes in one sheet.
#ifndef CAPFIT_CORE_SOLID_BLOCK_CORNERS_H_
#define CAPFIT_CORE_SOLID_BLOCK_CORNERS_H_

#include <cstdint>

namespace capfit::solid {

// Whether the boundary of a set passes a block of 27 nodes in a single sheet that the block's eight
// corners tell of alone: every node between corners is as one of them. Bit u + 4 * (v + 4 * w) of
// `nodes`: node (u, v, w), each 0 to 2, is in the set.
[[nodiscard]] bool IsOneSheetToldByCorners(std::uint64_t nodes);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_BLOCK_CORNERS_H_
