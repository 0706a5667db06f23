#include "core/metrics/column_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/enum_index.h"
#include "core/base/fit_observer.h"
#include "core/base/random.h"
#include "core/metrics/solid_images.h"

namespace capfit::metrics {
namespace {

using geometry::Interval;
using geometry::TaperedCapsule;

constexpr std::uint64_t kColumnSeed = 20'180'000;
// How far from its cell's middle a column may lie, as a share of the cell. Middles sum smooth
// shapes five to ten times more exactly than random places; this much chance breaks the beat with
// meshes whose vertices lie in rows, and costs no exactness that can be seen.
constexpr double kJitter = 0.05;
constexpr std::size_t kRowsPerStep = 8;

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

// The intervals between sorted crossings, of those with the triangles [begin, end); `beside` more
// columns on either side of the crossings' own.
RowIntervals Inside(std::span<const mesh::ColumnCrossing> crossings,
                    const std::vector<body::Part>& parts, std::size_t begin, std::size_t end,
                    std::size_t columns, std::size_t beside) {
  std::vector<RowIntervals::Piece> pieces;
  pieces.reserve(crossings.size());
  int winding = 0;
  const mesh::ColumnCrossing* entered = nullptr;
  for (const mesh::ColumnCrossing& crossing : crossings) {
    if (crossing.triangle < begin || crossing.triangle >= end) continue;
    const int before = winding;
    winding += crossing.turn;  // back at 0 after the last crossing of each column: closed surface
    if (before == 0) entered = &crossing;
    if (winding == 0) {
      AddPiece(crossing.column + static_cast<std::uint32_t>(beside),
               {entered->along, crossing.along},
               static_cast<std::int32_t>(parts[entered->triangle]),
               static_cast<std::int32_t>(parts[crossing.triangle]), pieces);
    }
  }
  return {pieces, columns + 2 * beside};
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

bool IsOwnImage(const ColumnGrid& grid) {
  const std::size_t count = grid.x.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (grid.x[i] != -grid.x[count - 1 - i]) return false;
  }
  return true;
}

}  // namespace

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

std::optional<WiderGrid> Widen(const ColumnGrid& grid, const Eigen::AlignedBox3d& box) {
  const auto cells = [](double length, double step) {
    return std::max(0.0, std::ceil(length / step));
  };
  const double half = std::max(-box.min().x(), box.max().x());
  const double beside = cells(half + grid.low_x, grid.step_x);
  const double below = cells(grid.low_y - box.min().y(), grid.step_y);
  const auto columns = static_cast<double>(grid.x.size());
  const auto rows = static_cast<double>(grid.y.size());
  const double above = cells(box.max().y() - grid.low_y - rows * grid.step_y, grid.step_y);
  if (!(2.0 * beside <= columns && below + above <= rows)) return std::nullopt;
  WiderGrid wider{grid, {static_cast<std::size_t>(beside), static_cast<std::size_t>(below)}};
  wider.grid.low_x -= beside * grid.step_x;
  wider.grid.low_y -= below * grid.step_y;
  Random random(kColumnSeed + 1);
  const auto place_in = [&](double low, double step, std::size_t cell) {
    return low + (static_cast<double>(cell) + random.NextIn(0.5 - kJitter, 0.5 + kJitter)) * step;
  };
  std::vector<double> x(wider.margin.beside);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = place_in(wider.grid.low_x, grid.step_x, i);
  wider.grid.x.insert(wider.grid.x.begin(), x.begin(), x.end());
  for (auto p = x.rbegin(); p != x.rend(); ++p) wider.grid.x.push_back(-*p);
  std::vector<double> y;
  for (std::size_t j = 0; j < wider.margin.below; ++j) {
    y.push_back(place_in(wider.grid.low_y, grid.step_y, j));
  }
  wider.grid.y.insert(wider.grid.y.begin(), y.begin(), y.end());
  for (std::size_t j = 0; j < static_cast<std::size_t>(above); ++j) {
    wider.grid.y.push_back(place_in(grid.low_y, grid.step_y, grid.y.size() + j));
  }
  return wider;
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

BodyRows::BodyRows(const FittedSurface& surface, const ColumnGrid& grid, Backlog& backlog)
    : surface_(surface), grid_(grid) {
  // Only then it is known how many triangles there are.
  backlog.Add(1, [this, &backlog](std::size_t) { Cast(backlog); });
}

BodyRows::BodyRows(const FittedSurface& surface, const ColumnGrid& grid, const ThreadPool& pool)
    : surface_(surface), grid_(grid) {
  const NullObserver observer;
  Backlog backlog(pool, observer);
  Cast(backlog);
  backlog.Finish();
}

void BodyRows::Cast(Backlog& backlog) {
  caster_.emplace(surface_.points_m, surface_.triangles, grid_, mesh::ColumnCaster::Axes{0, 1, 2},
                  backlog);
  crossings_.resize(grid_.y.size());
  overlaps_.resize(grid_.y.size());
  backlog.AddChunks(crossings_.size(), kRowsPerStep, [this](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      crossings_[row] = caster_->Row(row);
      overlaps_[row] = OverlapIn(row);
    }
  });
  backlog.Add(1, [this](std::size_t) { caster_.reset(); });
}

BodyRows::OverlapSums BodyRows::OverlapIn(std::size_t row) const {
  OverlapSums sums;
  int winding = 0;  // back at 0 behind the last crossing of each column
  double last = 0.0;
  for (const mesh::ColumnCrossing& crossing : crossings_[row]) {
    if (crossing.triangle >= surface_.skin_end) continue;
    if (winding >= 2) {
      const double length = crossing.along - last;
      sums.length_m += length;
      sums.moment += length * Eigen::Vector3d(grid_.x[crossing.column], grid_.y[row],
                                              0.5 * (crossing.along + last));
    }
    winding += crossing.turn;
    last = crossing.along;
  }
  return sums;
}

Overlap BodyRows::MeasureOverlap() const {
  OverlapSums all;
  for (const OverlapSums& row : overlaps_) {
    all.length_m += row.length_m;
    all.moment += row.moment;
  }
  if (!(all.length_m > 0.0)) return {};
  return {all.length_m * grid_.cell_area(), all.moment / all.length_m};
}

BodyRows::Cuts BodyRows::Cut(std::size_t row, const GridMargin& margin) const {
  std::span<const mesh::ColumnCrossing> crossings;
  if (row >= margin.below && row < margin.below + crossings_.size()) {
    crossings = crossings_[row - margin.below];
  }
  const std::size_t columns = grid_.x.size();
  const std::vector<body::Part>& parts = surface_.parts;
  Cuts cuts{Inside(crossings, parts, 0, surface_.skin_end, columns, margin.beside), {}};
  if (surface_.skin_begin > 0 || surface_.skin_end < parts.size()) {
    cuts.some = Inside(crossings, parts, surface_.skin_begin, parts.size(), columns, margin.beside);
  }
  for (const mesh::ColumnCrossing& crossing : crossings) {
    if (crossing.triangle < surface_.skin_begin) continue;
    const std::size_t part = Index(parts[crossing.triangle]);
    cuts.fitted_flux[part] -= crossing.turn * (crossing.along - surface_.middle_z[part]);
  }
  return cuts;
}

struct SolidRows::Shape {
  explicit Shape(const TaperedCapsule& solid)
      : seen_along_z(Flat(solid.a()), Flat(solid.b())),
        a(solid.IsSphere() && solid.b().radius_m > solid.a().radius_m ? solid.b() : solid.a()),
        b(solid.IsSphere() ? a : solid.b()) {
    low_y = std::min(a.center_m.y() - a.radius_m, b.center_m.y() - b.radius_m);
    high_y = std::max(a.center_m.y() + a.radius_m, b.center_m.y() + b.radius_m);
    if (solid.IsSphere()) return;
    axis = solid.axis();
    tangent = solid.sin_half_angle() / solid.cos_half_angle();
    rim = a.radius_m / solid.cos_half_angle();
    first_axial = a.radius_m * solid.sin_half_angle();
    last_axial = solid.length_m() + b.radius_m * solid.sin_half_angle();
  }

