#include "core/mesh/plane_cut.h"

#include <algorithm>
#include <utility>

namespace capfit::mesh {
namespace {

EdgeKey KeyOf(std::uint32_t a, std::uint32_t b) {
  return (static_cast<EdgeKey>(std::min(a, b)) << 32) | std::max(a, b);
}

// The pieces by the edge they come in over: a hash table with open addresses.
class PiecesByEdge {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  explicit PiecesByEdge(const std::vector<CutPiece>& pieces) : pieces_(pieces) {
    while ((std::size_t{1} << bits_) < 4 * pieces.size()) ++bits_;
    slots_.assign(std::size_t{1} << bits_, kNone);
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
      std::size_t slot = SlotOf(pieces[i].from);
      while (slots_[slot] != kNone) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = i;
    }
  }
  // One that is not used yet.
  [[nodiscard]] std::uint32_t Find(EdgeKey edge, const std::vector<char>& used) const {
    std::size_t slot = SlotOf(edge);
    while (slots_[slot] != kNone && (pieces_[slots_[slot]].from != edge || used[slots_[slot]])) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    return slots_[slot];
  }

 private:
  // The upper bits of a product with the golden ratio.
  [[nodiscard]] std::size_t SlotOf(EdgeKey edge) const {
    return (edge * 0x9E3779B97F4A7C15u) >> (64 - bits_);
  }

  const std::vector<CutPiece>& pieces_;
  int bits_ = 4;
  std::vector<std::uint32_t> slots_;
};

}  // namespace

void CutPassedTriangle(std::span<const Eigen::Vector3d> points, const Triangle& triangle,
                       const std::array<double, 3>& heights, std::size_t above,
                       std::vector<CutPiece>& pieces) {
  // Outward normals: the outline comes in where the triangle's edge goes down, from corner `in` to
  // the next, and goes out where it rises from corner `out`.
  constexpr std::array<std::size_t, 8> kIn = {0, 0, 1, 1, 2, 0, 2, 0};
  constexpr std::array<std::size_t, 8> kOut = {0, 2, 0, 2, 1, 1, 0, 0};
  constexpr std::array<std::size_t, 3> kNext = {1, 2, 0};
  const std::array<std::size_t, 2> in = {kIn[above], kNext[kIn[above]]};
  const std::size_t out = kOut[above];
  // From the lower index, so that both triangles at the edge get the same bits; which one that is
  // is as good as chance: no branch. The heights' signs differ: never 0 / 0.
  const std::size_t first = triangle[in[0]] > triangle[in[1]] ? 1 : 0;
  const std::size_t low = in[first];
  const std::size_t high = in[1 - first];
  const double t = heights[low] / (heights[low] - heights[high]);
  const Eigen::Vector3d& from = points[triangle[low]];
  pieces.push_back(
      {KeyOf(triangle[low], triangle[high]), KeyOf(triangle[out], triangle[kNext[out]]),
       from + t * (points[triangle[high]] - from), t < 0.5 ? triangle[low] : triangle[high]});
}

std::vector<CutLoop> LinkPieces(const std::vector<CutPiece>& pieces) {
  std::vector<CutLoop> loops;
  std::vector<char> used(pieces.size(), 0);
  const PiecesByEdge by_edge(pieces);
  for (std::uint32_t first = 0; first < pieces.size(); ++first) {
    if (used[first]) continue;
    CutLoop loop;
    std::uint32_t at = first;
    while (at != PiecesByEdge::kNone) {
      used[at] = 1;
      loop.pieces.push_back(at);
      at = by_edge.Find(pieces[at].to, used);
    }
    loop.is_closed = pieces[loop.pieces.back()].to == pieces[first].from;
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace capfit::mesh
