#include "core/mesh/column_caster.h"

#include <cmath>
#include <memory>
#include <utility>

#include "core/base/fit_observer.h"

namespace capfit::mesh {
namespace {

constexpr std::size_t kTrianglesPerChunk = 2048;
constexpr std::size_t kPointsPerChunk = 4096;
constexpr std::size_t kFewColumns = 8;

// Index of the first of the places (one in each cell) that is >= at.
inline std::size_t FirstAt(const std::vector<double>& places, double low, double step, double at) {
  const double cell = std::floor((at - low) / step);
  if (cell < 0.0) return 0;
  if (cell >= static_cast<double>(places.size())) return places.size();
  auto first = static_cast<std::size_t>(cell);
  first += places[first] < at ? 1 : 0;  // as good as chance: no branch
  // Rounding may have named the cell before or after.
  while (first > 0 && places[first - 1] >= at) --first;
  while (first < places.size() && places[first] < at) ++first;
  return first;
}

// The first column and row that are not below a point: these tell what lies between which of them
// without the coordinates.
struct GridPlace {
  std::uint32_t column = 0;
  std::uint32_t row = 0;
};

// Where a triangle's edge passes a row.
struct EdgeCrossing {
  double x = 0.0;
  double along = 0.0;
};

class TriangleCaster {
 public:
  TriangleCaster(std::span<const Eigen::Vector3d> points, const ColumnGrid& grid,
                 const ColumnCaster::Axes& axes)
      : grid_(grid), points_(points), axes_(axes), places_(points.size()) {}

  // Of the points [begin, end), which comes before any crossing.
  void FindPlaces(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      places_[i] = {static_cast<std::uint32_t>(grid_.FirstColumn(points_[i][axes_[0]])),
                    static_cast<std::uint32_t>(grid_.FirstRow(points_[i][axes_[1]]))};
    }
  }

  // All crossings of the triangles [begin, end). What a small triangle meets is as good as chance,
  // so that branches would be guessed wrong half of the time: there are none but for the loops.
  std::vector<ColumnCrossing> Cross(std::span<const Triangle> triangles, std::size_t begin,
                                    std::size_t end) const {
    std::vector<Range> ranges(end - begin);
    std::size_t count = 0;
    for (std::size_t t = begin; t < end; ++t) {
      const GridPlace a = places_[triangles[t][0]];
      const GridPlace b = places_[triangles[t][1]];
      const GridPlace c = places_[triangles[t][2]];
      const Range range = {static_cast<std::uint32_t>(t), std::min({a.row, b.row, c.row}),
                           std::max({a.row, b.row, c.row}),
                           std::min({a.column, b.column, c.column}),
                           std::max({a.column, b.column, c.column})};
      ranges[count] = range;
      count += ((range.low_row < range.high_row) & (range.left < range.right)) ? 1 : 0;
    }
    Crossings found;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::uint32_t row = ranges[i].low_row; row < ranges[i].high_row; ++row) {
        CrossRow(triangles[ranges[i].triangle], ranges[i], row, found);
      }
    }
    found.list.resize(found.count);
    return std::move(found.list);
  }

 private:
  // The rows and columns that run through a triangle's box.
  struct Range {
    std::uint32_t triangle;
    std::uint32_t low_row, high_row;
    std::uint32_t left, right;
  };
  // With room at the end.
  struct Crossings {
    std::vector<ColumnCrossing> list;
    std::size_t count = 0;
  };

  // The same bits from both triangles at the edge: the end with the lower index comes first.
  [[nodiscard]] EdgeCrossing CrossEdge(std::uint32_t from, std::uint32_t to, double y) const {
    const Eigen::Vector3d& a = points_[std::min(from, to)];
    const Eigen::Vector3d& b = points_[std::max(from, to)];
    const auto [across, up, along] = axes_;
    const double t = (y - a[up]) / (b[up] - a[up]);
    // Rounding must not carry it past a column that the ends do not reach.
    const double x = std::clamp(a[across] + t * (b[across] - a[across]),
                                std::min(a[across], b[across]), std::max(a[across], b[across]));
    return {x, a[along] + t * (b[along] - a[along])};
  }

  // One corner is on one side of the row, two are on the other; the edges beside the lone one cross
  // it.
  void CrossRow(const Triangle& triangle, const Range& range, std::uint32_t row,
                Crossings& found) const {
    constexpr std::array<std::uint8_t, 8> kLone = {0, 0, 1, 2, 2, 1, 0, 0};  // by corners above
    std::size_t above = 0;
    // A row at the height of a point takes it for below.
    for (std::size_t k = 0; k < 3; ++k) above |= (row < places_[triangle[k]].row ? 1u : 0u) << k;
    const std::size_t lone = kLone[above];
    const std::uint32_t corner = triangle[lone];
    const double y = grid_.y[row];
    const EdgeCrossing after = CrossEdge(corner, triangle[(lone + 1) % 3], y);
    const EdgeCrossing before = CrossEdge(corner, triangle[(lone + 2) % 3], y);
    // The boundary runs counter-clockwise as seen from beyond where its upward edge is on the
    // right: then the normal faces along the columns, and they leave the body there.
    const bool is_lone_above = (above >> lone & 1u) != 0;
    const bool is_before_right = after.x < before.x;
    const bool faces_up = is_lone_above ? is_before_right : before.x < after.x;
    const EdgeCrossing& left = is_before_right ? after : before;
    const EdgeCrossing& right = is_before_right ? before : after;
    const double slope = right.x > left.x ? (right.along - left.along) / (right.x - left.x) : 0.0;
    std::size_t first = range.left;
    std::size_t last = range.right;
    if (last - first > kFewColumns) {
      first = grid_.FirstColumn(left.x);
      last = grid_.FirstColumn(right.x);
    }
    if (found.list.size() < found.count + (last - first)) {
      found.list.resize(2 * found.list.size() + (last - first));
    }
    for (std::size_t i = first; i < last; ++i) {
      const double x = grid_.x[i];
      found.list[found.count] = {row, static_cast<std::uint32_t>(i), range.triangle,
                                 faces_up ? -1 : 1, left.along + slope * (x - left.x)};
      found.count += ((left.x <= x) & (x < right.x)) ? 1 : 0;
    }
  }

  const ColumnGrid& grid_;
  std::span<const Eigen::Vector3d> points_;
  ColumnCaster::Axes axes_;
  std::vector<GridPlace> places_;  // of each point
};

}  // namespace

