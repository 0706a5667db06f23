#include "core/solid/bridges.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/solid/regions.h"

namespace capfit::solid {
namespace {

// Surfaces face each other where a line meets both at least this steeply (as cosine).
constexpr float kFacing = 0.3f;
// How much wider than its narrowest place a gap is filled: by half, and these steps.
constexpr double kWider = 1.5;
constexpr double kWiderSteps = 2.0;

using RegionPair = std::pair<std::uint32_t, std::uint32_t>;

// Clear nodes [first, end) of a line between two regions.
struct Gap {
  RegionPair regions;
  double width = 0.0;
  int axis = 0;
  std::uint32_t row = 0;
  std::uint32_t column = 0;
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

class GapFinder {
 public:
  GapFinder(const NodeGrid& grid, const NodeRegions& regions,
            std::span<const Eigen::Vector3f> normals, double reach)
      : grid_(grid), regions_(regions), sizes_(regions.Sizes()), normals_(normals), reach_(reach) {}

  [[nodiscard]] bool IsAnyApart() const {
    return std::count_if(sizes_.begin(), sizes_.end(),
                         [](std::size_t size) { return size >= kCrumbNodes; }) > 1;
  }

  [[nodiscard]] std::vector<Gap> GapsOfRow(const GridLines& lines, int axis,
                                           std::size_t row) const {
    std::vector<Gap> gaps;
    for (std::size_t column = 0; column < lines.columns(); ++column) {
      const std::span<const Passage> line = lines.Line(row, column);
      for (std::size_t i = 1; i + 1 < line.size(); i += 2) {
        const Passage& out = line[i];
        const Passage& in = line[i + 1];
        Gap gap = {{},
                   in.along - out.along,
                   axis,
                   static_cast<std::uint32_t>(row),
                   static_cast<std::uint32_t>(column)};
        gap.first = FirstNodeAt(grid_, axis, out.along);
        gap.end = FirstNodeAt(grid_, axis, in.along);
        if (gap.width < reach_ && gap.first < gap.end &&
            AreOpposed(normals_[out.triangle], normals_[in.triangle], axis, kFacing) &&
            NameRegions(gap)) {
          gaps.push_back(gap);
        }
      }
    }
    return gaps;
  }

 private:
  bool NameRegions(Gap& gap) const {
    const std::uint32_t a = RegionAt(gap, gap.first - 1);
    const std::uint32_t b = RegionAt(gap, gap.end);
    if (a == b || a == NodeRegions::kNoRegion || b == NodeRegions::kNoRegion) return false;
    gap.regions = std::minmax(a, b);
    return sizes_[a] >= kCrumbNodes && sizes_[b] >= kCrumbNodes;
  }
  [[nodiscard]] std::uint32_t RegionAt(const Gap& gap, std::uint32_t along) const {
    return regions_.RegionAt(NodeOnLine(gap.axis, gap.row, gap.column, along));
  }

  const NodeGrid& grid_;
  const NodeRegions& regions_;
  std::vector<std::size_t> sizes_;
  std::span<const Eigen::Vector3f> normals_;
  double reach_;
};

// The pairs of regions to join and how wide a gap to fill between them.
std::map<RegionPair, double> ChoosePairs(const std::vector<Gap>& gaps, double step) {
  std::map<RegionPair, double> narrowest;
  for (const Gap& gap : gaps) {
    const auto [place, is_new] = narrowest.emplace(gap.regions, gap.width);
    place->second = std::min(place->second, gap.width);
  }
  std::vector<std::pair<double, RegionPair>> order;
  for (const auto& [regions, width] : narrowest) order.emplace_back(width, regions);
  std::sort(order.begin(), order.end());
  std::map<std::uint32_t, std::uint32_t> group;
  const auto group_of = [&](std::uint32_t region) {
    while (group.contains(region)) region = group[region];
    return region;
  };
  std::map<RegionPair, double> chosen;
  for (const auto& [width, regions] : order) {
    const std::uint32_t a = group_of(regions.first);
    const std::uint32_t b = group_of(regions.second);
    if (a == b) continue;
    group[a] = b;
    chosen[regions] = kWider * width + kWiderSteps * step;
  }
  return chosen;
}

}  // namespace

std::size_t BridgeRegions(const NodeGrid& grid, const std::array<GridLines, 3>& lines,
                          std::span<const Eigen::Vector3f> normals, double reach,
                          const ThreadPool& pool, NodeSet& set) {
  const NodeRegions regions(grid, set, false);
  const GapFinder finder(grid, regions, normals, reach);
  if (!finder.IsAnyApart()) return 0;
  std::vector<Gap> gaps;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::vector<Gap>> by_row(lines[axis].rows.size());
    pool.ForEach(by_row.size(),
                 [&](std::size_t row) { by_row[row] = finder.GapsOfRow(lines[axis], axis, row); });
    for (const auto& row : by_row) gaps.insert(gaps.end(), row.begin(), row.end());
  }
  const std::map<RegionPair, double> chosen = ChoosePairs(gaps, grid.step);
  std::size_t added = 0;
  for (const Gap& gap : gaps) {
    const auto pair = chosen.find(gap.regions);
    if (pair == chosen.end() || gap.width > pair->second) continue;
    for (std::uint32_t along = gap.first; along < gap.end; ++along) {
      const GridNode node = NodeOnLine(gap.axis, gap.row, gap.column, along);
      set.Add(node.u, node.v, node.w);
    }
    added += gap.end - gap.first;
  }
  return added;
}

}  // namespace capfit::solid
