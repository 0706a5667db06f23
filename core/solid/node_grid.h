// The regular grid that a solid is sampled on, and sets of its nodes.
#ifndef CAPFIT_CORE_SOLID_NODE_GRID_H_
#define CAPFIT_CORE_SOLID_NODE_GRID_H_

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace capfit::solid {

// Axes u, v, w are a right-handed turn of the caller's x, y, z with u along the longest side. A
// column is all nodes of one (v, w); 64 of them that follow each other along u share a word.
struct NodeGrid {
  std::array<int, 3> axes = {0, 1, 2};             // the caller's axes that u, v and w are
  Eigen::Vector3d low = Eigen::Vector3d::Zero();   // of node (0, 0, 0), as u, v, w
  double step = 1.0;                               // between neighbouring nodes
  std::array<std::uint32_t, 3> size = {64, 1, 1};  // nodes along u (a multiple of 64), v and w

  [[nodiscard]] std::size_t words_per_column() const { return size[0] / 64; }
  [[nodiscard]] std::size_t columns() const { return std::size_t{size[1]} * size[2]; }
  [[nodiscard]] std::size_t words() const { return columns() * words_per_column(); }
  // Of the word that holds node (64 * k, v, w).
  [[nodiscard]] std::size_t WordAt(std::size_t k, std::size_t v, std::size_t w) const {
    return (w * size[1] + v) * words_per_column() + k;
  }
  // A point of the caller's frame as u, v, w.
  [[nodiscard]] Eigen::Vector3d FromCaller(const Eigen::Vector3d& p) const {
    return {p[axes[0]], p[axes[1]], p[axes[2]]};
  }
  [[nodiscard]] Eigen::Vector3d ToCaller(const Eigen::Vector3d& uvw) const {
    Eigen::Vector3d p;
    for (int k = 0; k < 3; ++k) p[axes[k]] = uvw[k];
    return p;
  }
};

struct GridNode {
  std::uint32_t u = 0;
  std::uint32_t v = 0;
  std::uint32_t w = 0;
};

// One bit for each node. The outermost nodes of a grid stay clear in all sets of this room, so that
// a neighbour of any set node exists.
class NodeSet {
 public:
  explicit NodeSet(const NodeGrid& grid)
      : words_per_column_(grid.words_per_column()),
        size_v_(grid.size[1]),
        words_(grid.words(), 0) {}

  [[nodiscard]] std::vector<std::uint64_t>& words() { return words_; }
  [[nodiscard]] const std::vector<std::uint64_t>& words() const { return words_; }
  [[nodiscard]] std::size_t WordOf(std::uint32_t u, std::size_t v, std::size_t w) const {
    return (w * size_v_ + v) * words_per_column_ + u / 64;
  }
  [[nodiscard]] bool Has(std::uint32_t u, std::size_t v, std::size_t w) const {
    return (words_[WordOf(u, v, w)] >> (u % 64) & 1u) != 0;
  }
  void Add(std::uint32_t u, std::size_t v, std::size_t w) {
    words_[WordOf(u, v, w)] |= std::uint64_t{1} << (u % 64);
  }
  // Word i of the set moved down by one along u: bit k tells of node k + 1.
  [[nodiscard]] std::uint64_t NextWord(std::size_t i) const {
    const std::uint64_t carry = i + 1 < words_.size() ? words_[i + 1] << 63 : 0;
    return words_[i] >> 1 | carry;  // a column ends with a clear node, and so does the carry
  }

 private:
  std::size_t words_per_column_;
  std::size_t size_v_;
  std::vector<std::uint64_t> words_;
};

// Numbers the nodes of a set 0, 1, 2 ... in the order of the words.
class NodeNumbers {
 public:
  NodeNumbers() = default;
  explicit NodeNumbers(const NodeSet& set) : before_(set.words().size() + 1, 0) {
    for (std::size_t i = 0; i < set.words().size(); ++i) {
      before_[i + 1] = before_[i] + static_cast<std::uint32_t>(std::popcount(set.words()[i]));
    }
  }
  [[nodiscard]] std::size_t count() const { return before_.back(); }
  // Of bit `bit` of word i, whose content is `word`.
  [[nodiscard]] std::uint32_t Of(std::size_t i, std::uint64_t word, unsigned bit) const {
    const std::uint64_t below = (std::uint64_t{1} << bit) - 1;
    return before_[i] + static_cast<std::uint32_t>(std::popcount(word & below));
  }

 private:
  std::vector<std::uint32_t> before_;
};

// visit(bit) for each set bit of a word, from the lowest up.
template <typename Visit>
void ForEachBit(std::uint64_t word, const Visit& visit) {
  for (; word != 0; word &= word - 1) visit(static_cast<unsigned>(std::countr_zero(word)));
}

// Makes bits [first, end) of a column all `value`.
inline void SetBits(std::uint64_t* words, std::uint32_t first, std::uint32_t end, bool value) {
  while (first < end) {
    const std::uint32_t stop = std::min(end, (first / 64 + 1) * 64);
    const std::uint32_t count = stop - first;
    const std::uint64_t ones = count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
    if (value) {
      words[first / 64] |= ones << (first % 64);
    } else {
      words[first / 64] &= ~(ones << (first % 64));
    }
    first = stop;
  }
}

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_NODE_GRID_H_
