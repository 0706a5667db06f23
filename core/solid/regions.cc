#include "core/solid/regions.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <utility>

namespace capfit::solid {
namespace {

void SetRun(const NodeGrid& grid, std::size_t column, const NodeRegions::Run& run, bool value,
            NodeSet& set) {
  SetBits(set.words().data() + column * grid.words_per_column(), run.first, run.end, value);
}

}  // namespace

NodeRegions::NodeRegions(const NodeGrid& grid, const NodeSet& set, bool of_clear) : grid_(grid) {
  begin_.push_back(0);
  for (std::size_t column = 0; column < grid.columns(); ++column) {
    AddRuns(set.words().data() + column * grid.words_per_column(), of_clear);
    begin_.push_back(static_cast<std::uint32_t>(runs_.size()));
  }
  DisjointSets regions(runs_.size());
  for (std::size_t w = 0; w < grid.size[2]; ++w) {
    for (std::size_t v = 0; v < grid.size[1]; ++v) {
      const std::size_t column = w * grid.size[1] + v;
      if (v + 1 < grid.size[1]) Join(column, column + 1, regions);
      if (w + 1 < grid.size[2]) Join(column, column + grid.size[1], regions);
    }
  }
  region_ = std::move(regions).All();
}

std::uint32_t NodeRegions::RegionAt(const GridNode& node) const {
  const std::size_t column = std::size_t{node.w} * grid_.size[1] + node.v;
  const auto first = runs_.begin() + begin_[column];
  const auto last = runs_.begin() + begin_[column + 1];
  const auto run = std::partition_point(first, last, [&](const Run& r) { return r.end <= node.u; });
  if (run == last || run->first > node.u) return kNoRegion;
  return RegionOf(static_cast<std::uint32_t>(run - runs_.begin()));
}

std::vector<std::size_t> NodeRegions::Sizes() const {
  std::vector<std::size_t> sizes(runs_.size(), 0);
  for (std::uint32_t run = 0; run < runs_.size(); ++run) {
    sizes[RegionOf(run)] += runs_[run].end - runs_[run].first;
  }
  return sizes;
}

void NodeRegions::AddRuns(const std::uint64_t* words, bool of_clear) {
  bool is_open = false;
  for (std::size_t k = 0; k < grid_.words_per_column(); ++k) {
    const std::uint64_t word = of_clear ? ~words[k] : words[k];
    const std::uint64_t before = word << 1 | (is_open ? 1u : 0u);
    ForEachBit(word ^ before, [&](unsigned bit) {
      const auto at = static_cast<std::uint32_t>(64 * k + bit);
      if (is_open) {
        runs_.back().end = at;
      } else {
        runs_.push_back({at, at});
      }
      is_open = !is_open;
    });
  }
  if (is_open) runs_.back().end = grid_.size[0];
}

// Both lists are in order.
void NodeRegions::Join(std::size_t one, std::size_t other, DisjointSets& regions) const {
  std::uint32_t a = begin_[one];
  std::uint32_t b = begin_[other];
  while (a < begin_[one + 1] && b < begin_[other + 1]) {
    if (std::max(runs_[a].first, runs_[b].first) < std::min(runs_[a].end, runs_[b].end)) {
      regions.Join(a, b);
    }
    ++(runs_[a].end < runs_[b].end ? a : b);
  }
}

std::size_t FillCavities(const NodeGrid& grid, NodeSet& set) {
  NodeRegions clear(grid, set, true);
  const std::uint32_t outside = clear.RegionOf(0);  // the first column is clear
  std::size_t filled = 0;
  clear.ForEach([&](std::size_t column, std::uint32_t run) {
    if (clear.RegionOf(run) == outside) return;
    filled += clear.runs()[run].end - clear.runs()[run].first;
    SetRun(grid, column, clear.runs()[run], true, set);
  });
  return filled;
}

std::vector<std::size_t> KeepLargestRegion(const NodeGrid& grid, NodeSet& set) {
  NodeRegions regions(grid, set, false);
  std::vector<std::size_t> size = regions.Sizes();
  const auto largest =
      static_cast<std::uint32_t>(std::max_element(size.begin(), size.end()) - size.begin());
  regions.ForEach([&](std::size_t column, std::uint32_t run) {
    if (regions.RegionOf(run) != largest) SetRun(grid, column, regions.runs()[run], false, set);
  });
  std::erase(size, std::size_t{0});
  std::sort(size.begin(), size.end(), std::greater<>());
  return size;
}

}  // namespace capfit::solid
