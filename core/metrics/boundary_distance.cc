#include "core/metrics/boundary_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/metrics/revolved_surface.h"

namespace capfit::metrics {
namespace {

// A surface point counts as hidden when it is deeper in another solid than this share of the set's
// size; far above rounding, far below what can be seen.
constexpr double kHiddenShare = 1e-6;
// Halvings between a grid's exposed and hidden point: 10 mm become 0.04 mm.
constexpr int kHalvings = 8;
constexpr int kSlides = 10;
constexpr int kFewestAround = 12;

double SizeOf(std::span<const geometry::TaperedCapsule> solids) {
  Eigen::AlignedBox3d box;
  double radius = 0.0;
  for (const geometry::TaperedCapsule& solid : solids) {
    box.extend(solid.a().center_m);
    box.extend(solid.b().center_m);
    radius = std::max({radius, solid.a().radius_m, solid.b().radius_m});
  }
  return solids.empty() ? 0.0 : box.diagonal().norm() + 2.0 * radius;
}

double GridArea(const geometry::TaperedCapsule& solid) {
  const RevolvedSurface surface(solid);
  return surface.profile_length_m() * 2.0 * std::numbers::pi * surface.largest_radius_m();
}

// The point near `start` that is on both surfaces: Newton, least movement.
Eigen::Vector3d OnBoth(const geometry::TaperedCapsule& first,
                       const geometry::TaperedCapsule& second, Eigen::Vector3d point) {
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

}  // namespace

BoundaryDistance::BoundaryDistance(const UnionDistance& set, int grid_points,
                                   const ThreadPool& pool)
    : set_(set), tolerance_m_(kHiddenShare * SizeOf(set.solids())) {
  double area = 0.0;
  for (const geometry::TaperedCapsule& solid : set_.solids()) area += GridArea(solid);
  const double spacing_m = std::sqrt(area / grid_points);
  std::vector<std::vector<CreasePoint>> found(set_.solids().size());
  pool.ForEach(found.size(), [&](std::size_t i) { FindCreases(i, spacing_m, found[i]); });
  for (const std::vector<CreasePoint>& points : found) {
    creases_.insert(creases_.end(), points.begin(), points.end());
  }
  split_axis_.resize(creases_.size());
  Sort(0, creases_.size());
}

bool BoundaryDistance::IsExposed(const Eigen::Vector3d& point_m) const {
  return set_.At(point_m, -tolerance_m_).distance_m >= -tolerance_m_;
}

void BoundaryDistance::FindCreases(std::size_t solid, double spacing_m,
                                   std::vector<CreasePoint>& found) const {
  const RevolvedSurface surface(set_.solids()[solid]);
  const double around_m = 2.0 * std::numbers::pi * surface.largest_radius_m();
  if (!(around_m > 0.0)) return;
  const int columns = std::max(kFewestAround, static_cast<int>(std::ceil(around_m / spacing_m)));
  const int rows = std::max(4, static_cast<int>(std::ceil(surface.profile_length_m() / spacing_m)));
  const auto place = [&](int row, int column) {
    return Eigen::Vector2d(surface.profile_length_m() * (row + 0.5) / rows,
                           2.0 * std::numbers::pi * column / columns);
  };
  std::vector<bool> above;
  std::vector<bool> exposed(static_cast<std::size_t>(columns));
  const auto visit = [&](const Eigen::Vector2d& p, bool is_p, const Eigen::Vector2d& q, bool is_q) {
    if (is_p != is_q) found.push_back(is_p ? Bisect(solid, p, q) : Bisect(solid, q, p));
  };
  for (int row = 0; row < rows; ++row) {
    for (int k = 0; k < columns; ++k) {
      const Eigen::Vector2d at = place(row, k);
      exposed[k] = IsExposed(surface.At(at.x(), at.y()));
    }
    for (int k = 0; k < columns; ++k) {
      // The neighbour beyond the last column is the first, one turn further.
      visit(place(row, k), exposed[k], place(row, k + 1), exposed[(k + 1) % columns]);
      if (row > 0) visit(place(row - 1, k), above[k], place(row, k), exposed[k]);
    }
    above = exposed;
  }
}

BoundaryDistance::CreasePoint BoundaryDistance::Bisect(std::size_t solid, Eigen::Vector2d exposed,
                                                       Eigen::Vector2d hidden) const {
  const RevolvedSurface surface(set_.solids()[solid]);
  CreasePoint result;
  result.on = static_cast<std::int32_t>(solid);
  result.under = set_.At(surface.At(hidden.x(), hidden.y())).solid;
  for (int i = 0; i < kHalvings; ++i) {
    const Eigen::Vector2d middle = 0.5 * (exposed + hidden);
    const UnionDistance::Nearest nearest = set_.At(surface.At(middle.x(), middle.y()));
    if (nearest.distance_m >= -tolerance_m_) {
      exposed = middle;
    } else {
      hidden = middle;
      result.under = nearest.solid;
    }
  }
  result.position_m = surface.At(exposed.x(), exposed.y());
  return result;
}

double BoundaryDistance::SignedAt(const Eigen::Vector3d& point_m) const {
  const UnionDistance::Nearest nearest = set_.At(point_m);
  if (nearest.distance_m >= 0.0) return nearest.distance_m;
  const geometry::CapsuleDistance deepest = set_.solids()[nearest.solid].Locate(point_m);
  const double depth = -nearest.distance_m;
  const Eigen::Vector3d foot = point_m + depth * deepest.normal;
  if (creases_.empty() || IsExposed(foot)) return -depth;
  double squared_best = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  Search(point_m, 0, creases_.size(), squared_best, best);
  return -std::max(depth, Slide(point_m, creases_[best]));
}

double BoundaryDistance::Slide(const Eigen::Vector3d& point_m, const CreasePoint& start) const {
  const geometry::TaperedCapsule& on = set_.solids()[start.on];
  const geometry::TaperedCapsule& under = set_.solids()[start.under];
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
    if (distance >= best || !IsExposed(next)) {
      share *= 0.4;
      continue;
    }
    const bool is_settled = distance > best - 0.1 * tolerance_m_;
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
