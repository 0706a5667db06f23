#include "core/refine/best_fit/occupancy_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/mesh/column_caster.h"
#include "core/refine/graph/cone.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr int kColumnsPerCell = 2;  // in x and in y
// Columns miss the vertices of regular meshes when they do not run through round coordinates.
constexpr double kColumnShiftX = 0.5123;
constexpr double kColumnShiftY = 0.4871;
constexpr int kMargin = 2;  // cells around the body
constexpr float kFullCost = 127.0f;

OccupancyGrid EmptyGrid(const mesh::BodyMesh& mesh, double cell_m, bool folded) {
  OccupancyGrid grid;
  grid.cell_m = static_cast<float>(cell_m);
  grid.folded = folded;
  grid.first_x = folded ? kMargin : 0;
  const double half_x = std::max(mesh.box_max().x(), -mesh.box_min().x());
  const Vec3 low(folded ? 0.0 : mesh.box_min().x(), mesh.box_min().y(), mesh.box_min().z());
  const Vec3 high(folded ? half_x : mesh.box_max().x(), mesh.box_max().y(), mesh.box_max().z());
  const Vec3 first = ((low / cell_m).array().floor() - kMargin).matrix();
  const Vec3 count = (high / cell_m - first).array().ceil() + kMargin;
  grid.origin_m = (first * cell_m).cast<float>();
  grid.nx = static_cast<int>(count.x());
  grid.ny = static_cast<int>(count.y());
  grid.nz = static_cast<int>(count.z());
  grid.inside.assign(U(grid.nx) * U(grid.ny) * U(grid.nz), 0.0f);
  return grid;
}

// Columns through the cells, in x and in y; `side` -1: mirrored in the plane x = 0.
mesh::ColumnGrid ColumnsOf(const OccupancyGrid& grid, double side) {
  mesh::ColumnGrid columns;
  columns.step_x = columns.step_y = grid.cell_m / kColumnsPerCell;
  const int count_x = grid.nx * kColumnsPerCell;
  for (int i = 0; i < count_x; ++i) {
    const int at = side > 0.0 ? i : count_x - 1 - i;
    columns.x.push_back(side * (grid.origin_m.x() + (at + kColumnShiftX) * columns.step_x));
  }
  for (int j = 0; j < grid.ny * kColumnsPerCell; ++j) {
    columns.y.push_back(grid.origin_m.y() + (j + kColumnShiftY) * columns.step_y);
  }
  columns.low_x = side > 0.0 ? grid.origin_m.x() : -(grid.origin_m.x() + count_x * columns.step_x);
  columns.low_y = grid.origin_m.y();
  return columns;
}

// Adds signed steps along columns; Finish turns them into shares.
class ColumnFiller {
 public:
  explicit ColumnFiller(OccupancyGrid& grid)
      : grid_(grid), steps_(grid.inside.size(), 0.0f), partial_(grid.inside.size(), 0.0f) {}

  // What lies between where columns enter the body and leave it gains `weight`.
  void Add(const mesh::BodyMesh& mesh, double side, float weight) {
    const mesh::ColumnGrid columns = ColumnsOf(grid_, side);
    const int last = static_cast<int>(columns.x.size()) - 1;
    const mesh::ColumnCaster caster(mesh.vertices(), mesh.triangles(), columns, {0, 1, 2},
                                    ThreadPool(1));
    caster.ForEach([&](const mesh::ColumnCrossing& crossing) {
      const int i = static_cast<int>(crossing.column);
      Cross((side > 0.0 ? i : last - i) / kColumnsPerCell,
            static_cast<int>(crossing.row) / kColumnsPerCell, crossing.along,
            static_cast<float>(-crossing.turn) * weight);
    });
  }

  void Finish() {
    for (std::size_t column = 0; column < U(grid_.nx) * U(grid_.ny); ++column) {
      float above = 0.0f;
      for (int k = grid_.nz - 1; k >= 0; --k) {
        const std::size_t cell = column * U(grid_.nz) + U(k);
        grid_.inside[cell] = std::clamp(above + partial_[cell], 0.0f, 1.0f);
        above += steps_[cell];
      }
    }
  }

 private:
  void Cross(int ix, int iy, double z, float sign) {
    const double height = (z - grid_.origin_m.z()) / grid_.cell_m;
    const int k = static_cast<int>(height);
    if (height < 0.0 || k >= grid_.nz) return;
    const std::size_t cell = grid_.ColumnOf(ix, iy) + U(k);
    const float share = sign / (kColumnsPerCell * kColumnsPerCell);
    partial_[cell] += share * static_cast<float>(height - k);
    steps_[cell] += share;
  }

