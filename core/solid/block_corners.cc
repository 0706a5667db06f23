#include "core/solid/block_corners.h"

#include <array>

namespace capfit::solid {
namespace {

// The 27 nodes of a block as bits u + 4 * (v + 4 * w), and its corners.
constexpr std::uint64_t kNodes = 0x0000'0777'0777'0777u;
constexpr std::uint64_t kCorners = 0x0000'0505'0000'0505u;

// Whether all corners of a cube in the set hang together by its edges, all others too, and no side
// has its corners crosswise: then one sheet parts them.
bool HangTogether(unsigned corners) {
  unsigned reached = corners & (~corners + 1u);
  for (int round = 0; round < 8; ++round) {
    for (unsigned c = 0; c < 8; ++c) {
      if ((reached >> c & 1u) == 0) continue;
      reached |= corners & (1u << (c ^ 1u) | 1u << (c ^ 2u) | 1u << (c ^ 4u));
    }
  }
  return reached == corners;
}

std::array<bool, 256> MakeOneSheetTable() {
  std::array<bool, 256> table{};
  for (unsigned corners = 1; corners < 255; ++corners) {
    bool is_crosswise = false;
    for (const unsigned axis : {1u, 2u, 4u}) {
      const unsigned a = axis == 1u ? 2u : 1u;
      const unsigned b = 7u ^ axis ^ a;
      for (const unsigned from : {0u, axis}) {
        const unsigned side = (corners >> from & 1u) | (corners >> (from ^ a) & 1u) << 1 |
                              (corners >> (from ^ b) & 1u) << 2 |
                              (corners >> (from ^ a ^ b) & 1u) << 3;
        is_crosswise = is_crosswise || side == 0b1001u || side == 0b0110u;
      }
    }
    table[corners] = !is_crosswise && HangTogether(corners) && HangTogether(~corners & 255u);
  }
  return table;
}

bool IsOneSheet(unsigned corners) {
  static const std::array<bool, 256> kTable = MakeOneSheetTable();
  return kTable[corners];
}

// Bit of corner 4 * w + 2 * v + u among the 27 nodes.
unsigned CornerBit(unsigned c) { return 2 * (c % 2) + 8 * (c / 2 % 2) + 32 * (c / 4); }

// Whether every node between corners of the block is as one of them. A node is written as two
// bits an axis, so the middle of an axis is 1 and its ends 0 and 2.
bool IsAsItsEnds(std::uint64_t in) {
  // Spread the corners: what is set, or clear, at both ends of an axis must be so between them.
  std::uint64_t any = in & kCorners;
  std::uint64_t all = in & kCorners;
  for (const unsigned shift : {1u, 4u, 16u}) {
    any |= any << shift | any >> shift;
    all |= all << shift & all >> shift;
  }
  return (in & kNodes & ~any) == 0 && (~in & kNodes & all) == 0;
}

}  // namespace

bool IsOneSheetToldByCorners(std::uint64_t nodes) {
  unsigned corners = 0;
  for (unsigned c = 0; c < 8; ++c) corners |= (nodes >> CornerBit(c) & 1u) << c;
  return IsOneSheet(corners) && IsAsItsEnds(nodes);
}

}  // namespace capfit::solid
