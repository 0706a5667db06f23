#include "core/metrics/column_grid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "core/base/random.h"

namespace capfit::metrics {
namespace {

using geometry::Interval;
using geometry::TaperedCapsule;

constexpr std::uint64_t kColumnSeed = 20'180'000;
// How far from its cell's middle a column may lie, as a share of the cell. Middles sum smooth
// shapes five to ten times more exactly than random places; this much chance breaks the beat with
// meshes whose vertices lie in rows, and costs no exactness that can be seen.
constexpr double kJitter = 0.05;

// Index of the first of the places (one in each cell) that is >= at.
std::size_t FirstAt(const std::vector<double>& places, double low, double step, double at) {
  const double cell = std::floor((at - low) / step);
  if (cell < 0.0) return 0;
  if (cell >= static_cast<double>(places.size())) return places.size();
  auto first = static_cast<std::size_t>(cell);
  // Rounding may have named the cell before or after.
  while (first > 0 && places[first - 1] >= at) --first;
  while (first < places.size() && places[first] < at) ++first;
  return first;
}

// Where a triangle's edge passes a row.
struct EdgeCrossing {
  double x = 0.0;
  double z = 0.0;
};

// The same bits from both triangles at the edge: the end with the lower index comes first.
EdgeCrossing CrossRow(std::span<const Eigen::Vector3d> points, std::uint32_t from, std::uint32_t to,
                      double y) {
  const Eigen::Vector3d& a = points[std::min(from, to)];
  const Eigen::Vector3d& b = points[std::max(from, to)];
  const double t = (y - a.y()) / (b.y() - a.y());
  return {a.x() + t * (b.x() - a.x()), a.z() + t * (b.z() - a.z())};
}

// Where a column passes the surface.
struct SurfaceCrossing {
  std::uint32_t column = 0;
  double z = 0.0;
  std::int8_t turn = 0;  // what it adds to the winding number: +1 into the body, -1 out of it
  std::uint8_t label = 0;
  bool is_body = true;
  bool is_fitted = true;
};

bool IsBelow(const SurfaceCrossing& a, const SurfaceCrossing& b) {
  if (a.column != b.column) return a.column < b.column;
  if (a.z != b.z) return a.z < b.z;
  return a.turn != b.turn ? a.turn > b.turn : a.label < b.label;
}

// Appends the crossings of one row with the triangle; `crossing` tells its label and surfaces.
void CrossTriangle(std::span<const Eigen::Vector3d> points, const mesh::Triangle& triangle,
                   const ColumnGrid& grid, std::size_t row, SurfaceCrossing crossing,
                   std::vector<SurfaceCrossing>& crossings) {
  const double y = grid.y[row];
  std::optional<EdgeCrossing> up;
  std::optional<EdgeCrossing> down;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t from = triangle[k];
    const std::uint32_t to = triangle[(k + 1) % 3];
    const bool is_from_above = points[from].y() > y;
    const bool is_to_above = points[to].y() > y;
    if (is_from_above == is_to_above) continue;
    (is_to_above ? up : down) = CrossRow(points, from, to, y);
  }
  if (!up || !down) return;
  // Counter-clockwise as seen from +z: the upward edge is on the right, the normal faces +z, and a
  // column that rises along z leaves the body there.
  const bool faces_up = down->x < up->x;
  const EdgeCrossing& left = faces_up ? *down : *up;
  const EdgeCrossing& right = faces_up ? *up : *down;
  const double slope = right.x > left.x ? (right.z - left.z) / (right.x - left.x) : 0.0;
  crossing.turn = faces_up ? -1 : 1;
  for (std::size_t i = grid.FirstColumn(left.x); i < grid.x.size() && grid.x[i] < right.x; ++i) {
    crossing.column = static_cast<std::uint32_t>(i);
    crossing.z = left.z + slope * (grid.x[i] - left.x);
    crossings.push_back(crossing);
  }
}

// Adds an interval; two halves where its ends have different labels.
void AddPiece(std::uint32_t column, const Interval& interval, std::int32_t begin_label,
              std::int32_t end_label, std::vector<RowIntervals::Piece>& pieces) {
  if (begin_label == end_label) {
    pieces.push_back({column, interval, begin_label});
    return;
  }
  const double middle = 0.5 * (interval.begin + interval.end);
  pieces.push_back({column, {interval.begin, middle}, begin_label});
  pieces.push_back({column, {middle, interval.end}, end_label});
}

// The intervals between sorted crossings of one of the two surfaces.
RowIntervals Inside(const std::vector<SurfaceCrossing>& crossings, bool SurfaceCrossing::*is_on,
                    std::size_t columns) {
  std::vector<RowIntervals::Piece> pieces;
  pieces.reserve(crossings.size());
  int winding = 0;
  const SurfaceCrossing* begin = nullptr;
  for (const SurfaceCrossing& crossing : crossings) {
    if (!(crossing.*is_on)) continue;
    const int before = winding;
    winding += crossing.turn;  // back at 0 after the last crossing of each column: closed surface
    if (before == 0) begin = &crossing;
    if (winding == 0) {
      AddPiece(crossing.column, {begin->z, crossing.z}, begin->label, crossing.label, pieces);
    }
  }
  return {pieces, columns};
}

// Sorted and overlapping pieces become disjoint ones: each keeps what no piece before it holds.
std::vector<RowIntervals::Piece> MakeDisjoint(const std::vector<RowIntervals::Piece>& sorted) {
  std::vector<RowIntervals::Piece> disjoint;
  disjoint.reserve(sorted.size());
  for (RowIntervals::Piece piece : sorted) {
    if (!disjoint.empty() && disjoint.back().column == piece.column) {
      const double end = disjoint.back().interval.end;
      if (piece.interval.end <= end) continue;
      piece.interval.begin = std::max(piece.interval.begin, end);
    }
    disjoint.push_back(piece);
  }
  return disjoint;
}

}  // namespace

