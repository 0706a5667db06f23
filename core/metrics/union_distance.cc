#include "core/metrics/union_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace capfit::metrics {
namespace {

// Cells along each side of the blocks that are culled together.
constexpr std::size_t kBlock = 4;

}  // namespace

UnionDistance::UnionDistance(std::vector<geometry::TaperedCapsule> solids,
                             const Eigen::AlignedBox3d& box, int cells, const ThreadPool& pool)
    : solids_(std::move(solids)), all_(solids_.size()), low_(box.min()) {
  std::iota(all_.begin(), all_.end(), 0);
  cell_m_ = box.sizes().maxCoeff() / cells;
  std::array<std::size_t, 3> blocks{};
  for (int axis = 0; axis < 3; ++axis) {
    counts_[axis] = static_cast<std::size_t>(box.sizes()[axis] / cell_m_) + 1;
    blocks[axis] = (counts_[axis] + kBlock - 1) / kBlock;
  }
  std::vector<Candidates> lists(counts_[0] * counts_[1] * counts_[2]);
  // Slabs of blocks across the first axis: enough tasks, each of some size.
  pool.ForEach(blocks[1] * blocks[2], [&](std::size_t slab) {
    for (std::size_t i = 0; i < blocks[0]; ++i) FillBlock(slab * blocks[0] + i, lists);
  });
  begin_.assign(1, 0);
  for (const Candidates& list : lists) {
    candidates_.insert(candidates_.end(), list.begin(), list.end());
    begin_.push_back(static_cast<std::uint32_t>(candidates_.size()));
  }
}

UnionDistance::Candidates UnionDistance::Near(const Candidates& from, const Eigen::Vector3d& middle,
                                              double reach) const {
  std::vector<double> distances;
  distances.reserve(from.size());
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::int32_t solid : from) {
    distances.push_back(solids_[solid].SignedDistance(middle));
    nearest = std::min(nearest, distances.back());
  }
  Candidates result;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (distances[i] > nearest + 2.0 * reach) continue;
    result.push_back(from[i]);
    if (distances[i] == nearest) std::swap(result.front(), result.back());
  }
  return result;
}

void UnionDistance::FillBlock(std::size_t block, std::vector<Candidates>& cells) const {
  const double half_diagonal = 0.5 * std::sqrt(3.0) * cell_m_;
  std::array<std::size_t, 3> first{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t blocks = (counts_[axis] + kBlock - 1) / kBlock;
    first[axis] = block % blocks * kBlock;
    block /= blocks;
  }
  const auto middle = [&](double x, double y, double z) {
    return Eigen::Vector3d(low_ + cell_m_ * Eigen::Vector3d(x, y, z));
  };
  const auto f = [&](std::size_t axis, double more) {
    return static_cast<double>(first[axis]) + more;
  };
  const Candidates in_block =
      Near(all_, middle(f(0, 0.5 * kBlock), f(1, 0.5 * kBlock), f(2, 0.5 * kBlock)),
           kBlock * half_diagonal);
  for (std::size_t k = 0; k < kBlock * kBlock * kBlock; ++k) {
    const std::array<std::size_t, 3> step = {k % kBlock, k / kBlock % kBlock,
                                             k / (kBlock * kBlock)};
    std::array<std::size_t, 3> cell{};
    bool is_inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cell[axis] = first[axis] + step[axis];
      is_inside = is_inside && cell[axis] < counts_[axis];
    }
    if (!is_inside) continue;
    const Eigen::Vector3d at =
        middle(f(0, 0.5 + static_cast<double>(step[0])), f(1, 0.5 + static_cast<double>(step[1])),
               f(2, 0.5 + static_cast<double>(step[2])));
    cells[CellIndex(cell)] = Near(in_block, at, half_diagonal);
  }
}

UnionDistance::Nearest UnionDistance::At(const Eigen::Vector3d& point_m, double enough_m) const {
  std::span<const std::int32_t> candidates = all_;
  std::array<std::size_t, 3> cell{};
  bool is_inside = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = (point_m[axis] - low_[axis]) / cell_m_;
    is_inside = is_inside && at >= 0.0 && at < static_cast<double>(counts_[axis]);
    cell[axis] = is_inside ? static_cast<std::size_t>(at) : 0;
  }
  if (is_inside) {
    const std::size_t index = CellIndex(cell);
    candidates = std::span(candidates_).subspan(begin_[index], begin_[index + 1] - begin_[index]);
  }
  Nearest nearest{std::numeric_limits<double>::infinity(), -1};
  for (const std::int32_t solid : candidates) {
    const double distance = solids_[solid].SignedDistance(point_m);
    if (distance < enough_m) return {distance, solid};
    const bool is_tie = distance == nearest.distance_m && solid < nearest.solid;
    if (distance < nearest.distance_m || is_tie) nearest = {distance, solid};
  }
  return nearest;
}

}  // namespace capfit::metrics
