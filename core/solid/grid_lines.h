// Where the lines of a grid enter and leave the union of shells.
#ifndef CAPFIT_CORE_SOLID_GRID_LINES_H_
#define CAPFIT_CORE_SOLID_GRID_LINES_H_

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
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

  [[nodiscard]] std::size_t columns() const { return rows.front().begin.size() - 1; }

  [[nodiscard]] std::span<const Passage> Line(std::size_t row, std::size_t column) const {
    const Row& r = rows[row];
    return std::span(r.passages).subspan(r.begin[column], r.begin[column + 1] - r.begin[column]);
  }
};

// The first node at or after a place on a line; within the outermost nodes.
[[nodiscard]] inline std::uint32_t FirstNodeAt(const NodeGrid& grid, int axis, double along) {
  const double node = std::ceil((along - grid.low[axis]) / grid.step);
  return static_cast<std::uint32_t>(std::clamp(node, 1.0, grid.size[axis] - 1.0));
}

// Node `along` of the line in this row and column.
[[nodiscard]] inline GridNode NodeOnLine(int axis, std::size_t row, std::size_t column,
                                         std::uint32_t along) {
  const auto r = static_cast<std::uint32_t>(row);
  const auto c = static_cast<std::uint32_t>(column);
  if (axis == 0) return {along, c, r};
  if (axis == 1) return {r, along, c};
  return {c, r, along};
}

// Whether the triangles of two passages look at each other, or away from each other, across the
// line rather than along it.
[[nodiscard]] inline bool AreOpposed(const Eigen::Vector3f& one, const Eigen::Vector3f& other,
                                     int axis, float least_cosine) {
  return std::min(std::abs(one[axis]), std::abs(other[axis])) > least_cosine &&
         one[axis] * other[axis] < 0.0f;
}

// `points`: those that the shells' triangles mean, as u, v, w. A point is inside the union where
// the winding number of any single shell is above 0. Rows in parallel; O(triangles + passages).
[[nodiscard]] GridLines CastGridLines(std::span<const Eigen::Vector3d> points, const Shells& shells,
                                      const NodeGrid& grid, int axis, const ThreadPool& pool);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_GRID_LINES_H_
