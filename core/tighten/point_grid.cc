#include "core/tighten/point_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/tighten/distance_kernel.h"

namespace capfit::tighten {
namespace {

using geometry::TaperedCapsule;

// Points of a block on average. Fewer cull better, more fill the vector loop better; between 24 and
// 96 the time changes little.
constexpr double kPointsPerBlock = 48.0;
constexpr std::uint32_t kMaxBlock = 128;
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
      at[static_cast<std::size_t>(k)] = std::min(i, counts[static_cast<std::size_t>(k)] - 1);
    }
    return (at[2] * counts[1] + at[1]) * counts[0] + at[0];
  }
  std::size_t size() const { return std::size_t{counts[0]} * counts[1] * counts[2]; }
};

Grid MakeGrid(std::span<const Eigen::Vector3d> points) {
  Grid grid;
  if (points.empty()) return grid;
  Eigen::Array3d low = points[0];
  Eigen::Array3d high = points[0];
  for (const Eigen::Vector3d& p : points) {
    low = low.min(p.array());
    high = high.max(p.array());
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
    grid.counts[static_cast<std::size_t>(k)] =
        static_cast<std::uint32_t>(std::max(1.0, std::ceil(extent[k] / grid.cell)));
  }
  return grid;
}

// Lowers `best` and sets `index` where `kernel` is nearer. Free of branches, so that it vectorises.
void Lower(const DistanceKernel& kernel, double own_index, const double* x, const double* y,
           const double* z, int count, double* best, double* index) {
  for (int i = 0; i < count; ++i) {
    const double distance = kernel.SignedDistance(x[i], y[i], z[i]);
    index[i] = distance < best[i] ? own_index : index[i];
    best[i] = distance < best[i] ? distance : best[i];
  }
}

}  // namespace

PointGrid::PointGrid(std::span<const Eigen::Vector3d> points_m)
    : order_(points_m.size()), x_(points_m.size()), y_(points_m.size()), z_(points_m.size()) {
  const Grid grid = MakeGrid(points_m);
  std::vector<std::uint32_t> cells(points_m.size());
  std::vector<std::uint32_t> ends(grid.size() + 1, 0);
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    cells[i] = grid.CellOf(points_m[i]);
    ++ends[cells[i] + 1];
  }
  for (std::size_t c = 1; c < ends.size(); ++c) ends[c] += ends[c - 1];
  // ends[c] is where cell c begins; after placing its points it is where the cell ends.
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const std::uint32_t slot = ends[cells[i]]++;
    order_[slot] = static_cast<std::uint32_t>(i);
    x_[slot] = points_m[i].x();
    y_[slot] = points_m[i].y();
    z_[slot] = points_m[i].z();
  }
  MakeBlocks(ends);
}

void PointGrid::MakeBlocks(const std::vector<std::uint32_t>& cell_ends) {
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
        block.reach = std::max(block.reach, (point(i) - block.center).norm());
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
  const std::vector<DistanceKernel> kernels(solids.begin(), solids.end());
  pool.ForChunks(blocks_.size(), 32, [&](std::size_t first, std::size_t last) {
    std::vector<double> at_center(solids.size());
    std::array<double, kMaxBlock> index{};
    for (std::size_t b = first; b < last; ++b) {
      const Block& block = blocks_[b];
      const int count = static_cast<int>(block.end - block.begin);
      double least = std::numeric_limits<double>::infinity();
      std::size_t nearest = 0;
      for (std::size_t k = 0; k < solids.size(); ++k) {
        at_center[k] = solids[k].SignedDistance(block.center);
        if (at_center[k] < least) {
          least = at_center[k];
          nearest = k;
        }
      }
      double* const best = result.distance_m.data() + block.begin;
      if (least + block.reach < ignore_below_m) {
        std::fill_n(best, count, least + block.reach);
        std::fill_n(result.solid.begin() + block.begin, count, static_cast<std::int32_t>(nearest));
        continue;
      }
      index.fill(-1.0);
      for (std::size_t k = 0; k < solids.size(); ++k) {
        // Neither this solid nor the nearest at the centre can gain more than the block's reach.
        if (at_center[k] > least + 2.0 * block.reach) continue;
        Lower(kernels[k], static_cast<double>(k), x_.data() + block.begin, y_.data() + block.begin,
              z_.data() + block.begin, count, best, index.data());
      }
      for (int i = 0; i < count; ++i) {
        result.solid[block.begin + static_cast<std::uint32_t>(i)] =
            static_cast<std::int32_t>(index[static_cast<std::size_t>(i)]);
      }
    }
  });
  return result;
}

}  // namespace capfit::tighten
