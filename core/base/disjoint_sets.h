// Things that are joined one by one into sets.
#ifndef CAPFIT_CORE_BASE_DISJOINT_SETS_H_
#define CAPFIT_CORE_BASE_DISJOINT_SETS_H_

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace capfit {

// Where each has a link to another of its set, the last to itself: follows them to that one, and
// shortens them on the way.
[[nodiscard]] inline std::uint32_t FollowLinks(std::span<std::uint32_t> link, std::uint32_t i) {
  while (link[i] != i) i = link[i] = link[link[i]];
  return i;
}

// Sets of the numbers from 0 on; the lowest member stands for each. Nearly O(1) a call.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  // Joined already: parents[i] <= i is in the set of i.
  explicit DisjointSets(std::vector<std::uint32_t> parents) : parent_(std::move(parents)) {}

  [[nodiscard]] std::size_t size() const { return parent_.size(); }

  [[nodiscard]] std::uint32_t Find(std::uint32_t i) { return FollowLinks(parent_, i); }

  // False where they were together already.
  bool Join(std::uint32_t a, std::uint32_t b) {
    a = Find(a);
    b = Find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

  // Who stands for each.
  [[nodiscard]] std::vector<std::uint32_t> All() && {
    // (Parents are lower, so theirs are known already.)
    for (std::uint32_t& parent : parent_) parent = parent_[parent];
    return std::move(parent_);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_DISJOINT_SETS_H_