  OccupancyGrid& grid_;
  std::vector<float> steps_;
  std::vector<float> partial_;
};

void FillInside(const mesh::BodyMesh& mesh, OccupancyGrid& grid) {
  ColumnFiller filler(grid);
  filler.Add(mesh, 1.0, grid.folded ? 0.5f : 1.0f);
  if (grid.folded) filler.Add(mesh, -1.0, 0.5f);
  filler.Finish();
}

// Which of the cells inside the body belong to the selected parts: labels spread inward from the
// vertices, one layer of cells at a time.
std::vector<char> SelectedCells(const body::Body& body, const body::PartSelection& parts,
                                const OccupancyGrid& grid) {
  constexpr char kUnknown = 0, kIn = 1, kOut = 2;
  std::vector<char> label(grid.inside.size(), kUnknown);
  std::vector<std::size_t> front;
  for (std::size_t v = 0; v < body.mesh.vertices().size(); ++v) {
    Vec3 p = body.mesh.vertices()[v];
    if (grid.folded) p.x() = std::abs(p.x());
    const Eigen::Vector3f at = (p.cast<float>() - grid.origin_m) / grid.cell_m;
    const std::size_t cell = grid.ColumnOf(static_cast<int>(at.x()), static_cast<int>(at.y())) +
                             U(static_cast<int>(at.z()));
    if (label[cell] != kUnknown) continue;
    label[cell] = parts.Includes(body::PartOf(body.vertex_segments[v])) ? kIn : kOut;
    front.push_back(cell);
  }
  const std::array<std::ptrdiff_t, 3> strides = {1, grid.nz,
                                                 static_cast<std::ptrdiff_t>(grid.nx) * grid.nz};
  for (std::size_t next = 0; next < front.size(); ++next) {
    for (const std::ptrdiff_t stride : strides) {
      for (const std::ptrdiff_t step : {-stride, stride}) {
        const auto cell = static_cast<std::ptrdiff_t>(front[next]) + step;
        if (cell < 0 || cell >= static_cast<std::ptrdiff_t>(label.size())) continue;
        const auto at = static_cast<std::size_t>(cell);
        if (label[at] != kUnknown || grid.inside[at] == 0.0f) continue;
        label[at] = label[front[next]];
        front.push_back(at);
      }
    }
  }
  for (char& l : label) l = l == kIn;
  return label;
}

void FillCost(OccupancyGrid& grid) {
  grid.cost.resize(grid.inside.size());
  for (std::size_t i = 0; i < grid.cost.size(); ++i) {
    const float cost = 1.0f - grid.fitted[i] - grid.inside[i];
    grid.cost[i] = static_cast<std::int8_t>(std::lround(kFullCost * cost));
  }
}

bool LeavesOutSomething(const body::Body& body, const body::PartSelection& parts) {
  return std::any_of(body.vertex_segments.begin(), body.vertex_segments.end(),
                     [&](body::Segment s) { return !parts.Includes(body::PartOf(s)); });
}

// The cells of `box`, as index ranges [low, high).
struct CellRange {
  std::array<int, 3> low, high;
};

CellRange RangeOf(const OccupancyGrid& grid, const Box& box) {
  CellRange range;
  const std::array<int, 3> count = {grid.nx, grid.ny, grid.nz};
  for (int k = 0; k < 3; ++k) {
    const double origin = grid.origin_m[k];
    range.low[U(k)] = std::clamp(static_cast<int>(std::floor((box[0][k] - origin) / grid.cell_m)),
                                 0, count[U(k)]);
    range.high[U(k)] = std::clamp(static_cast<int>(std::ceil((box[1][k] - origin) / grid.cell_m)),
                                  range.low[U(k)], count[U(k)]);
  }
  range.low[0] = std::max(range.low[0], grid.first_x);
  range.high[0] = std::max(range.high[0], range.low[0]);
  return range;
}

// Share of each cell of a block that the union fills, softened over one cell.
class SoftUnion {
 public:
  SoftUnion(const Vec3& origin_m, std::array<int, 3> count, double cell_m)
      : origin_(origin_m.cast<float>()),
        count_(count),
        cell_(static_cast<float>(cell_m)),
        share_(U(count[0]) * U(count[1]) * U(count[2]), 0.0f) {}

