#include "core/refine/best_fit/fill_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr int kRegister = OccupancyGrid::kRegister;
// Layers of cells that one thread takes at a time.
constexpr std::size_t kLayersAtOnce = 16;
// Of a cell that nothing reaches: less than that is not looked up.
constexpr float kLeastError = 0.03f;
// A capsule that rises less than this share of its length reaches as high everywhere.
constexpr float kLevel = 1e-4f;

// Some cells of a grid, as index ranges [low, high); whole registers along z.
struct CellRange {
  std::array<int, 3> low, high;
};

CellRange RangeOf(const OccupancyGrid& grid, const Box& box) {
  CellRange range;
  const std::array<int, 3> count = {grid.nx, grid.ny, grid.nz};
  for (int k = 0; k < 3; ++k) {
    const double origin = grid.origin_m[k];
    range.low[k] =
        std::clamp(static_cast<int>(std::floor((box[0][k] - origin) / grid.cell_m)), 0, count[k]);
    range.high[k] = std::clamp(static_cast<int>(std::ceil((box[1][k] - origin) / grid.cell_m)),
                               range.low[k], count[k]);
  }
  range.low[0] = std::max(range.low[0], grid.first_x);
  range.high[0] = std::max(range.high[0], range.low[0]);
  range.low[2] = range.low[2] / kRegister * kRegister;
  range.high[2] = (range.high[2] + kRegister - 1) / kRegister * kRegister;
  return range;
}

CellRange WholeRange(const OccupancyGrid& grid) {
  return {{grid.first_x, 0, 0}, {grid.nx, grid.ny, grid.nz}};
}

// What one cell of the grid stands for, its image included.
double CellVolume(const OccupancyGrid& grid) {
  const double cell_m = grid.cell_m;
  return (grid.folded ? 2.0 : 1.0) * cell_m * cell_m * cell_m;
}

// Goes through a range of a grid, one row of cells along z after another.
class ErrorRows {
 public:
  ErrorRows(const OccupancyGrid& grid, const std::vector<Cone>& cones, const CellRange& range)
      : grid_(grid), cones_(cones), range_(range), row_(range.high[2] - range.low[2]) {}

  // Calls take(index of the first cell, errors of the cells) for each row in the layer `y`.
  template <class Take>
  void Layer(int y, const Take& take) {
    FindSlices(y);
    for (int x = range_.low[0]; x < range_.high[0]; ++x) {
      const std::size_t first = grid_.ColumnOf(x, y) + range_.low[2];
      FillRow(x, y);
      FindErrors(first);
      take(first, row_);
    }
  }

  // Of one cell: the group that fills most of it, -1: none, and what it and all others fill.
  struct Owner {
    int group = -1;
    float share = 0.0f, share_of_others = 0.0f;
    float error = 0.0f, error_without = 0.0f;
  };

  // The same, and whose error it is: calls take(middle of the first cell, owners of the cells) for
  // each row. `groups`: by cone; those of a group go and stay together.
  template <class Take>
  void OwnedLayer(int y, const std::vector<int>& groups, const Take& take) {
    owners_.resize(row_.size());
    FindSlices(y);
    for (int x = range_.low[0]; x < range_.high[0]; ++x) {
      const std::size_t first = grid_.ColumnOf(x, y) + range_.low[2];
      FillOwners(x, y, groups);
      for (std::size_t k = 0; k < owners_.size(); ++k) {
        owners_[k].error = ErrorAt(first + k, owners_[k].share);
        owners_[k].error_without = ErrorAt(first + k, owners_[k].share_of_others);
      }
      take({MiddleOf(x, 0), MiddleOf(y, 1), MiddleOf(range_.low[2], 2)}, owners_);
    }
  }

 private:
  // The part of a cone that reaches into a layer, in cells; along z from the range's first.
  struct Slice {
    const Cone* cone;
    int low_x, high_x, low_z, high_z;
  };