std::size_t ColumnGrid::FirstColumn(double at) const { return FirstAt(x, low_x, step_x, at); }
std::size_t ColumnGrid::FirstRow(double at) const { return FirstAt(y, low_y, step_y, at); }

ColumnGrid MakeColumnGrid(const Eigen::AlignedBox3d& box, int columns) {
  const auto count = static_cast<std::size_t>(columns + columns % 2);
  const double half = std::max(-box.min().x(), box.max().x());
  ColumnGrid grid;
  grid.low_x = -half;
  grid.low_y = box.min().y();
  grid.step_x = 2.0 * half / static_cast<double>(count);
  grid.step_y = box.sizes().y() / static_cast<double>(count);
  grid.x.resize(count);
  grid.y.resize(count);
  Random random(kColumnSeed);
  for (std::size_t i = 0; i < count / 2; ++i) {
    const double place = static_cast<double>(i) + random.NextIn(0.5 - kJitter, 0.5 + kJitter);
    grid.x[i] = grid.low_x + place * grid.step_x;
    grid.x[count - 1 - i] = -grid.x[i];
  }
  for (std::size_t j = 0; j < count; ++j) {
    const double place = static_cast<double>(j) + random.NextIn(0.5 - kJitter, 0.5 + kJitter);
    grid.y[j] = grid.low_y + place * grid.step_y;
  }
  return grid;
}

RowIntervals::RowIntervals(const std::vector<Piece>& pieces, std::size_t columns)
    : begin_(columns + 1, 0) {
  intervals_.reserve(pieces.size());
  labels_.reserve(pieces.size());
  for (const Piece& piece : pieces) {
    intervals_.push_back(piece.interval);
    labels_.push_back(piece.label);
    ++begin_[piece.column + 1];
  }
  for (std::size_t i = 0; i < columns; ++i) begin_[i + 1] += begin_[i];
}

double RowIntervals::Length() const {
  double length = 0.0;
  for (const Interval& interval : intervals_) length += interval.end - interval.begin;
  return length;
}

double CommonLength(std::span<const Interval> a, std::span<const Interval> b) {
  double length = 0.0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double begin = std::max(a[i].begin, b[j].begin);
    const double end = std::min(a[i].end, b[j].end);
    if (end > begin) length += end - begin;
    if (a[i].end < b[j].end) {
      ++i;
    } else {
      ++j;
    }
  }
  return length;
}

