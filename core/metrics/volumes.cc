#include "core/metrics/volumes.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/metrics/column_grid.h"

namespace capfit::metrics {
namespace {

// Rows that one task takes together.
constexpr std::size_t kRowsPerChunk = 4;

Eigen::AlignedBox3d BoxOf(const geometry::TaperedCapsule& solid) {
  Eigen::AlignedBox3d box;
  for (const geometry::Sphere& end : {solid.a(), solid.b()}) {
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(end.radius_m);
    box.extend(Eigen::Vector3d(end.center_m - reach));
    box.extend(Eigen::Vector3d(end.center_m + reach));
  }
  return box;
}

// Lengths summed over the columns of a row.
Volumes RowLengths(const RowIntervals& body, const RowIntervals& fitted, const RowIntervals& set,
                   std::size_t columns) {
  Volumes sum;
  sum.fitted = fitted.Length();
  sum.set = set.Length();
  double in_body = 0.0;
  double in_fitted = 0.0;
  double in_image = 0.0;
  for (std::size_t i = 0; i < columns; ++i) {
    if (set.Column(i).empty()) continue;
    in_body += CommonLength(body.Column(i), set.Column(i));
    in_fitted += CommonLength(fitted.Column(i), set.Column(i));
    in_image += CommonLength(set.Column(i), set.Column(columns - 1 - i));
  }
  // Rounding must not leave a share of -1e-17.
  sum.outside = std::max(0.0, sum.set - in_body);
  sum.uncovered = std::max(0.0, sum.fitted - in_fitted);
  sum.mirror_xor = 2.0 * std::max(0.0, sum.set - in_image);
  return sum;
}

}  // namespace

Volumes MeasureVolumes(const mesh::BodyMesh& mesh, const FittedSurface& fitted,
                       std::span<const geometry::TaperedCapsule> solids, int columns,
                       const ThreadPool& pool) {
  Eigen::AlignedBox3d box(mesh.box_min(), mesh.box_max());
  for (const geometry::TaperedCapsule& solid : solids) box.extend(BoxOf(solid));
  const ColumnGrid grid = MakeColumnGrid(box, columns);
  const TriangleRows body_rows(mesh.vertices(), mesh.triangles(), grid);
  std::optional<TriangleRows> fitted_rows;
  if (!fitted.is_whole) fitted_rows.emplace(fitted.points_m, fitted.triangles, grid);

  std::vector<Volumes> by_row(grid.y.size());
  pool.ForChunks(grid.y.size(), kRowsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const RowIntervals body = body_rows.Cut(row);
      const RowIntervals set = CutSolids(solids, grid, row);
      by_row[row] = fitted_rows ? RowLengths(body, fitted_rows->Cut(row), set, grid.x.size())
                                : RowLengths(body, body, set, grid.x.size());
    }
  });
  Volumes total;
  for (const Volumes& row : by_row) {
    total.fitted += grid.cell_area() * row.fitted;
    total.set += grid.cell_area() * row.set;
    total.outside += grid.cell_area() * row.outside;
    total.uncovered += grid.cell_area() * row.uncovered;
    total.mirror_xor += grid.cell_area() * row.mirror_xor;
  }
  return total;
}

}  // namespace capfit::metrics
