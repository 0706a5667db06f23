#include "core/refine/best_fit/occupancy_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "core/mesh/column_caster.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr int kColumnsPerCell = 2;  // in x and in y
// Columns miss the vertices of regular meshes when they do not run through round coordinates.
constexpr double kColumnShiftX = 0.5123;
constexpr double kColumnShiftY = 0.4871;
constexpr int kAtOnce = 64;  // points whose costs are looked up
constexpr int kMargin = 2;   // cells around the body
constexpr float kFull = OccupancyGrid::kFull;

// Rows of cells are whole registers.
int InRegisters(int cells) {
  constexpr int kWhole = OccupancyGrid::kRegister;
  return (cells + kWhole - 1) / kWhole * kWhole;
}

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
  grid.nz = InRegisters(static_cast<int>(count.z()));
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

// One layer of cells: what columns enter and leave, and where, becomes shares.
class LayerFiller {
 public:
  LayerFiller(const OccupancyGrid& grid, int y)
      : grid_(grid), y_(y), steps_(grid.nx * grid.nz, 0.0f), partial_(steps_) {}

  // What lies between where columns enter the body and leave it gains `weight`.
  void Add(const mesh::ColumnCaster& caster, double side, float weight) {
    const int last = grid_.nx * kColumnsPerCell - 1;
    for (int row = y_ * kColumnsPerCell; row < (y_ + 1) * kColumnsPerCell; ++row) {
      caster.ForEachInRow(row, [&](const mesh::ColumnCrossing& crossing) {
        const int i = static_cast<int>(crossing.column);
        Cross((side > 0.0 ? i : last - i) / kColumnsPerCell, crossing.along,
              static_cast<float>(-crossing.turn) * weight);
      });
    }
  }

  void Finish(std::uint8_t* inside) const {
    for (std::size_t from = 0; from < steps_.size(); from += grid_.nz) {
      float above = 0.0f;
      for (std::size_t cell = from + grid_.nz; cell-- > from;) {
        const float share = std::clamp(above + partial_[cell], 0.0f, 1.0f);
        inside[cell] = static_cast<std::uint8_t>(kFull * share + 0.5f);
        above += steps_[cell];
      }
    }
  }

 private:
  void Cross(int x, double z, float sign) {
    const double height = (z - grid_.origin_m.z()) / grid_.cell_m;
    const int k = static_cast<int>(height);
    if (height < 0.0 || k >= grid_.nz) return;
    const std::size_t cell = x * grid_.nz + k;
    const float share = sign / (kColumnsPerCell * kColumnsPerCell);
    partial_[cell] += share * static_cast<float>(height - k);
    steps_[cell] += share;
  }

  const OccupancyGrid& grid_;
  int y_;
  std::vector<float> steps_;
  std::vector<float> partial_;
};

void FillInside(const mesh::BodyMesh& mesh, const ThreadPool& pool, OccupancyGrid& grid) {
  const auto cast = [&](double side) {
    return mesh::ColumnCaster(mesh.vertices(), mesh.triangles(), ColumnsOf(grid, side), {0, 1, 2},
                              pool);
  };
  const mesh::ColumnCaster caster = cast(1.0);
  const std::optional<mesh::ColumnCaster> mirrored =
      grid.folded ? std::optional(cast(-1.0)) : std::nullopt;
  grid.inside.resize(std::size_t{1} * grid.nx * grid.ny * grid.nz);
  pool.ForEach(grid.ny, [&](std::size_t y) {
    LayerFiller filler(grid, static_cast<int>(y));
    filler.Add(caster, 1.0, mirrored ? 0.5f : 1.0f);
    if (mirrored) filler.Add(*mirrored, -1.0, 0.5f);
    filler.Finish(grid.inside.data() + grid.ColumnOf(0, static_cast<int>(y)));
  });
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
                             static_cast<int>(at.z());
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
        if (label[cell] != kUnknown || grid.inside[cell] == 0) continue;
        label[cell] = label[front[next]];
        front.push_back(cell);
      }
    }
  }
  for (char& l : label) l = l == kIn;
  return label;
}