  void Add(const capsule::MirroredSet& graph) {
    for (const Cone& cone : ConesOf(graph)) {
      const geometry::Sphere& a = graph.sphere(cone.node_a);
      const geometry::Sphere& b = graph.sphere(cone.is_sphere ? cone.node_a : cone.node_b);
      std::array<int, 3> low, high;
      bool empty = false;
      for (int k = 0; k < 3; ++k) {
        const double from =
            std::min(a.center_m[k] - a.radius_m, b.center_m[k] - b.radius_m) - origin_[k];
        const double to =
            std::max(a.center_m[k] + a.radius_m, b.center_m[k] + b.radius_m) - origin_[k];
        low[U(k)] = std::max(0, static_cast<int>(std::floor(from / cell_ - 1.0)));
        high[U(k)] = std::min(count_[U(k)], static_cast<int>(std::ceil(to / cell_ + 1.0)));
        empty |= low[U(k)] >= high[U(k)];
      }
      if (!empty) Raise(cone, low, high);
    }
  }

  // Capped at 1.
  [[nodiscard]] float ShareAt(std::size_t cell) const { return std::min(1.0f, share_[cell]); }
  [[nodiscard]] std::size_t RowOf(int ix, int iy) const {
    return (U(iy) * U(count_[0]) + U(ix)) * U(count_[2]);
  }

 private:
  void Raise(const Cone& cone, const std::array<int, 3>& low, const std::array<int, 3>& high) {
    const float inverse = 1.0f / cell_;
    const float z0 = origin_.z() + 0.5f * cell_;
    for (int j = low[1]; j < high[1]; ++j) {
      const float y = origin_.y() + (static_cast<float>(j) + 0.5f) * cell_;
      for (int i = low[0]; i < high[0]; ++i) {
        const float x = origin_.x() + (static_cast<float>(i) + 0.5f) * cell_;
        float* row = share_.data() + RowOf(i, j);
        for (int k = low[2]; k < high[2]; ++k) {
          const float z = z0 + static_cast<float>(k) * cell_;
          const float share = 0.5f - cone.SignedDistance(x, y, z) * inverse;
          row[k] = row[k] > share ? row[k] : share;
        }
      }
    }
  }

  Eigen::Vector3f origin_;
  std::array<int, 3> count_;
  float cell_;
  std::vector<float> share_;
};

// What one cell of the grid stands for, its image included.
double CellVolume(const OccupancyGrid& grid) {
  const double cell_m = grid.cell_m;
  return (grid.folded ? 2.0 : 1.0) * cell_m * cell_m * cell_m;
}

Box WholeBox(const OccupancyGrid& grid) {
  const Vec3 low = grid.origin_m.cast<double>();
  return {low, low + grid.cell_m * Vec3(grid.nx, grid.ny, grid.nz)};
}

// Calls take(index of the first cell, errors of the cells) for each row along z of the range.
template <class Take>
void ForRowsOfError(const OccupancyGrid& grid, const capsule::MirroredSet& graph,
                    const CellRange& range, const Take& take) {
  const std::array<int, 3> count = {range.high[0] - range.low[0], range.high[1] - range.low[1],
                                    range.high[2] - range.low[2]};
  const Vec3 corner =
      grid.origin_m.cast<double>() + grid.cell_m * Vec3(range.low[0], range.low[1], range.low[2]);
  SoftUnion filled(corner, count, grid.cell_m);
  filled.Add(graph);
  std::vector<float> row(U(count[2]));
  for (int j = 0; j < count[1]; ++j) {
    for (int i = 0; i < count[0]; ++i) {
      const std::size_t from = filled.RowOf(i, j);
      const std::size_t to = grid.ColumnOf(range.low[0] + i, range.low[1] + j) + U(range.low[2]);
      for (std::size_t k = 0; k < row.size(); ++k) {
        const float share = filled.ShareAt(from + k);
        row[k] = std::max(0.0f, share - grid.inside[to + k]) +
                 std::max(0.0f, grid.fitted[to + k] - share);
      }
      take(to, row);
    }
  }
}

}  // namespace

OccupancyGrid MakeOccupancyGrid(const body::Body& body, const body::PartSelection& parts,
                                double cell_m, bool folded) {
  OccupancyGrid grid = EmptyGrid(body.mesh, cell_m, folded);
  FillInside(body.mesh, grid);
  grid.fitted = grid.inside;
  if (LeavesOutSomething(body, parts)) {
    const std::vector<char> selected = SelectedCells(body, parts, grid);
    for (std::size_t i = 0; i < selected.size(); ++i) {
      if (!selected[i]) grid.fitted[i] = 0.0f;
    }
  }
  FillCost(grid);
  double cells = 0.0;
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = grid.first_x; i < grid.nx; ++i) {
      for (int k = 0; k < grid.nz; ++k) cells += grid.fitted[grid.ColumnOf(i, j) + U(k)];
    }
  }
  grid.volume_m3 = cells * (folded ? 2.0 : 1.0) * cell_m * cell_m * cell_m;
  return grid;
}