  // Seen along z, the hull of two balls is the hull of their discs: a capsule in the plane.
  static geometry::Sphere Flat(const geometry::Sphere& s) {
    return {{s.center_m.x(), s.center_m.y(), 0.0}, s.radius_m};
  }

  // Where columns run inside: the hull of the stretches in either ball and of where they meet the
  // cone between its tangent circles. begin > end where they miss. Free of branches, so that it
  // vectorises; a root that does not exist is infinite or not a number, which no comparison takes.
  void Cut(const double* x, double y, std::size_t count, double* begin, double* end) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double rate = -tangent * axis.z();  // of the cone's radius along the column
    const double square = 1.0 - axis.z() * axis.z() - rate * rate;
    const double ay = y - a.center_m.y();
    const double by = y - b.center_m.y();
    for (std::size_t i = 0; i < count; ++i) {
      const double ax = x[i] - a.center_m.x();
      const double bx = x[i] - b.center_m.x();
      const double rest_a = a.radius_m * a.radius_m - ax * ax - ay * ay;
      const double rest_b = b.radius_m * b.radius_m - bx * bx - by * by;
      const double half_a = rest_a >= 0.0 ? std::sqrt(rest_a) : -kInfinity;
      const double half_b = rest_b >= 0.0 ? std::sqrt(rest_b) : -kInfinity;
      double low = std::min(a.center_m.z() - half_a, b.center_m.z() - half_b);
      double high = std::max(a.center_m.z() + half_a, b.center_m.z() + half_b);
      const double axial = ax * axis.x() + ay * axis.y();
      const double radius = rim - tangent * axial;
      const double half_linear = -axial * axis.z() - radius * rate;
      const double constant = ax * ax + ay * ay - axial * axial - radius * radius;
      const double root = std::sqrt(half_linear * half_linear - square * constant);
      const double q = -(half_linear + std::copysign(root, half_linear));
      const auto extend = [&](double t) {
        const double at = axial + t * axis.z();
        const bool is_on_cone = at >= first_axial && at <= last_axial;
        const double z = a.center_m.z() + t;
        low = is_on_cone && z < low ? z : low;
        high = is_on_cone && z > high ? z : high;
      };
      extend(q / square);
      extend(constant / q);
      begin[i] = low;
      end[i] = high;
    }
  }