  [[nodiscard]] float MiddleOf(int cell, int axis) const {
    return grid_.origin_m[axis] + (static_cast<float>(cell) + 0.5f) * grid_.cell_m;
  }

  void FindSlices(int y) {
    slices_.clear();
    const float half = 0.5f * grid_.cell_m;
    const float height = MiddleOf(y, 1);
    for (const Cone& cone : cones_) {
      const float end_radius = cone.radius + cone.highest * cone.radius_slope;
      const float reach = std::max(cone.radius, end_radius) + half;
      float from = 0.0f, to = cone.highest;
      if (std::abs(cone.uy) > kLevel) {
        const float one = (height - reach - cone.ay) / cone.uy;
        const float other = (height + reach - cone.ay) / cone.uy;
        from = std::max(from, std::min(one, other));
        to = std::min(to, std::max(one, other));
      } else if (std::abs(height - cone.ay) > reach + kLevel * cone.highest) {
        continue;
      }
      if (from <= to) AddSlice(cone, from, to);
    }
  }

  // Of the cone between two places on its axis.
  void AddSlice(const Cone& cone, float from, float to) {
    const float reach = 0.5f * grid_.cell_m + cone.radius +
                        std::max(from * cone.radius_slope, to * cone.radius_slope);
    const auto cells = [&](float start, float along, int axis) {
      const float a = start + from * along, b = start + to * along;
      const float low = (std::min(a, b) - reach - grid_.origin_m[axis]) / grid_.cell_m - 0.5f;
      const float high = (std::max(a, b) + reach - grid_.origin_m[axis]) / grid_.cell_m - 0.5f;
      return std::array{std::max(static_cast<int>(std::floor(low)), range_.low[axis]),
                        std::min(static_cast<int>(std::ceil(high)) + 1, range_.high[axis])};
    };
    const auto [low_x, high_x] = cells(cone.ax, cone.ux, 0);
    const auto [low_z, high_z] = cells(cone.az, cone.uz, 2);
    if (low_x >= high_x || low_z >= high_z) return;
    const int first = (low_z - range_.low[2]) / kRegister * kRegister;
    const int last = (high_z - range_.low[2] + kRegister - 1) / kRegister * kRegister;
    slices_.push_back({&cone, low_x, high_x, first, last});
  }

  // Share of each cell of the row that the union fills, softened over one cell; below 0 and above 1
  // too.
  void FillRow(int x, int y) {
    std::fill(row_.begin(), row_.end(), 0.0f);
    const float px = MiddleOf(x, 0), py = MiddleOf(y, 1), z0 = MiddleOf(range_.low[2], 2);
    const float cell = grid_.cell_m, inverse = 1.0f / cell;
    for (const Slice& slice : slices_) {
      if (x < slice.low_x || x >= slice.high_x) continue;
      const Cone cone = *slice.cone;
      for (int first = slice.low_z; first < slice.high_z; first += kRegister) {
        float* shares = row_.data() + first;
        for (int k = 0; k < kRegister; ++k) {
          const float z = z0 + static_cast<float>(first + k) * cell;
          const float share = 0.5f - cone.SignedDistance(px, py, z) * inverse;
          shares[k] = shares[k] > share ? shares[k] : share;
        }
      }
    }
  }

  void FillOwners(int x, int y, const std::vector<int>& groups) {
    std::fill(owners_.begin(), owners_.end(), Owner{});
    const float px = MiddleOf(x, 0), py = MiddleOf(y, 1), z0 = MiddleOf(range_.low[2], 2);
    for (const Slice& slice : slices_) {
      if (x < slice.low_x || x >= slice.high_x) continue;
      const int group = groups[slice.cone - cones_.data()];
      for (int k = slice.low_z; k < slice.high_z; ++k) {
        const float z = z0 + static_cast<float>(k) * grid_.cell_m;
        const float share = 0.5f - slice.cone->SignedDistance(px, py, z) / grid_.cell_m;
        Owner& owner = owners_[k];
        if (group == owner.group) {
          owner.share = std::max(owner.share, share);
        } else if (share > owner.share) {
          owner = {group, share, owner.share};
        } else {
          owner.share_of_others = std::max(owner.share_of_others, share);
        }
      }
    }
  }