void FillCost(const ThreadPool& pool, OccupancyGrid& grid) {
  const std::size_t row = grid.nz, layer = row * grid.nx;
  const std::uint8_t* fitted = grid.fitted_shares().data();
  const std::uint8_t* inside = grid.inside.data();
  const auto cost_of = [fitted, inside](std::size_t cell) {
    return static_cast<std::uint32_t>((2 * OccupancyGrid::kFull - fitted[cell] - inside[cell]) / 2);
  };
  grid.cost.resize(grid.inside.size());
  // The last of a row, and the last layer, have nothing beyond: no point is sought there.
  pool.ForEach(grid.ny - 1, [&](std::size_t y) {
    std::vector<std::uint32_t> along_y(layer + 1, 0);
    const std::size_t first = y * layer;
    for (std::size_t i = 0; i < layer; ++i) {
      along_y[i] = cost_of(first + i) | cost_of(first + layer + i) << 16;
    }
    for (std::size_t i = 0; i < layer; ++i) {
      grid.cost[first + i] = along_y[i] | along_y[i + 1] << 8;
    }
  });
}

double VolumeOf(const OccupancyGrid& grid) {
  const std::vector<std::uint8_t>& fitted = grid.fitted_shares();
  double sum = 0.0;
  for (int y = 0; y < grid.ny; ++y) {
    const auto layer = fitted.begin() + static_cast<std::ptrdiff_t>(grid.ColumnOf(0, y));
    sum += std::accumulate(layer + grid.first_x * grid.nz, layer + grid.nx * grid.nz, 0);
  }
  const double cell_m = grid.cell_m;
  return (grid.folded ? 2.0 : 1.0) * sum / OccupancyGrid::kFull * cell_m * cell_m * cell_m;
}

// Between four costs, along y and z.
float Between(std::uint32_t costs, float along_y, float along_z) {
  const auto cost = [costs](int byte) {
    return static_cast<float>(static_cast<std::int32_t>(costs >> (8 * byte) & 0xff));
  };
  const float low = cost(0) + along_z * (cost(1) - cost(0));
  const float high = cost(2) + along_z * (cost(3) - cost(2));
  return low + along_y * (high - low);
}

// SampleCost at kAtOnce points at most. Loops over arrays of its own, so that they become vector
// code.
void SampleSome(const OccupancyGrid& grid, const std::array<const float*, 3>& points, int count,
                float* cost) {
  std::array<float, kAtOnce> fx, fy, fz;
  std::array<int, kAtOnce> cell;
  std::array<std::uint32_t, kAtOnce> here, beyond;  // at the lower x and at the higher
  const float inverse = 1.0f / grid.cell_m;
  const int row = grid.nz, layer = row * grid.nx;
  // The outermost cells are empty, so that points off the grid may be moved onto them.
  const float last_x = static_cast<float>(grid.nx) - 1.001f,
              last_y = static_cast<float>(grid.ny) - 1.001f,
              last_z = static_cast<float>(grid.nz) - 1.001f;
  const float low_x = grid.origin_m.x(), low_y = grid.origin_m.y(), low_z = grid.origin_m.z();
  const float lowest = grid.folded ? 0.0f : -std::numeric_limits<float>::max();
  const auto clamped = [](float g, float last) {
    g = g > 0.0f ? g : 0.0f;
    return g < last ? g : last;
  };
  const float *xs = points[0], *ys = points[1], *zs = points[2];
  for (int n = 0; n < count; ++n) {
    const float x = xs[n] > lowest ? xs[n] : -xs[n];
    const float gx = clamped((x - low_x) * inverse - 0.5f, last_x);
    const float gy = clamped((ys[n] - low_y) * inverse - 0.5f, last_y);
    const float gz = clamped((zs[n] - low_z) * inverse - 0.5f, last_z);
    const int i = static_cast<int>(gx), j = static_cast<int>(gy), k = static_cast<int>(gz);
    cell[n] = j * layer + i * row + k;
    fx[n] = gx - static_cast<float>(i);
    fy[n] = gy - static_cast<float>(j);
    fz[n] = gz - static_cast<float>(k);
  }
  for (int n = 0; n < count; ++n) {
    here[n] = grid.cost[cell[n]];
    beyond[n] = grid.cost[cell[n] + row];
  }
  for (int n = 0; n < count; ++n) {
    const float near = Between(here[n], fy[n], fz[n]), far = Between(beyond[n], fy[n], fz[n]);
    cost[n] = (near + fx[n] * (far - near) - 0.5f * kFull) * (2.0f / kFull);
  }
}

