#include "core/tighten/point_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/tighten/distance_kernel.h"
#include "core/tighten/solid_table.h"

namespace capfit::tighten {
namespace {

using geometry::TaperedCapsule;

// Points of a block on average. Fewer cull better, more fill the vector loop better; between 24 and
// 96 the time changes little.
constexpr double kPointsPerBlock = 48.0;
constexpr std::size_t kBlocksPerChunk = 32;
// A bound on memory: cells of the grid for each point.
constexpr double kMaxCellsPerPoint = 4.0;

struct Grid {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  double cell = 1.0;
  std::array<std::uint32_t, 3> counts{1, 1, 1};

  std::uint32_t CellOf(const Eigen::Vector3d& point) const {
    std::array<std::uint32_t, 3> at{};
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::uint32_t>((point[k] - low[k]) / cell);
      at[k] = std::min(i, counts[k] - 1);
    }
    return (at[2] * counts[1] + at[1]) * counts[0] + at[0];
  }
  std::size_t size() const { return std::size_t{counts[0]} * counts[1] * counts[2]; }
};

Eigen::Vector3d Folded(const Eigen::Vector3d& point, PointGrid::Fold fold) {
  if (fold == PointGrid::Fold::kNone) return point;
  return {std::abs(point.x()), point.y(), point.z()};
}

Grid MakeGrid(std::span<const Eigen::Vector3d> points, PointGrid::Fold fold) {
  Grid grid;
  if (points.empty()) return grid;
  Eigen::Array3d low = Folded(points[0], fold);
  Eigen::Array3d high = low;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d at = Folded(p, fold);
    low = low.min(at.array());
    high = high.max(at.array());
  }
  grid.low = low;
  const Eigen::Array3d extent = (high - low).max(1e-9);
  // The points lie on a surface of about the box's longest side times its girth.
  const double blocks = std::max(1.0, static_cast<double>(points.size()) / kPointsPerBlock);
  const double area = extent.maxCoeff() * extent.sum();
  grid.cell = std::sqrt(area / blocks);
  const double max_cells = 64.0 + kMaxCellsPerPoint * static_cast<double>(points.size());
  while ((extent / grid.cell).ceil().max(1.0).prod() > max_cells) grid.cell *= 1.25;
  for (int k = 0; k < 3; ++k) {
    grid.counts[k] = static_cast<std::uint32_t>(std::max(1.0, std::ceil(extent[k] / grid.cell)));
  }
  return grid;
}

// The solids' distances from a block's centre, the least of them and whose it is.
struct AtCenter {
  AtCenter(const SolidTable& solids, const Eigen::Vector3d& center,
           std::vector<double>& distance_m) {
    solids.DistancesFrom(center, distance_m);
    for (std::size_t k = 0; k < solids.size(); ++k) {
      if (distance_m[k] < least_m) least_m = distance_m[k], nearest = k;
    }
  }
  double least_m = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
};

}  // namespace

PointGrid::PointGrid(std::span<const Eigen::Vector3d> points_m, Fold fold)
    : order_(points_m.size()), points_m_(points_m.size()) {
  const Grid grid = MakeGrid(points_m, fold);
  std::vector<std::uint32_t> cells(points_m.size());
  std::vector<std::uint32_t> ends(grid.size() + 1, 0);
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    cells[i] = grid.CellOf(Folded(points_m[i], fold));
    ++ends[cells[i] + 1];
  }
  for (std::size_t c = 1; c < ends.size(); ++c) ends[c] += ends[c - 1];
  // ends[c] is where cell c begins; after placing its points it is where the cell ends.
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const std::uint32_t slot = ends[cells[i]]++;
    order_[slot] = static_cast<std::uint32_t>(i);
    points_m_[slot] = Folded(points_m[i], fold);
  }
  MakeBlocks(ends);
}

void PointGrid::MakeBlocks(const std::vector<std::uint32_t>& cell_ends) {
  for (std::vector<float>* axis : {&x_m_, &y_m_, &z_m_}) axis->reserve(size());
  std::uint32_t begin = 0;
  for (const std::uint32_t cell_end : cell_ends) {
    while (begin < cell_end) {
      Block block{begin, std::min(cell_end, begin + kMaxBlock), {}, 0.0};
      Eigen::Array3d low = point(begin);
      Eigen::Array3d high = low;
      for (std::uint32_t i = begin; i < block.end; ++i) {
        low = low.min(point(i).array());
        high = high.max(point(i).array());
      }
      block.center = 0.5 * (low + high);
      for (std::uint32_t i = begin; i < block.end; ++i) {
        const Eigen::Vector3d local = point(i) - block.center;
        block.reach = std::max(block.reach, local.norm());
        x_m_.push_back(static_cast<float>(local.x()));
        y_m_.push_back(static_cast<float>(local.y()));
        z_m_.push_back(static_cast<float>(local.z()));
      }
      begin = block.end;
      blocks_.push_back(block);
    }
  }
}

