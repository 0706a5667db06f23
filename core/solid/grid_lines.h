// Where the lines of a grid enter and leave the union of shells.
#ifndef CAPFIT_CORE_SOLID_GRID_LINES_H_
#define CAPFIT_CORE_SOLID_GRID_LINES_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/solid/node_grid.h"
#include "core/solid/shells.h"

namespace capfit::solid {

// A line passes the boundary of the union.
struct Passage {
  double along = 0.0;  // on the grid's axis that the line runs along
  std::uint32_t triangle = 0;
};

// The lines along one of the grid's axes. Row r, column c: along u it is (w, v), along v (u, w),
// along w (v, u). The passages of a line are in order; they come in pairs, in and out.
struct GridLines {
  struct Row {
    std::vector<Passage> passages;
    std::vector<std::uint32_t> begin;  // by column, one more than columns
  };
  std::vector<Row> rows;

  [[nodiscard]] std::span<const Passage> Line(std::size_t row, std::size_t column) const {
    const Row& r = rows[row];
    return std::span(r.passages).subspan(r.begin[column], r.begin[column + 1] - r.begin[column]);
  }
};

// `points`: those that the shells' triangles mean, as u, v, w. A point is inside the union where
// the winding number of any single shell is above 0. Rows in parallel; O(triangles + passages).
[[nodiscard]] GridLines CastGridLines(std::span<const Eigen::Vector3d> points, const Shells& shells,
                                      const NodeGrid& grid, int axis, const ThreadPool& pool);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_GRID_LINES_H_