OccupancyGrid CoarserGrid(const OccupancyGrid& grid) {
  OccupancyGrid coarse;
  coarse.cell_m = 2.0f * grid.cell_m;
  coarse.nx = (grid.nx + 1) / 2;
  coarse.ny = (grid.ny + 1) / 2;
  coarse.nz = (grid.nz + 1) / 2;
  coarse.origin_m = grid.origin_m;
  coarse.folded = grid.folded;
  coarse.first_x = grid.first_x / 2;
  coarse.volume_m3 = grid.volume_m3;
  const std::size_t cells = U(coarse.nx) * U(coarse.ny) * U(coarse.nz);
  coarse.fitted.assign(cells, 0.0f);
  coarse.inside.assign(cells, 0.0f);
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      const std::size_t from = grid.ColumnOf(i, j), to = coarse.ColumnOf(i / 2, j / 2);
      for (std::size_t k = 0; k < U(grid.nz); ++k) {
        coarse.fitted[to + k / 2] += 0.125f * grid.fitted[from + k];
        coarse.inside[to + k / 2] += 0.125f * grid.inside[from + k];
      }
    }
  }
  FillCost(coarse);
  return coarse;
}

void SampleCost(const OccupancyGrid& grid, const float* x, const float* y, const float* z,
                int count, float* cost) {
  const float inverse = 1.0f / grid.cell_m;
  const std::ptrdiff_t row = grid.nz, layer = row * grid.nx;
  // The outermost cells are empty, so that points off the grid may be moved onto them.
  const float last_x = static_cast<float>(grid.nx) - 1.001f,
              last_y = static_cast<float>(grid.ny) - 1.001f,
              last_z = static_cast<float>(grid.nz) - 1.001f;
  const auto clamped = [](float g, float last) { return std::min(std::max(g, 0.0f), last); };
  for (int n = 0; n < count; ++n) {
    const float px = grid.folded ? std::abs(x[n]) : x[n];
    const float gx = clamped((px - grid.origin_m.x()) * inverse - 0.5f, last_x);
    const float gy = clamped((y[n] - grid.origin_m.y()) * inverse - 0.5f, last_y);
    const float gz = clamped((z[n] - grid.origin_m.z()) * inverse - 0.5f, last_z);
    const int i = static_cast<int>(gx), j = static_cast<int>(gy), k = static_cast<int>(gz);
    const float fx = gx - static_cast<float>(i), fy = gy - static_cast<float>(j),
                fz = gz - static_cast<float>(k);
    const std::int8_t* p = grid.cost.data() + j * layer + i * row + k;
    const auto along_z = [fz](const std::int8_t* q) {
      return static_cast<float>(q[0]) + fz * static_cast<float>(q[1] - q[0]);
    };
    const float v00 = along_z(p), v10 = along_z(p + row);
    const float v01 = along_z(p + layer), v11 = along_z(p + layer + row);
    const float v0 = v00 + fx * (v10 - v00), v1 = v01 + fx * (v11 - v01);
    cost[n] = (v0 + fy * (v1 - v0)) * (1.0f / kFullCost);
  }
}

double FillError(const OccupancyGrid& grid, const capsule::MirroredSet& graph, const Box& box) {
  double cells = 0.0;
  ForRowsOfError(grid, graph, RangeOf(grid, box), [&](std::size_t, const std::vector<float>& row) {
    cells += std::accumulate(row.begin(), row.end(), 0.0f);
  });
  return cells * CellVolume(grid);
}

FillErrorMap::FillErrorMap(const OccupancyGrid& grid, const capsule::MirroredSet& graph)
    : grid_(grid), errors_(grid.inside.size(), 0.0f) {
  ForRowsOfError(grid, graph, RangeOf(grid, WholeBox(grid)),
                 [&](std::size_t at, const std::vector<float>& row) {
                   std::copy(row.begin(), row.end(),
                             errors_.begin() + static_cast<std::ptrdiff_t>(at));
                 });
}

double FillErrorMap::Over(const Box& box) const {
  const CellRange range = RangeOf(grid_, box);
  double cells = 0.0;
  for (int j = range.low[1]; j < range.high[1]; ++j) {
    for (int i = range.low[0]; i < range.high[0]; ++i) {
      const std::size_t column = grid_.ColumnOf(i, j);
      float row = 0.0f;
      for (int k = range.low[2]; k < range.high[2]; ++k) row += errors_[column + U(k)];
      cells += row;
    }
  }
  return cells * CellVolume(grid_);
}

double GridError(const OccupancyGrid& grid, const capsule::MirroredSet& graph) {
  return FillError(grid, graph, WholeBox(grid)) / std::max(1e-12, grid.volume_m3);
}

}  // namespace capfit::refine
