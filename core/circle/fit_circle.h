// The fitting step: the circle of least outside area around given points (paper, eq. 6).
#ifndef CAPFIT_CORE_CIRCLE_FIT_CIRCLE_H_
#define CAPFIT_CORE_CIRCLE_FIT_CIRCLE_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/geometry/smallest_enclosing.h"
#include "core/section/polygon.h"

namespace capfit::circle {

using geometry::Circle;

// Where a circle may lie: anywhere, as one of a pair that mirrors in x = 0, or centred on x = 0.
enum class Place { kFree, kPaired, kCentred };

struct CircleFit {
  Circle circle;
  double outside_area_m2 = 0.0;
};

// Corners of the convex hull of points that are sorted by x, then y. O(n).
[[nodiscard]] std::vector<Eigen::Vector2d> ConvexHull(
    std::span<const Eigen::Vector2d> sorted_points_m);

// Minimises the outside area over the centre, the radius being the least that covers `points_m`
// (their hull's corners are enough): a smooth area over a kinked radius. Sequential quadratic
// programming with the exact gradient: "the radius covers each point" is linearised, the curvature
// is learnt (damped BFGS), each step is a three-variable quadratic programme. Where the paper uses
// Powell's direction set, this needs about a tenth of the evaluations and does not stop at kinks.
//
// Never worse than the circle around `start_m`. `place` kCentred keeps the centre at x = 0. A step
// costs one to three evaluations of CircleOutsideAreaWithGradient.
[[nodiscard]] CircleFit FitCircle(const section::Polygon& outline,
                                  std::span<const Eigen::Vector2d> points_m,
                                  const Eigen::Vector2d& start_m, Place place, int max_steps);

}  // namespace capfit::circle

#endif  // CAPFIT_CORE_CIRCLE_FIT_CIRCLE_H_
