#include "core/mesh/overlap.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/mesh/column_caster.h"

namespace capfit::mesh {
namespace {

constexpr double kColumnsAlongLongest = 128.0;
// A bound on time and memory: columns through the boxes of all triangles together. A body of
// 200,000 triangles has about 100,000.
constexpr double kMostLooks = 8e6;
// Where in its cell a column runs: not through the corners of regular grids.
constexpr double kPlaceInCell = 0.4713;

std::vector<double> Places(double low, double high, double cell) {
  std::vector<double> places;
  const auto count = 1 + static_cast<std::size_t>((high - low) / cell);
  for (std::size_t i = 0; i < count; ++i) {
    places.push_back(low + (static_cast<double>(i) + kPlaceInCell) * cell);
  }
  return places;
}

double Looks(const BodyMesh& mesh, const ColumnCaster::Axes& axes, double cell) {
  double looks = 0.0;
  for (const Triangle& t : mesh.triangles()) {
    double own = 1.0;
    for (const int axis : {axes[0], axes[1]}) {
      const double a = mesh.vertices()[t[0]][axis];
      const double b = mesh.vertices()[t[1]][axis];
      const double c = mesh.vertices()[t[2]][axis];
      own *= (std::max({a, b, c}) - std::min({a, b, c})) / cell;
    }
    looks += own;
  }
  return looks;
}

}  // namespace

Overlap MeasureOverlap(const BodyMesh& mesh) {
  int along = 0;
  (mesh.box_max() - mesh.box_min()).maxCoeff(&along);
  const ColumnCaster::Axes axes = {(along + 1) % 3, (along + 2) % 3, along};
  const double cell = (mesh.box_max() - mesh.box_min())[along] / kColumnsAlongLongest;
  if (!(cell > 0.0) || Looks(mesh, axes, cell) > kMostLooks) return {};  // a point has no volume
  ColumnGrid grid;
  grid.x = Places(mesh.box_min()[axes[0]], mesh.box_max()[axes[0]], cell);
  grid.y = Places(mesh.box_min()[axes[1]], mesh.box_max()[axes[1]], cell);
  grid.low_x = mesh.box_min()[axes[0]];
  grid.low_y = mesh.box_min()[axes[1]];
  grid.step_x = grid.step_y = cell;

  Overlap result;
  const ColumnCaster caster(mesh.vertices(), mesh.triangles(), grid, axes, ThreadPool(1));
  for (std::size_t row = 0; row < grid.y.size(); ++row) {
    int winding = 0;  // back at 0 behind the last crossing of each column
    const ColumnCrossing* last = nullptr;
    const std::vector<ColumnCrossing> crossings = caster.Row(row);
    for (const ColumnCrossing& crossing : crossings) {
      if (winding >= 2) {
        const double volume = (crossing.along - last->along) * grid.cell_area();
        Eigen::Vector3d middle;
        middle[axes[0]] = grid.x[crossing.column];
        middle[axes[1]] = grid.y[row];
        middle[along] = 0.5 * (crossing.along + last->along);
        result.volume += volume;
        result.middle += volume * middle;
      }
      winding += crossing.turn;
      last = &crossing;
    }
  }
  if (result.volume > 0.0) result.middle /= result.volume;
  return result;
}

}  // namespace capfit::mesh
