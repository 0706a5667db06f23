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

// What one row of columns runs through: disjoint intervals of z, rising, for each column. Each has
// a label; where it changes within a body or a set, two intervals abut.
class RowIntervals {
 public:
  struct Piece {
    std::uint32_t column = 0;
    geometry::Interval interval;
    std::int32_t label = 0;
  };
  // `pieces`: disjoint, sorted by column, then by place.
  RowIntervals(const std::vector<Piece>& pieces, std::size_t columns);

  [[nodiscard]] std::span<const geometry::Interval> Column(std::size_t column) const {
    return std::span(intervals_).subspan(begin_[column], begin_[column + 1] - begin_[column]);
  }
  // The labels of Column(column), in the same order.
  [[nodiscard]] std::span<const std::int32_t> Labels(std::size_t column) const {
    return std::span(labels_).subspan(begin_[column], begin_[column + 1] - begin_[column]);
  }
  [[nodiscard]] double Length() const;

 private:
  std::vector<geometry::Interval> intervals_;
  std::vector<std::int32_t> labels_;
  std::vector<std::uint32_t> begin_;
};

// Length of what lies in both lists of disjoint rising intervals.
[[nodiscard]] double CommonLength(std::span<const geometry::Interval> a,
                                  std::span<const geometry::Interval> b);

// A body and the part of it that is fitted, as one list of triangles.
struct BodyTriangles {
  std::vector<mesh::Triangle> triangles;
  std::vector<std::uint8_t> labels;  // one for each triangle
  // The body's surface are the triangles [0, body_end), the fitted one [fitted_begin, all).
  std::size_t body_end = 0;
  std::size_t fitted_begin = 0;
};

// Which triangles each row meets.
class TriangleRows {
 public:
  // Two closed surfaces; keeps references. O(triangles + meetings).
  TriangleRows(std::span<const Eigen::Vector3d> points_m, const BodyTriangles& body,
               const ColumnGrid& grid);

  // Where the row's columns have a winding number other than 0. Watertight: both triangles at an
  // edge see the same crossing, so that no column slips between them. Each half of such an
  // interval has the label of the triangle at its end.
  struct Cuts {
    RowIntervals body;
    RowIntervals fitted;
  };
  [[nodiscard]] Cuts Cut(std::size_t row) const;

 private:
  std::span<const Eigen::Vector3d> points_;
  const BodyTriangles& body_;
  const ColumnGrid& grid_;
  std::vector<std::uint32_t> begin_;  // by row
  std::vector<std::uint32_t> met_;
};

// Where the row's columns run inside any of the solids. The label is the solid's index: where
// several overlap, that of the one that the column entered first.
[[nodiscard]] RowIntervals CutSolids(std::span<const geometry::TaperedCapsule> solids,
                                     const ColumnGrid& grid, std::size_t row);

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_COLUMN_GRID_H_
