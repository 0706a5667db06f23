// Columns along z on which volumes are cut exactly.
#ifndef CAPFIT_CORE_METRICS_COLUMN_GRID_H_
#define CAPFIT_CORE_METRICS_COLUMN_GRID_H_

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/tapered_capsule.h"
#include "core/mesh/body_mesh.h"

namespace capfit::metrics {

// Rows along y of columns along x: columns through (x[i], y[j]), each standing for the same area.
// Each lies near the middle of its cell, a little off by chance, the same for a whole row or column
// of them. x is mirror-symmetric about 0.
struct ColumnGrid {
  std::vector<double> x;  // rising
  std::vector<double> y;  // rising
  double low_x = 0.0;     // lower edge of the first cell
  double low_y = 0.0;
  double step_x = 1.0;
  double step_y = 1.0;

  [[nodiscard]] double cell_area() const { return step_x * step_y; }
  // The first column with x[i] >= at (or row with y[j] >= at); size() when there is none.
  [[nodiscard]] std::size_t FirstColumn(double at) const;
  [[nodiscard]] std::size_t FirstRow(double at) const;
};

// Covers `box`, widened to be symmetric about x = 0. `columns` is rounded up to an even number.
[[nodiscard]] ColumnGrid MakeColumnGrid(const Eigen::AlignedBox3d& box, int columns);

// What one row of columns runs through: disjoint intervals of z, rising, for each column.
class RowIntervals {
 public:
  struct Piece {
    std::uint32_t column = 0;
    geometry::Interval interval;
  };
  // `pieces`: disjoint, sorted by column, then by place.
  RowIntervals(const std::vector<Piece>& pieces, std::size_t columns);

  [[nodiscard]] std::span<const geometry::Interval> Column(std::size_t column) const {
    return std::span(intervals_).subspan(begin_[column], begin_[column + 1] - begin_[column]);
  }
  [[nodiscard]] double Length() const;

 private:
  std::vector<geometry::Interval> intervals_;
  std::vector<std::uint32_t> begin_;
};

// Length of what lies in both lists of disjoint rising intervals.
[[nodiscard]] double CommonLength(std::span<const geometry::Interval> a,
                                  std::span<const geometry::Interval> b);

// Which triangles each row meets.
class TriangleRows {
 public:
  // Closed surface; keeps references. O(triangles + meetings).
  TriangleRows(std::span<const Eigen::Vector3d> points_m, std::span<const mesh::Triangle> triangles,
               const ColumnGrid& grid);

  // Where the row's columns have a winding number other than 0. Watertight: both triangles at an
  // edge see the same crossing, so that no column slips between them.
  [[nodiscard]] RowIntervals Cut(std::size_t row) const;

 private:
  std::span<const Eigen::Vector3d> points_;
  std::span<const mesh::Triangle> triangles_;
  const ColumnGrid& grid_;
  std::vector<std::uint32_t> begin_;  // by row
  std::vector<std::uint32_t> met_;
};

// Where the row's columns run inside any of the solids.
[[nodiscard]] RowIntervals CutSolids(std::span<const geometry::TaperedCapsule> solids,
                                     const ColumnGrid& grid, std::size_t row);

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_COLUMN_GRID_H_
