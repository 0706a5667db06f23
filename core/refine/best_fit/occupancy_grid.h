// How much of each small cell the body fills: the inside/outside test of the best fit.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_OCCUPANCY_GRID_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_OCCUPANCY_GRID_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/tighten/full_cells.h"

namespace capfit::refine {

// Cells of edge length cell_m over the body's box. A folded grid holds the mean of both halves of
// the body at x >= 0; two layers of cells lie below x = 0, so that values near the plane
// interpolate.
struct OccupancyGrid {
  static constexpr int kRegister = 8;  // nz is a multiple of it
  static constexpr int kFull = 254;    // stands for a full cell

  float cell_m = 0.0f;
  int nx = 0, ny = 0, nz = 0;
  Eigen::Vector3f origin_m = Eigen::Vector3f::Zero();  // lower corner
  bool folded = false;
  int first_x = 0;  // the first layer at x >= 0 of a folded grid
  // For each cell, z fastest, then x: the share inside the body, and the share inside the parts to
  // fit (at most the former; empty where that is the whole body). In kFull-ths: much is read.
  std::vector<std::uint8_t> inside;
  std::vector<std::uint8_t> fitted;
  // What it costs to fill the cell, 1 - fitted - inside, from 0 for -1 to kFull for +1; in the
  // higher bytes that of the next cells along z, y, and both: read at random, eight points at a
  // time.
  std::vector<std::uint32_t> cost;
  // Volume of the parts to fit, both halves.
  double volume_m3 = 0.0;

  [[nodiscard]] const std::vector<std::uint8_t>& fitted_shares() const {
    return fitted.empty() ? inside : fitted;
  }
  [[nodiscard]] std::size_t ColumnOf(int ix, int iy) const {
    return (std::size_t{1} * nx * iy + ix) * nz;
  }
};

// The grid of the body with its selected parts. Each cell is cut by four columns along z, exactly
// along them. O(triangles + cells): about 5 ms for 64k triangles and 8 mm on one thread.
[[nodiscard]] OccupancyGrid MakeOccupancyGrid(const body::Body& body,
                                              const body::PartSelection& parts, double cell_m,
                                              bool folded, const ThreadPool& pool);

// The grid with cells twice as large, each the mean of eight; nothing for SampleCost.
[[nodiscard]] OccupancyGrid CoarserGrid(const OccupancyGrid& grid);

// The cells that the body fills as a whole, for what must not leave them empty.
[[nodiscard]] tighten::FullCells FullCellsOf(const OccupancyGrid& grid);

// What it costs to fill space, at `count` points: +1 in empty space, -1 inside the parts to fit, 0
// inside the rest of the body; trilinear between cell centres, +1 off the grid. To 1/127.
void SampleCost(const OccupancyGrid& grid, const float* x, const float* y, const float* z,
                int count, float* cost);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_OCCUPANCY_GRID_H_
