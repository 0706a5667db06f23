#include "core/geometry/smallest_enclosing.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace capfit::geometry {
namespace {

template <int kDim>
using Point = Eigen::Matrix<double, kDim, 1>;

template <int kDim>
struct Ball {
  Point<kDim> center = Point<kDim>::Zero();
  double radius = 0.0;
};

// The points that determine a ball: at most kDim + 1, and one more while that one enters.
template <int kDim>
struct Support {
  Support() { points.fill(Point<kDim>::Zero()); }
  std::array<Point<kDim>, kDim + 2> points;
  int size = 0;
};

template <int kDim>
double FurthestDistance(const Support<kDim>& support, const Point<kDim>& center) {
  double squared = 0.0;
  for (int i = 0; i < support.size; ++i) {
    squared = std::max(squared, (support.points[i] - center).squaredNorm());
  }
  return std::sqrt(squared);
}

// Centre of the smallest sphere through the chosen points, in the flat they span; false where they
// are dependent (their ball is then that of fewer of them).
template <int kDim>
bool Circumcenter(const Support<kDim>& support, unsigned chosen, Point<kDim>& center) {
  std::array<Point<kDim>, kDim + 1> edges;
  edges.fill(Point<kDim>::Zero());
  Point<kDim> first = Point<kDim>::Zero();
  int count = -1;
  for (int i = 0; i < support.size; ++i) {
    if ((chosen >> i & 1u) == 0) continue;
    if (count < 0) {
      first = support.points[i];
    } else {
      edges[count] = support.points[i] - first;
    }
    ++count;
  }
  center = first;
  if (count == 0) return true;
  Eigen::Matrix<double, kDim, kDim> gram = Eigen::Matrix<double, kDim, kDim>::Identity();
  Point<kDim> half_squares = Point<kDim>::Zero();
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) gram(i, j) = edges[i].dot(edges[j]);
    half_squares[i] = 0.5 * gram(i, i);
  }
  const Eigen::FullPivLU<Eigen::Matrix<double, kDim, kDim>> lu(gram);
  if (!lu.isInvertible()) return false;
  const Point<kDim> weights = lu.solve(half_squares);
  for (int i = 0; i < count; ++i) center += weights[i] * edges[i];
  return center.allFinite();
}

// The smallest ball around the support, whose last point has just entered. The right centre is the
// circumcentre of some subset, and every other centre needs a larger radius: so take the least,
// with no tolerance to choose.
template <int kDim>
Ball<kDim> Reduce(Support<kDim>& support) {
  Ball<kDim> best;
  best.radius = std::numeric_limits<double>::infinity();
  unsigned best_subset = 0;
  const unsigned newest = 1u << (support.size - 1);
  for (unsigned subset = newest; subset < 2 * newest; ++subset) {
    if (__builtin_popcount(subset) > kDim + 1) continue;
    Point<kDim> center;
    if (!Circumcenter(support, subset, center)) continue;
    const double radius = FurthestDistance(support, center);
    if (radius < best.radius) {
      best = {center, radius};
      best_subset = subset;
    }
  }
  Support<kDim> kept;
  for (int i = 0; i < support.size; ++i) {
    if (best_subset >> i & 1u) kept.points[kept.size++] = support.points[i];
  }
  support = kept;
  return best;
}

template <int kDim>
std::size_t FurthestFrom(std::span<const Point<kDim>> points, const Point<kDim>& center) {
  std::size_t furthest = 0;
  double squared = -1.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double candidate = (points[i] - center).squaredNorm();
    if (candidate > squared) {
      squared = candidate;
      furthest = i;
    }
  }
  return furthest;
}

template <int kDim>
Ball<kDim> SmallestEnclosing(std::span<const Point<kDim>> points) {
  if (points.empty()) return {};
  Support<kDim> support;
  support.points[support.size++] = points[0];
  Ball<kDim> ball{points[0], 0.0};
  for (;;) {
    const Point<kDim>& furthest = points[FurthestFrom(points, ball.center)];
    if ((furthest - ball.center).norm() <= ball.radius) return ball;
    Support<kDim> next_support = support;
    next_support.points[next_support.size++] = furthest;
    const Ball<kDim> next = Reduce(next_support);
    // Each ball is the smallest of its support and larger than the one before, so no support comes
    // back. Only rounding ends it otherwise: then what is missing is the last digit.
    if (!(next.radius > ball.radius)) break;
    support = next_support;
    ball = next;
  }
  ball.radius = (points[FurthestFrom(points, ball.center)] - ball.center).norm();
  return ball;
}

}  // namespace

Circle SmallestEnclosingCircle(std::span<const Eigen::Vector2d> points_m) {
  const Ball<2> ball = SmallestEnclosing<2>(points_m);
  return {ball.center, ball.radius};
}

Sphere SmallestEnclosingBall(std::span<const Eigen::Vector3d> points_m) {
  const Ball<3> ball = SmallestEnclosing<3>(points_m);
  return {ball.center, ball.radius};
}

}  // namespace capfit::geometry