  [[nodiscard]] float ErrorAt(std::size_t cell, float share) const {
    const float inside = static_cast<float>(grid_.inside[cell]) * (1.0f / OccupancyGrid::kFull);
    const float fitted =
        static_cast<float>(grid_.fitted_shares()[cell]) * (1.0f / OccupancyGrid::kFull);
    share = std::min(share, 1.0f);
    return std::max(0.0f, share - inside) + std::max(0.0f, fitted - share);
  }

  // Turns the shares of the row into errors.
  void FindErrors(std::size_t first_cell) {
    const std::uint8_t* inside_byte = grid_.inside.data() + first_cell;
    const std::uint8_t* fitted_byte = grid_.fitted_shares().data() + first_cell;
    float* row = row_.data();
    for (std::size_t first = 0; first < row_.size(); first += kRegister) {
      for (std::size_t k = first; k < first + kRegister; ++k) {
        const float share = row[k] < 1.0f ? row[k] : 1.0f;
        const float inside = static_cast<float>(inside_byte[k]) * (1.0f / OccupancyGrid::kFull);
        const float fitted = static_cast<float>(fitted_byte[k]) * (1.0f / OccupancyGrid::kFull);
        const float outside = share - inside, uncovered = fitted - share;
        row[k] = (outside > 0.0f ? outside : 0.0f) + (uncovered > 0.0f ? uncovered : 0.0f);
      }
    }
  }

  const OccupancyGrid& grid_;
  const std::vector<Cone>& cones_;
  CellRange range_;
  std::vector<Slice> slices_;
  std::vector<float> row_;
  std::vector<Owner> owners_;
};

// By cone: the lower index of it and its image.
std::vector<int> GroupsOf(const capsule::MirroredSet& graph) {
  std::vector<int> groups = ImagesOfCones(graph);
  for (int i = 0; i < static_cast<int>(groups.size()); ++i) groups[i] = std::min(groups[i], i);
  return groups;
}

int NearestCone(const std::vector<Cone>& cones, const Eigen::Vector3f& point) {
  int nearest = 0;
  float least = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < cones.size(); ++i) {
    const float distance = cones[i].SignedDistance(point.x(), point.y(), point.z());
    if (distance < least) least = distance, nearest = static_cast<int>(i);
  }
  return nearest;
}

// A sum for each place in a register, in an order of its own.
float SumOf(const float* values, std::size_t count) {
  std::array<float, kRegister> sums{};
  for (std::size_t first = 0; first < count; first += kRegister) {
    for (std::size_t k = 0; k < kRegister; ++k) sums[k] += values[first + k];
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0f);
}

// Some layers of a grid: one in `every` of [low, high).
struct Layers {
  int low, high, every = 1;
};

// In cells.
double ErrorOfLayers(const OccupancyGrid& grid, const std::vector<Cone>& cones,
                     const CellRange& range, const Layers& layers) {
  ErrorRows rows(grid, cones, range);
  double cells = 0.0;
  for (int y = layers.low; y < layers.high; y += layers.every) {
    rows.Layer(y, [&](std::size_t, const std::vector<float>& errors) {
      cells += SumOf(errors.data(), errors.size());
    });
  }
  return cells;
}

}  // namespace

double FillError(const OccupancyGrid& grid, const std::vector<Cone>& cones, const Box& box,
                 int every) {
  const CellRange range = RangeOf(grid, box);
  return ErrorOfLayers(grid, cones, range, {range.low[1], range.high[1], every}) *
         CellVolume(grid) * every;
}

