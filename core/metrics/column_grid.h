// Columns along z on which volumes are cut exactly.
#ifndef CAPFIT_CORE_METRICS_COLUMN_GRID_H_
#define CAPFIT_CORE_METRICS_COLUMN_GRID_H_

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/backlog.h"
#include "core/base/thread_pool.h"
#include "core/geometry/tapered_capsule.h"
#include "core/mesh/column_caster.h"
#include "core/metrics/fitted_surface.h"

namespace capfit::metrics {

using mesh::ColumnGrid;

// Covers `box` with columns along z, symmetric about x = 0, the box widened for it. Each column
// lies near the middle of its cell, a little off by chance, the same for a whole row or column of
// them. `columns` is rounded up to an even number.
[[nodiscard]] ColumnGrid MakeColumnGrid(const Eigen::AlignedBox3d& box, int columns);

// Cells that a wider grid has around a grid's own.
struct GridMargin {
  std::size_t beside = 0;  // columns on either side
  std::size_t below = 0;   // rows
};

struct WiderGrid {
  ColumnGrid grid;
  GridMargin margin;
};

// The grid, with as many more cells of its size around it as `box` takes: what its own columns have
// met still holds. Nothing where either axis would get more than twice its cells.
[[nodiscard]] std::optional<WiderGrid> Widen(const ColumnGrid& grid,
                                             const Eigen::AlignedBox3d& box);

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

// What a surface that cuts through itself encloses twice or more, counted once.
struct Overlap {
  double volume_m3 = 0.0;
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();  // of that volume
};

// Where the columns run through a body.
class BodyRows {
 public:
  // Keeps a reference to `surface`, whose body and fitted part are closed. Triangles in parallel.
  BodyRows(const FittedSurface& surface, const ColumnGrid& grid, const ThreadPool& pool);
  // The same, but empty until the backlog is done, which makes `surface` and `grid` before; so long
  // all three stay where they are.
  BodyRows(const FittedSurface& surface, const ColumnGrid& grid, Backlog& backlog);
  BodyRows(const BodyRows&) = delete;
  BodyRows& operator=(const BodyRows&) = delete;

  // Where the row's columns have a winding number other than 0. Each half of such an interval has
  // the part of the triangle at its end for a label.
  struct Cuts {
    RowIntervals body;
    std::optional<RowIntervals> some;  // of the body's parts; nothing where all are fitted
    [[nodiscard]] const RowIntervals& fitted() const { return some ? *some : body; }
    PartNumbers fitted_flux{};  // as FittedSurface::flux, in lengths
  };
  // `row` and the columns of the result are those of the grid, or of one with a margin around it.
  [[nodiscard]] Cuts Cut(std::size_t row, const GridMargin& margin = {}) const;

  // Of the body: what is thinner than the columns are apart is missed or not by chance.
  [[nodiscard]] Overlap MeasureOverlap() const;

 private:
  // A row's overlap in lengths along its columns.
  struct OverlapSums {
    double length_m = 0.0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // lengths times their middles
  };

  void Cast(Backlog& backlog);
  [[nodiscard]] OverlapSums OverlapIn(std::size_t row) const;

  const FittedSurface& surface_;
  const ColumnGrid& grid_;
  std::optional<mesh::ColumnCaster> caster_;                  // until the rows are sorted
  std::vector<std::vector<mesh::ColumnCrossing>> crossings_;  // by row, sorted
  std::vector<OverlapSums> overlaps_;                         // by row
};

// Where the columns run through the union of solids. Half of them tell of all where both the solids
// and the columns are their own mirror image.
class SolidRows {
 public:
  // Keeps a reference to `grid`.
  SolidRows(std::span<const geometry::TaperedCapsule> solids, const ColumnGrid& grid);
  ~SolidRows();
  SolidRows(const SolidRows&) = delete;
  SolidRows& operator=(const SolidRows&) = delete;

  // Where the row's columns run inside any of the solids. The label is the solid's index: where
  // several overlap, that of the one that the column entered first.
  [[nodiscard]] RowIntervals Cut(std::size_t row) const;

 private:
  // A solid as the loop over the columns of a row wants it.
  struct Shape;
  // In the first `columns` of the row.
  void CutOne(std::size_t index, std::size_t row, std::size_t columns,
              std::vector<RowIntervals::Piece>& pieces) const;
  void AddImages(std::vector<RowIntervals::Piece>& pieces) const;

  const ColumnGrid& grid_;
  std::vector<Shape> shapes_;
  std::vector<std::int32_t> images_;  // of each solid; empty where not all has an image
};

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_COLUMN_GRID_H_