  TaperedCapsule seen_along_z;
  geometry::Sphere a;  // for a ball both ends are that ball, and no cone lies between them
  geometry::Sphere b;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  double tangent = 0.0;  // of the cone's half angle
  double rim = 0.0;      // the cone's radius beside a's centre
  double first_axial = 1.0;
  double last_axial = -1.0;
  double low_y = 0.0;
  double high_y = 0.0;
};

SolidRows::SolidRows(std::span<const TaperedCapsule> solids, const ColumnGrid& grid)
    : grid_(grid), shapes_(solids.begin(), solids.end()) {
  if (IsOwnImage(grid)) images_ = ImagesByPlace(solids);
}

SolidRows::~SolidRows() = default;

void SolidRows::CutOne(std::size_t index, std::size_t row, std::size_t columns,
                       std::vector<RowIntervals::Piece>& pieces) const {
  constexpr std::size_t kBatch = 64;
  const Shape& shape = shapes_[index];
  const double y = grid_.y[row];
  if (y <= shape.low_y || y >= shape.high_y) return;
  const std::optional<Interval> shadow =
      shape.seen_along_z.Intersect({0.0, y, 0.0}, Eigen::Vector3d::UnitX());
  if (!shadow) return;
  const std::size_t last = std::min(columns, grid_.FirstColumn(shadow->end));
  std::array<double, kBatch> begin;
  std::array<double, kBatch> end;
  for (std::size_t i = grid_.FirstColumn(shadow->begin); i < last; i += kBatch) {
    const std::size_t count = std::min(kBatch, last - i);
    shape.Cut(&grid_.x[i], y, count, begin.data(), end.data());
    for (std::size_t k = 0; k < count; ++k) {
      if (!(begin[k] < end[k])) continue;
      pieces.push_back({static_cast<std::uint32_t>(i + k),
                        {begin[k], end[k]},
                        static_cast<std::int32_t>(index)});
    }
  }
}

RowIntervals SolidRows::Cut(std::size_t row) const {
  const std::size_t columns = grid_.x.size();
  const std::size_t half = images_.empty() ? columns : (columns + 1) / 2;
  std::vector<RowIntervals::Piece> pieces;
  for (std::size_t index = 0; index < shapes_.size(); ++index) CutOne(index, row, half, pieces);
  // Stable: of solids entered at one place the first comes first.
  mesh::SortByColumn(
      half,
      [](const RowIntervals::Piece& a, const RowIntervals::Piece& b) {
        return a.interval.begin < b.interval.begin;
      },
      pieces);
  pieces = MakeDisjoint(pieces);
  if (half < columns) AddImages(pieces);
  return {pieces, columns};
}

void SolidRows::AddImages(std::vector<RowIntervals::Piece>& pieces) const {
  pieces.reserve(2 * pieces.size());
  // From the last column back; each of them from its first piece on.
  for (std::size_t first = 0, last = pieces.size(); last > 0; last = first) {
    const std::uint32_t column = pieces[last - 1].column;
    for (first = last; first > 0 && pieces[first - 1].column == column;) --first;
    const auto image = static_cast<std::uint32_t>(grid_.x.size() - 1 - column);
    if (image == column) continue;
    for (std::size_t k = first; k < last; ++k) {
      pieces.push_back({image, pieces[k].interval, images_[pieces[k].label]});
    }
  }
}

}  // namespace capfit::metrics