FillErrorMap::FillErrorMap(const OccupancyGrid& grid, const std::vector<Cone>& cones,
                           const ThreadPool& pool)
    : grid_(grid), errors_(grid.inside.size(), 0.0f) {
  pool.ForChunks(grid.ny, kLayersAtOnce, [&](std::size_t begin, std::size_t end) {
    ErrorRows rows(grid, cones, WholeRange(grid));
    for (std::size_t y = begin; y < end; ++y) {
      rows.Layer(static_cast<int>(y), [&](std::size_t first, const std::vector<float>& errors) {
        std::copy(errors.begin(), errors.end(),
                  errors_.begin() + static_cast<std::ptrdiff_t>(first));
      });
    }
  });
}

double FillErrorMap::Over(const Box& box, int every) const {
  const CellRange range = RangeOf(grid_, box);
  double cells = 0.0;
  for (int y = range.low[1]; y < range.high[1]; y += every) {
    for (int x = range.low[0]; x < range.high[0]; ++x) {
      cells +=
          SumOf(errors_.data() + grid_.ColumnOf(x, y) + range.low[2], range.high[2] - range.low[2]);
    }
  }
  return cells * CellVolume(grid_) * every;
}

CapsuleErrors ErrorsByCapsule(const OccupancyGrid& grid, const capsule::MirroredSet& graph,
                              const ThreadPool& pool) {
  const std::vector<Cone> cones = ConesOf(graph);
  const std::vector<int> groups = GroupsOf(graph);
  std::vector<CapsuleErrors> parts((grid.ny + kLayersAtOnce - 1) / kLayersAtOnce);
  pool.ForChunks(grid.ny, kLayersAtOnce, [&](std::size_t begin, std::size_t end) {
    CapsuleErrors& part = parts[begin / kLayersAtOnce];
    part.beside_m3.assign(cones.size(), 0.0);
    part.loss_m3.assign(cones.size(), 0.0);
    ErrorRows rows(grid, cones, WholeRange(grid));
    const auto take = [&](Eigen::Vector3f middle, const std::vector<ErrorRows::Owner>& owners) {
      for (const ErrorRows::Owner& owner : owners) {
        int group = owner.group;
        if (group >= 0) part.loss_m3[group] += owner.error_without - owner.error;
        if (group < 0 && owner.error > kLeastError) group = groups[NearestCone(cones, middle)];
        if (group >= 0) part.beside_m3[group] += owner.error;
        middle.z() += grid.cell_m;
      }
    };
    for (std::size_t y = begin; y < end; ++y) rows.OwnedLayer(static_cast<int>(y), groups, take);
  });
  CapsuleErrors errors{std::vector<double>(cones.size(), 0.0),
                       std::vector<double>(cones.size(), 0.0)};
  for (std::size_t i = 0; i < cones.size(); ++i) {
    for (const CapsuleErrors& part : parts) {
      errors.beside_m3[i] += part.beside_m3[groups[i]] * CellVolume(grid);
      errors.loss_m3[i] += part.loss_m3[groups[i]] * CellVolume(grid);
    }
  }
  return errors;
}

double GridError(const OccupancyGrid& grid, const capsule::MirroredSet& graph,
                 const ThreadPool& pool) {
  const std::vector<Cone> cones = ConesOf(graph);
  std::vector<double> cells((grid.ny + kLayersAtOnce - 1) / kLayersAtOnce, 0.0);
  pool.ForChunks(grid.ny, kLayersAtOnce, [&](std::size_t begin, std::size_t end) {
    cells[begin / kLayersAtOnce] = ErrorOfLayers(grid, cones, WholeRange(grid),
                                                 {static_cast<int>(begin), static_cast<int>(end)});
  });
  return std::accumulate(cells.begin(), cells.end(), 0.0) * CellVolume(grid) /
         std::max(1e-12, grid.volume_m3);
}

}  // namespace capfit::refine
