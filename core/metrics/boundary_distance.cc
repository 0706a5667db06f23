#include "core/metrics/boundary_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/metrics/revolved_surface.h"
#include "core/metrics/solid_images.h"
#include "core/tighten/distance_kernel.h"
#include "core/tighten/point_grid.h"

namespace capfit::metrics {
namespace {

using geometry::TaperedCapsule;

// A surface point counts as hidden when it is deeper in another solid than this share of the set's
// size; far above rounding, far below what can be seen.
constexpr double kHiddenShare = 1e-6;
// Halvings between a grid's exposed and hidden point: 10 mm become 0.04 mm.
constexpr int kHalvings = 8;
constexpr int kSlides = 6;
constexpr double kFewestAround = 12.0;
constexpr double kFewestRings = 4.0;
constexpr std::size_t kPointsPerChunk = 512;

double SizeOf(const std::vector<TaperedCapsule>& solids) {
  Eigen::AlignedBox3d box;
  for (const TaperedCapsule& solid : solids) box.extend(BoxOf(solid));
  return solids.empty() ? 0.0 : box.diagonal().norm();
}

double GridArea(const TaperedCapsule& solid) {
  const RevolvedSurface surface(solid);
  return surface.profile_length_m() * 2.0 * std::numbers::pi * surface.largest_radius_m();
}

// The point near `start` that is on both surfaces: Newton, least movement.
Eigen::Vector3d OnBoth(const TaperedCapsule& first, const TaperedCapsule& second,
                       Eigen::Vector3d point) {
  for (int step = 0; step < 3; ++step) {
    const geometry::CapsuleDistance a = first.Locate(point);
    const geometry::CapsuleDistance b = second.Locate(point);
    const double c = a.normal.dot(b.normal);
    const double determinant = 1.0 - c * c;
    if (determinant < 1e-6) break;  // tangent surfaces: no crease to speak of
    point -= (a.distance_m - c * b.distance_m) / determinant * a.normal +
             (b.distance_m - c * a.distance_m) / determinant * b.normal;
  }
  return point;
}

// A solid is all balls along its axis. Between the balls looked at, neither their depth in the
// other solid nor their radius can change by more than the way to them.
bool MayTouch(const TaperedCapsule& solid, const TaperedCapsule& other) {
  constexpr int kSteps = 6;
  const Eigen::Vector3d way = solid.b().center_m - solid.a().center_m;
  const double widening = solid.b().radius_m - solid.a().radius_m;
  const double slack = (way.norm() + std::abs(widening)) / (2 * kSteps);
  for (int step = 0; step <= kSteps; ++step) {
    const double t = static_cast<double>(step) / kSteps;
    const double radius = solid.a().radius_m + t * widening;
    if (other.SignedDistance(solid.a().center_m + t * way) <= radius + slack) return true;
  }
  return false;
}

}  // namespace

Eigen::AlignedBox3d BoxOf(const TaperedCapsule& solid) {
  Eigen::AlignedBox3d box;
  for (const geometry::Sphere& end : {solid.a(), solid.b()}) {
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(end.radius_m);
    box.extend(Eigen::Vector3d(end.center_m - reach));
    box.extend(Eigen::Vector3d(end.center_m + reach));
  }
  return box;
}

struct BoundaryDistance::SurfaceGrid {
  std::size_t rows = 0;
  std::size_t columns = 0;
  // By point, rows one after the other.
  std::vector<double> x, y, z;
  std::vector<double> depth;    // signed distance to the nearest of the other solids ...
  std::vector<double> nearest;  // ... and its index

  [[nodiscard]] Eigen::Vector3d point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  // Takes in another solid.
  void Lower(const tighten::DistanceKernel& solid, double index);
};

BoundaryDistance::BoundaryDistance(const std::vector<TaperedCapsule>& solids, int grid_points,
                                   const ThreadPool& pool)
    : solids_(solids), images_(ImagesByPlace(solids)), tolerance_m_(kHiddenShare * SizeOf(solids)) {
  FindNeighbours(pool);
  double area = 0.0;
  for (const TaperedCapsule& solid : solids_) area += GridArea(solid);
  const double spacing_m = std::sqrt(area / grid_points);
  std::vector<std::vector<CreasePoint>> found(solids_.size());
  pool.ForEach(found.size(), [&](std::size_t i) {
    if (!IsLaterImage(i)) FindCreases(i, spacing_m, found[i]);
  });
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!IsLaterImage(i)) continue;
    for (const CreasePoint& point : found[images_[i]]) found[i].push_back(ImageOf(point));
  }
  for (const std::vector<CreasePoint>& points : found) {
    creases_.insert(creases_.end(), points.begin(), points.end());
  }
  split_axis_.resize(creases_.size());
  Sort(0, creases_.size());
}

void BoundaryDistance::FindNeighbours(const ThreadPool& pool) {
  neighbours_.resize(solids_.size());
  pool.ForEach(solids_.size(), [&](std::size_t i) {
    if (IsLaterImage(i)) return;
    for (std::size_t k = 0; k < solids_.size(); ++k) {
      if (k == i || !MayTouch(solids_[i], solids_[k])) continue;
      neighbours_[i].push_back(static_cast<std::int32_t>(k));
    }
  });
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    if (!IsLaterImage(i)) continue;
    for (const std::int32_t k : neighbours_[images_[i]]) neighbours_[i].push_back(images_[k]);
    std::sort(neighbours_[i].begin(), neighbours_[i].end());
  }
}

