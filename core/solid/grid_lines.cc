#include "core/solid/grid_lines.h"

#include <array>

#include "core/mesh/column_caster.h"

namespace capfit::solid {
namespace {

mesh::ColumnGrid ColumnsAcross(const NodeGrid& grid, int axis) {
  const int x = (axis + 1) % 3;
  const int y = (axis + 2) % 3;
  mesh::ColumnGrid columns;
  columns.step_x = columns.step_y = grid.step;
  columns.low_x = grid.low[x] - 0.5 * grid.step;
  columns.low_y = grid.low[y] - 0.5 * grid.step;
  for (std::uint32_t i = 0; i < grid.size[x]; ++i) columns.x.push_back(grid.low[x] + i * grid.step);
  for (std::uint32_t i = 0; i < grid.size[y]; ++i) columns.y.push_back(grid.low[y] + i * grid.step);
  return columns;
}

// Follows one line through the shells.
class UnionWalker {
 public:
  explicit UnionWalker(const Shells& shells) : shells_(shells), winding_(shells.volumes.size()) {}

  void Start() {
    for (const std::uint32_t shell : touched_) winding_[shell] = 0;
    touched_.clear();
    inside_ = 0;
  }

  // Whether the line enters or leaves the union here.
  bool Pass(const mesh::ColumnCrossing& crossing) {
    const std::uint32_t shell = shells_.shell_of_triangle[crossing.triangle];
    const std::int32_t before = winding_[shell];
    const std::int32_t after = winding_[shell] += crossing.turn;
    touched_.push_back(shell);
    if ((before > 0) == (after > 0)) return false;
    return after > 0 ? inside_++ == 0 : --inside_ == 0;
  }

 private:
  const Shells& shells_;
  std::vector<std::int32_t> winding_;  // of each shell
  std::vector<std::uint32_t> touched_;
  int inside_ = 0;  // shells
};

// Rows that share a walker, so that a file of many shells does not need one for each row.
constexpr std::size_t kRowsPerWalker = 16;

}  // namespace

GridLines CastGridLines(std::span<const Eigen::Vector3d> points, const Shells& shells,
                        const NodeGrid& grid, int axis, const ThreadPool& pool) {
  const mesh::ColumnGrid columns = ColumnsAcross(grid, axis);
  const mesh::ColumnCaster::Axes axes = {(axis + 1) % 3, (axis + 2) % 3, axis};
  const mesh::ColumnCaster caster(points, shells.triangles, columns, axes, pool);
  GridLines lines;
  lines.rows.resize(columns.y.size());
  pool.ForChunks(columns.y.size(), kRowsPerWalker, [&](std::size_t begin, std::size_t end) {
    UnionWalker walker(shells);
    for (std::size_t r = begin; r < end; ++r) {
      GridLines::Row& row = lines.rows[r];
      row.begin.assign(columns.x.size() + 1, 0);
      std::uint32_t column = 0xFFFFFFFFu;
      for (const mesh::ColumnCrossing& crossing : caster.Row(r)) {
        if (crossing.column != column) walker.Start();
        column = crossing.column;
        if (!walker.Pass(crossing)) continue;
        row.passages.push_back({crossing.along, crossing.triangle});
        ++row.begin[column + 1];
      }
      for (std::size_t c = 0; c < columns.x.size(); ++c) row.begin[c + 1] += row.begin[c];
    }
  });
  return lines;
}

}  // namespace capfit::solid
