// Regions of a node set that hang together by the grid's edges.
#ifndef CAPFIT_CORE_SOLID_REGIONS_H_
#define CAPFIT_CORE_SOLID_REGIONS_H_

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/solid/node_grid.h"

namespace capfit::solid {

// Regions of fewer nodes are crumbs that nobody misses.
inline constexpr std::size_t kCrumbNodes = 32;

// The regions of a set, or of the nodes that it leaves out, as runs along the columns.
class NodeRegions {
 public:
  static constexpr std::uint32_t kNoRegion = 0xFFFFFFFFu;

  // Nodes [first, end) of a column.
  struct Run {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
  };

  // O(columns + runs).
  NodeRegions(const NodeGrid& grid, const NodeSet& set, bool of_clear);

  [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }
  // A region is named by its first run.
  [[nodiscard]] std::uint32_t RegionOf(std::uint32_t run) const { return region_[run]; }
  // kNoRegion for a node of none.
  [[nodiscard]] std::uint32_t RegionAt(const GridNode& node) const;
  // Nodes of each region, by its name; 0 elsewhere.
  [[nodiscard]] std::vector<std::size_t> Sizes() const;
  // visit(column, run) in the order of the columns.
  template <typename Visit>
  void ForEach(const Visit& visit) const {
    for (std::size_t column = 0; column + 1 < begin_.size(); ++column) {
      for (std::uint32_t r = begin_[column]; r < begin_[column + 1]; ++r) visit(column, r);
    }
  }

 private:
  void AddRuns(const std::uint64_t* words, bool of_clear);
  void Join(std::size_t one, std::size_t other, DisjointSets& regions) const;

  const NodeGrid& grid_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> begin_;   // by column
  std::vector<std::uint32_t> region_;  // by run
};

// Adds every node that cannot be reached from the outermost nodes without passing `set`: whatever a
// closed surface encloses. Returns how many. O(columns + runs of nodes).
std::size_t FillCavities(const NodeGrid& grid, NodeSet& set);

// Leaves only the largest region. Returns the sizes of all regions, the largest first.
std::vector<std::size_t> KeepLargestRegion(const NodeGrid& grid, NodeSet& set);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_REGIONS_H_