BoundaryDistance::CreasePoint BoundaryDistance::ImageOf(const CreasePoint& point) const {
  const Eigen::Vector3d& at = point.position_m;
  return {{-at.x(), at.y(), at.z()}, images_[point.on], images_[point.under]};
}

bool BoundaryDistance::IsExposed(const Eigen::Vector3d& point_m, std::int32_t solid) const {
  const std::vector<std::int32_t>& others = neighbours_[solid];
  return std::all_of(others.begin(), others.end(),
                     [&](std::int32_t other) { return DepthAt(point_m, other) >= -tolerance_m_; });
}

double BoundaryDistance::DepthAt(const Eigen::Vector3d& point_m, std::int32_t solid) const {
  return solids_[solid].SignedDistance(point_m);
}

// Free of branches, so that it vectorises.
void BoundaryDistance::SurfaceGrid::Lower(const tighten::DistanceKernel& solid, double index) {
  double* const best = depth.data();
  double* const which = nearest.data();
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double distance = solid.SignedDistance(x[i], y[i], z[i]);
    which[i] = distance < best[i] ? index : which[i];
    best[i] = distance < best[i] ? distance : best[i];
  }
}

BoundaryDistance::SurfaceGrid BoundaryDistance::MakeGrid(std::size_t solid,
                                                         double spacing_m) const {
  const RevolvedSurface surface(solids_[solid]);
  const double around_m = 2.0 * std::numbers::pi * surface.largest_radius_m();
  const auto steps = [spacing_m](double length, double least) {
    return static_cast<std::size_t>(std::max(least, std::ceil(length / spacing_m)));
  };
  SurfaceGrid grid;
  if (!(around_m > 0.0)) return grid;
  grid.columns = steps(around_m, kFewestAround);
  grid.rows = steps(surface.profile_length_m(), kFewestRings);
  std::vector<Eigen::Vector3d> outward;
  for (std::size_t k = 0; k < grid.columns; ++k) {
    outward.push_back(surface.Outward(2.0 * std::numbers::pi * static_cast<double>(k) /
                                      static_cast<double>(grid.columns)));
  }
  const std::size_t count = grid.rows * grid.columns;
  for (std::vector<double>* axis : {&grid.x, &grid.y, &grid.z}) axis->reserve(count);
  for (std::size_t row = 0; row < grid.rows; ++row) {
    const RevolvedSurface::Ring ring =
        surface.RingAt(surface.profile_length_m() * (static_cast<double>(row) + 0.5) /
                       static_cast<double>(grid.rows));
    for (const Eigen::Vector3d& direction : outward) {
      const Eigen::Vector3d point = ring.center_m + ring.radius_m * direction;
      grid.x.push_back(point.x());
      grid.y.push_back(point.y());
      grid.z.push_back(point.z());
    }
  }
  grid.depth.assign(count, std::numeric_limits<double>::infinity());
  grid.nearest.assign(count, -1.0);
  for (const std::int32_t other : neighbours_[solid]) {
    grid.Lower(tighten::DistanceKernel(solids_[other]), other);
  }
  return grid;
}

void BoundaryDistance::FindCreases(std::size_t solid, double spacing_m,
                                   std::vector<CreasePoint>& found) const {
  const SurfaceGrid grid = MakeGrid(solid, spacing_m);
  const auto is_exposed = [&](std::size_t i) { return grid.depth[i] >= -tolerance_m_; };
  const auto visit = [&](std::size_t p, std::size_t q) {
    if (is_exposed(p) == is_exposed(q)) return;
    if (!is_exposed(p)) std::swap(p, q);
    found.push_back(Between({grid.point(p), static_cast<std::int32_t>(solid),
                             static_cast<std::int32_t>(grid.nearest[q])},
                            grid.point(q)));
  };
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t k = 0; k < grid.columns; ++k) {
      const std::size_t at = row * grid.columns + k;
      visit(at, row * grid.columns + (k + 1) % grid.columns);
      if (row > 0) visit(at - grid.columns, at);
    }
  }
}

BoundaryDistance::CreasePoint BoundaryDistance::Between(const CreasePoint& exposed,
                                                        Eigen::Vector3d hidden) const {
  const TaperedCapsule& on = solids_[exposed.on];
  const TaperedCapsule& under = solids_[exposed.under];
  const double apart = (hidden - exposed.position_m).norm();
  CreasePoint result = exposed;
  result.position_m = OnBoth(on, under, 0.5 * (exposed.position_m + hidden));
  if ((result.position_m - exposed.position_m).norm() < apart &&
      std::abs(on.SignedDistance(result.position_m)) < tolerance_m_ &&
      IsExposed(result.position_m, result.on)) {
    return result;
  }
  // A third solid lies here, or the surfaces hardly cross: halve the way.
  result = exposed;
  for (int i = 0; i < kHalvings; ++i) {
    const Eigen::Vector3d between = 0.5 * (result.position_m + hidden);
    const geometry::CapsuleDistance off = on.Locate(between);
    const Eigen::Vector3d middle = between - off.distance_m * off.normal;
    std::int32_t deepest = -1;
    double depth = -tolerance_m_;
    for (const std::int32_t other : neighbours_[exposed.on]) {
      const double here = DepthAt(middle, other);
      if (here >= depth) continue;
      depth = here;
      deepest = other;
    }
    if (deepest < 0) {
      result.position_m = middle;
    } else {
      hidden = middle;
      result.under = deepest;
    }
  }
  return result;
}