UnionDistances PointGrid::DistancesTo(const std::vector<TaperedCapsule>& solids,
                                      double ignore_below_m, const ThreadPool& pool) const {
  UnionDistances result;
  result.distance_m.assign(size(), std::numeric_limits<double>::infinity());
  result.solid.assign(size(), -1);
  if (solids.empty()) return result;
  const SolidTable table(solids);
  pool.ForChunks(blocks_.size(), kBlocksPerChunk, [&](std::size_t first, std::size_t last) {
    std::vector<double> at_center(solids.size());
    std::array<float, kMaxBlock> best{};
    for (std::size_t b = first; b < last; ++b) {
      const Block& block = blocks_[b];
      const int count = static_cast<int>(block.end - block.begin);
      const AtCenter at(table, block.center, at_center);
      double* const distances = result.distance_m.data() + block.begin;
      std::int32_t* const index = result.solid.data() + block.begin;
      if (at.least_m + block.reach < ignore_below_m) {
        std::fill_n(distances, count, at.least_m + block.reach);
        std::fill_n(index, count, static_cast<std::int32_t>(at.nearest));
        continue;
      }
      best.fill(std::numeric_limits<float>::infinity());
      for (std::size_t k = 0; k < solids.size(); ++k) {
        // Neither this solid nor the nearest at the centre can gain more than the block's reach.
        if (at_center[k] > at.least_m + 2.0 * block.reach) continue;
        LowerBlock(block, table.kernel(k), static_cast<std::int32_t>(k), best.data(), index);
      }
      std::copy_n(best.begin(), count, distances);
    }
  });
  return result;
}

void PointGrid::Lower(const std::vector<TaperedCapsule>& solids,
                      std::span<const std::int32_t> grown, UnionDistances& distances,
                      const ThreadPool& pool) const {
  std::vector<TaperedCapsule> its_solids;
  for (const std::int32_t k : grown) its_solids.push_back(solids[k]);
  const SolidTable table(its_solids);
  pool.ForChunks(blocks_.size(), kBlocksPerChunk, [&](std::size_t first, std::size_t last) {
    std::vector<double> at_center(grown.size());
    std::array<float, kMaxBlock> best{};
    for (std::size_t b = first; b < last; ++b) {
      const Block& block = blocks_[b];
      const int count = static_cast<int>(block.end - block.begin);
      double* const distance_m = distances.distance_m.data() + block.begin;
      const double furthest_m = *std::max_element(distance_m, distance_m + count);
      table.DistancesFrom(block.center, at_center);
      std::copy_n(distance_m, count, best.begin());
      for (std::size_t k = 0; k < grown.size(); ++k) {
        if (at_center[k] - block.reach > furthest_m) continue;
        LowerBlock(block, table.kernel(k), grown[k], best.data(),
                   distances.solid.data() + block.begin);
      }
      std::copy_n(best.begin(), count, distance_m);
    }
  });
}

void PointGrid::LowerBlock(const Block& block, const DistanceKernel& solid, std::int32_t own_index,
                           float* best, std::int32_t* index) const {
  const FloatKernel kernel = KernelAround(solid, block.center);
  const float* const x = x_m_.data() + block.begin;
  const float* const y = y_m_.data() + block.begin;
  const float* const z = z_m_.data() + block.begin;
  const int count = static_cast<int>(block.end - block.begin);
  for (int i = 0; i < count; ++i) {
    const float distance = kernel.SignedDistance(x[i], y[i], z[i]);
    index[i] = distance < best[i] ? own_index : index[i];
    best[i] = distance < best[i] ? distance : best[i];
  }
}

void PointGrid::BlockDistances(const Block& block, const TaperedCapsule& solid,
                               float* distance_m) const {
  const FloatKernel kernel = KernelAround(DistanceKernel(solid), block.center);
  const float* const x = x_m_.data() + block.begin;
  const float* const y = y_m_.data() + block.begin;
  const float* const z = z_m_.data() + block.begin;
  const int count = static_cast<int>(block.end - block.begin);
  for (int i = 0; i < count; ++i) distance_m[i] = kernel.SignedDistance(x[i], y[i], z[i]);
}

}  // namespace capfit::tighten