TriangleRows::TriangleRows(std::span<const Eigen::Vector3d> points_m, const BodyTriangles& body,
                           const ColumnGrid& grid)
    : points_(points_m), body_(body), grid_(grid), begin_(grid.y.size() + 1, 0) {
  const std::vector<mesh::Triangle>& triangles = body.triangles;
  std::vector<std::uint32_t> first(triangles.size());
  std::vector<std::uint32_t> last(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const double a = points_m[triangles[t][0]].y();
    const double b = points_m[triangles[t][1]].y();
    const double c = points_m[triangles[t][2]].y();
    // A row at the height of a vertex takes it for below.
    first[t] = static_cast<std::uint32_t>(grid.FirstRow(std::min({a, b, c})));
    last[t] = first[t];
    const double top = std::max({a, b, c});
    while (last[t] < grid.y.size() && grid.y[last[t]] < top) ++begin_[++last[t]];
  }
  for (std::size_t row = 0; row < grid.y.size(); ++row) begin_[row + 1] += begin_[row];
  met_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t row = first[t]; row < last[t]; ++row) met_[next[row]++] = t;
  }
}

TriangleRows::Cuts TriangleRows::Cut(std::size_t row) const {
  std::vector<SurfaceCrossing> crossings;
  crossings.reserve(2 * (begin_[row + 1] - begin_[row]));
  for (std::uint32_t k = begin_[row]; k < begin_[row + 1]; ++k) {
    const std::uint32_t t = met_[k];
    SurfaceCrossing crossing;
    crossing.label = body_.labels[t];
    crossing.is_body = t < body_.body_end;
    crossing.is_fitted = t >= body_.fitted_begin;
    CrossTriangle(points_, body_.triangles[t], grid_, row, crossing, crossings);
  }
  std::sort(crossings.begin(), crossings.end(), IsBelow);
  return {Inside(crossings, &SurfaceCrossing::is_body, grid_.x.size()),
          Inside(crossings, &SurfaceCrossing::is_fitted, grid_.x.size())};
}

RowIntervals CutSolids(std::span<const TaperedCapsule> solids, const ColumnGrid& grid,
                       std::size_t row) {
  const double y = grid.y[row];
  std::vector<RowIntervals::Piece> pieces;
  for (std::size_t index = 0; index < solids.size(); ++index) {
    const TaperedCapsule& solid = solids[index];
    const double low = std::min(solid.a().center_m.y() - solid.a().radius_m,
                                solid.b().center_m.y() - solid.b().radius_m);
    const double high = std::max(solid.a().center_m.y() + solid.a().radius_m,
                                 solid.b().center_m.y() + solid.b().radius_m);
    if (y <= low || y >= high) continue;
    // Seen along z, the hull of two balls is the hull of their discs: a capsule in the plane.
    const auto flat = [](const geometry::Sphere& s) {
      return geometry::Sphere{{s.center_m.x(), s.center_m.y(), 0.0}, s.radius_m};
    };
    const std::optional<Interval> shadow = TaperedCapsule(flat(solid.a()), flat(solid.b()))
                                               .Intersect({0.0, y, 0.0}, Eigen::Vector3d::UnitX());
    if (!shadow) continue;
    for (std::size_t i = grid.FirstColumn(shadow->begin);
         i < grid.x.size() && grid.x[i] < shadow->end; ++i) {
      const auto inside = solid.Intersect({grid.x[i], y, 0.0}, Eigen::Vector3d::UnitZ());
      if (!inside) continue;
      pieces.push_back({static_cast<std::uint32_t>(i), *inside, static_cast<std::int32_t>(index)});
    }
  }
  std::sort(pieces.begin(), pieces.end(),
            [](const RowIntervals::Piece& a, const RowIntervals::Piece& b) {
              return std::tie(a.column, a.interval.begin, a.interval.end, a.label) <
                     std::tie(b.column, b.interval.begin, b.interval.end, b.label);
            });
  return {MakeDisjoint(pieces), grid.x.size()};
}

}  // namespace capfit::metrics