std::size_t ColumnGrid::FirstColumn(double at) const { return FirstAt(x, low_x, step_x, at); }
std::size_t ColumnGrid::FirstRow(double at) const { return FirstAt(y, low_y, step_y, at); }

ColumnCaster::Chunk::Chunk(const std::vector<ColumnCrossing>& found, std::size_t rows)
    : crossings(found.size()), begin(rows + 1, 0) {
  for (const ColumnCrossing& crossing : found) ++begin[crossing.row + 1];
  for (std::size_t row = 0; row < rows; ++row) begin[row + 1] += begin[row];
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (const ColumnCrossing& crossing : found) crossings[next[crossing.row]++] = crossing;
}

ColumnCaster::ColumnCaster(std::span<const Eigen::Vector3d> points,
                           std::span<const Triangle> triangles, const ColumnGrid& grid,
                           const Axes& axes, const ThreadPool& pool) {
  const NullObserver observer;
  Backlog backlog(pool, observer);
  Cast(points, triangles, grid, axes, backlog);
  backlog.Finish();
}

ColumnCaster::ColumnCaster(std::span<const Eigen::Vector3d> points,
                           std::span<const Triangle> triangles, const ColumnGrid& grid,
                           const Axes& axes, Backlog& backlog) {
  Cast(points, triangles, grid, axes, backlog);
}

void ColumnCaster::Cast(std::span<const Eigen::Vector3d> points,
                        std::span<const Triangle> triangles, const ColumnGrid& grid,
                        const Axes& axes, Backlog& backlog) {
  columns_ = grid.x.size();
  chunks_.resize((triangles.size() + kTrianglesPerChunk - 1) / kTrianglesPerChunk);
  const auto caster = std::make_shared<TriangleCaster>(points, grid, axes);
  backlog.AddChunks(points.size(), kPointsPerChunk, [caster](std::size_t begin, std::size_t end) {
    caster->FindPlaces(begin, end);
  });
  const std::size_t rows = grid.y.size();
  backlog.AddChunks(triangles.size(), kTrianglesPerChunk,
                    [this, caster, triangles, rows](std::size_t begin, std::size_t end) {
                      chunks_[begin / kTrianglesPerChunk] =
                          Chunk(caster->Cross(triangles, begin, end), rows);
                    });
}

std::vector<ColumnCrossing> ColumnCaster::Row(std::size_t row) const {
  std::vector<ColumnCrossing> crossings;
  for (const Chunk& chunk : chunks_) {
    crossings.insert(crossings.end(), chunk.crossings.begin() + chunk.begin[row],
                     chunk.crossings.begin() + chunk.begin[row + 1]);
  }
  const auto is_before = [](const ColumnCrossing& a, const ColumnCrossing& b) {
    if (a.along != b.along) return a.along < b.along;
    return a.turn != b.turn ? a.turn > b.turn : a.triangle < b.triangle;
  };
  SortByColumn(columns_, is_before, crossings);
  return crossings;
}

}  // namespace capfit::mesh
