#include "core/solid/well_composed.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace capfit::solid {
namespace {

// Looks at the cells between four neighbouring columns, 64 at a time.
class DiagonalFinder {
 public:
  DiagonalFinder(const NodeGrid& grid, const NodeSet& set) : grid_(grid), set_(set) {}

  // What to add so that there are fewer diagonals between columns w and w + 1.
  [[nodiscard]] std::vector<GridNode> Look(std::size_t w) const {
    std::vector<GridNode> found;
    for (std::size_t v = 0; v + 1 < grid_.size[1]; ++v) {
      for (std::size_t k = 0; k < grid_.words_per_column(); ++k) {
        LookAt({k, v, w}, found);
      }
    }
    return found;
  }

  // The same for the cells around one node.
  void LookAround(const GridNode& node, std::vector<GridNode>& found) const {
    for (const std::size_t w : {node.w - 1, node.w}) {
      for (const std::size_t v : {node.v - 1, node.v}) {
        LookAt({(node.u - 1) / 64, v, w}, found);
        if (node.u % 64 == 0) LookAt({node.u / 64, v, w}, found);
      }
    }
  }

 private:
  // Of a word of cells.
  struct Place {
    std::size_t k, v, w;
  };

  void LookAt(const Place& at, std::vector<GridNode>& found) const {
    // Corner 4 * dw + 2 * dv + du.
    std::array<std::uint64_t, 8> corner;
    for (std::size_t side = 0; side < 4; ++side) {
      const std::size_t i = grid_.WordAt(at.k, at.v + side % 2, at.w + side / 2);
      corner[2 * side] = set_.words()[i];
      corner[2 * side + 1] = set_.NextWord(i);
    }
    std::uint64_t all = ~std::uint64_t{0};
    std::uint64_t any = 0;
    for (const std::uint64_t word : corner) {
      all &= word;
      any |= word;
    }
    if ((any & ~all) == 0) return;
    // The three squares at the cell's first corner; the others are other cells'.
    for (const auto& [a, b, c, d] : {std::array{0, 1, 2, 3}, {0, 1, 4, 5}, {0, 2, 4, 6}}) {
      const std::uint64_t crossed =
          (corner[a] ^ corner[b]) & (corner[c] ^ corner[d]) & (corner[a] ^ corner[c]);
      ForEachBit(crossed & corner[a],
                 [&, b = b, c = c](unsigned bit) { Offer(at, bit, b, c, found); });
      ForEachBit(crossed & ~corner[a],
                 [&, a = a, d = d](unsigned bit) { Offer(at, bit, a, d, found); });
    }
    for (int p = 0; p < 4; ++p) {
      std::uint64_t others_all = ~std::uint64_t{0};
      std::uint64_t others_any = 0;
      for (int q = 0; q < 8; ++q) {
        if (q == p || q == 7 - p) continue;
        others_all &= corner[q];
        others_any |= corner[q];
      }
      // Two lone nodes get one between them; of two lone gaps one is filled.
      ForEachBit(corner[p] & corner[7 - p] & ~others_any,
                 [&](unsigned bit) { Offer(at, bit, p ^ 1, p ^ 2, found); });
      ForEachBit(~corner[p] & ~corner[7 - p] & others_all,
                 [&](unsigned bit) { Offer(at, bit, p, 7 - p, found); });
    }
  }

  // Takes that of two corners of a cell that has more neighbours in the set.
  void Offer(const Place& at, unsigned bit, int one, int other,
             std::vector<GridNode>& found) const {
    const GridNode a = CornerOf(at, bit, one);
    const GridNode b = CornerOf(at, bit, other);
    found.push_back(NeighboursOf(b) > NeighboursOf(a) ? b : a);
  }

  [[nodiscard]] static GridNode CornerOf(const Place& at, unsigned bit, int corner) {
    return {static_cast<std::uint32_t>(64 * at.k + bit + corner % 2),
            static_cast<std::uint32_t>(at.v + corner / 2 % 2),
            static_cast<std::uint32_t>(at.w + corner / 4)};
  }

  [[nodiscard]] int NeighboursOf(const GridNode& n) const {
    // The outermost nodes must stay clear.
    if (n.u == 0 || n.v == 0 || n.w == 0 || n.u + 1 >= grid_.size[0] || n.v + 1 >= grid_.size[1] ||
        n.w + 1 >= grid_.size[2]) {
      return -1;
    }
    return set_.Has(n.u - 1, n.v, n.w) + set_.Has(n.u + 1, n.v, n.w) + set_.Has(n.u, n.v - 1, n.w) +
           set_.Has(n.u, n.v + 1, n.w) + set_.Has(n.u, n.v, n.w - 1) + set_.Has(n.u, n.v, n.w + 1);
  }

  const NodeGrid& grid_;
  const NodeSet& set_;
};

}  // namespace

std::size_t MakeWellComposed(const NodeGrid& grid, const ThreadPool& pool, NodeSet& set) {
  const DiagonalFinder finder(grid, set);
  std::vector<std::vector<GridNode>> by_column(grid.size[2]);
  pool.ForEach(grid.size[2] - 1, [&](std::size_t w) { by_column[w] = finder.Look(w); });
  std::vector<GridNode> fresh;
  for (const auto& nodes : by_column) fresh.insert(fresh.end(), nodes.begin(), nodes.end());
  std::size_t added = 0;
  while (!fresh.empty()) {
    added += fresh.size();
    for (const GridNode& node : fresh) set.Add(node.u, node.v, node.w);
    std::vector<GridNode> next;
    for (const GridNode& node : fresh) finder.LookAround(node, next);
    fresh = std::move(next);
  }
  return added;
}

}  // namespace capfit::solid