std::vector<double> BoundaryDistance::SignedAt(std::span<const Eigen::Vector3d> points_m,
                                               const ThreadPool& pool) const {
  constexpr double kAnyDepth = -std::numeric_limits<double>::infinity();
  std::vector<double> distances(points_m.size(), std::numeric_limits<double>::infinity());
  if (solids_.empty()) return distances;
  const tighten::PointGrid grid(points_m);
  const tighten::UnionDistances nearest = grid.DistancesTo(solids_, kAnyDepth, pool);
  // The nearest points of the solids that are nearest, in the grid's order.
  std::vector<Eigen::Vector3d> feet_m(grid.size());
  pool.ForChunks(grid.size(), kPointsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const geometry::CapsuleDistance at = solids_[nearest.solid[i]].Locate(grid.point(i));
      distances[grid.order()[i]] = at.distance_m;
      feet_m[i] = grid.point(i) - at.distance_m * at.normal;
    }
  });
  if (creases_.empty()) return distances;
  const tighten::PointGrid feet(feet_m);
  const tighten::UnionDistances depths = feet.DistancesTo(solids_, -tolerance_m_, pool);
  pool.ForChunks(feet.size(), kPointsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t index = grid.order()[feet.order()[i]];
      if (depths.distance_m[i] >= -tolerance_m_ || distances[index] >= 0.0) continue;
      distances[index] = std::min(distances[index], -ToCrease(points_m[index]));
    }
  });
  return distances;
}

double BoundaryDistance::ToCrease(const Eigen::Vector3d& point_m) const {
  double squared_best = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  Search(point_m, 0, creases_.size(), squared_best, best);
  return Slide(point_m, creases_[best]);
}

double BoundaryDistance::Slide(const Eigen::Vector3d& point_m, const CreasePoint& start) const {
  const TaperedCapsule& on = solids_[start.on];
  const TaperedCapsule& under = solids_[start.under];
  Eigen::Vector3d at = start.position_m;
  double best = (point_m - at).norm();
  double share = 1.0;  // of the step to take; less after one that led off the boundary
  for (int i = 0; i < kSlides; ++i) {
    const Eigen::Vector3d along = on.Locate(at).normal.cross(under.Locate(at).normal);
    if (along.squaredNorm() < 1e-6) break;
    const Eigen::Vector3d step = along * (share * along.dot(point_m - at) / along.squaredNorm());
    const Eigen::Vector3d next = OnBoth(on, under, at + step);
    const double distance = (point_m - next).norm();
    // Every step taken ends on the boundary, so the result is never too small.
    if (distance >= best || !IsExposed(next, start.on)) {
      share *= 0.4;
      continue;
    }
    const bool is_settled = distance > best - tolerance_m_;
    at = next;
    best = distance;
    if (is_settled) break;
  }
  return best;
}

void BoundaryDistance::Sort(std::size_t begin, std::size_t end) {
  if (end - begin < 2) return;
  Eigen::AlignedBox3d box;
  for (std::size_t i = begin; i < end; ++i) box.extend(creases_[i].position_m);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  std::nth_element(creases_.begin() + static_cast<std::ptrdiff_t>(begin),
                   creases_.begin() + static_cast<std::ptrdiff_t>(middle),
                   creases_.begin() + static_cast<std::ptrdiff_t>(end),
                   [axis](const CreasePoint& a, const CreasePoint& b) {
                     return a.position_m[axis] < b.position_m[axis];
                   });
  split_axis_[middle] = static_cast<std::uint8_t>(axis);
  Sort(begin, middle);
  Sort(middle + 1, end);
}

void BoundaryDistance::Search(const Eigen::Vector3d& point_m, std::size_t begin, std::size_t end,
                              double& squared_best, std::size_t& best) const {
  if (begin >= end) return;
  const std::size_t middle = begin + (end - begin) / 2;
  const double squared = (creases_[middle].position_m - point_m).squaredNorm();
  if (squared < squared_best) {
    squared_best = squared;
    best = middle;
  }
  const double beyond =
      point_m[split_axis_[middle]] - creases_[middle].position_m[split_axis_[middle]];
  const bool is_low = beyond < 0.0;
  Search(point_m, is_low ? begin : middle + 1, is_low ? middle : end, squared_best, best);
  if (beyond * beyond >= squared_best) return;
  Search(point_m, is_low ? middle + 1 : begin, is_low ? end : middle, squared_best, best);
}

}  // namespace capfit::metrics