// Of eight cells each.
std::vector<std::uint8_t> MeansOf(const OccupancyGrid& grid,
                                  const std::vector<std::uint8_t>& shares,
                                  const OccupancyGrid& coarse) {
  std::vector<int> sums(std::size_t{1} * coarse.nx * coarse.ny * coarse.nz, 0);
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      const std::uint8_t* from = shares.data() + grid.ColumnOf(i, j);
      int* to = sums.data() + coarse.ColumnOf(i / 2, j / 2);
      for (int k = 0; k < grid.nz / 2; ++k) to[k] += from[2 * k] + from[2 * k + 1];
    }
  }
  std::vector<std::uint8_t> means(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    means[i] = static_cast<std::uint8_t>((sums[i] + 4) / 8);
  }
  return means;
}

}  // namespace

OccupancyGrid MakeOccupancyGrid(const body::Body& body, const body::PartSelection& parts,
                                double cell_m, bool folded, const ThreadPool& pool) {
  OccupancyGrid grid = EmptyGrid(body.mesh, cell_m, folded);
  FillInside(body.mesh, pool, grid);
  if (body::LeavesOutSome(body.vertex_segments, parts)) {
    grid.fitted = grid.inside;
    const std::vector<char> selected = SelectedCells(body, parts, grid);
    for (std::size_t i = 0; i < selected.size(); ++i) {
      if (!selected[i]) grid.fitted[i] = 0;
    }
  }
  FillCost(pool, grid);
  grid.volume_m3 = VolumeOf(grid);
  return grid;
}

OccupancyGrid CoarserGrid(const OccupancyGrid& grid) {
  OccupancyGrid coarse;
  coarse.cell_m = 2.0f * grid.cell_m;
  coarse.nx = (grid.nx + 1) / 2;
  coarse.ny = (grid.ny + 1) / 2;
  coarse.nz = InRegisters(grid.nz / 2);
  coarse.origin_m = grid.origin_m;
  coarse.folded = grid.folded;
  coarse.first_x = grid.first_x / 2;
  coarse.volume_m3 = grid.volume_m3;
  coarse.inside = MeansOf(grid, grid.inside, coarse);
  if (!grid.fitted.empty()) coarse.fitted = MeansOf(grid, grid.fitted, coarse);
  return coarse;
}

tighten::FullCells FullCellsOf(const OccupancyGrid& grid) {
  tighten::FullCells cells = {.origin_m = grid.origin_m,
                              .cells_per_m = 1.0f / grid.cell_m,
                              .nx = grid.nx,
                              .ny = grid.ny,
                              .nz = grid.nz,
                              .folded = grid.folded,
                              .is_full = {}};
  cells.is_full.reserve(grid.inside.size());
  for (const std::uint8_t share : grid.fitted_shares()) {
    cells.is_full.push_back(share == OccupancyGrid::kFull ? 1 : 0);
  }
  return cells;
}

void SampleCost(const OccupancyGrid& grid, const float* x, const float* y, const float* z,
                int count, float* cost) {
  for (int first = 0; first < count; first += kAtOnce) {
    const int some = std::min(kAtOnce, count - first);
    SampleSome(grid, {x + first, y + first, z + first}, some, cost + first);
  }
}

}  // namespace capfit::refine
