// Smallest circle and smallest ball around points (Welzl 1991; the paper's one-circle fit, III-B,
// and its head, hands and feet, III-C).
#ifndef CAPFIT_CORE_GEOMETRY_SMALLEST_ENCLOSING_H_
#define CAPFIT_CORE_GEOMETRY_SMALLEST_ENCLOSING_H_

#include <Eigen/Core>
#include <span>

#include "core/geometry/sphere.h"

namespace capfit::geometry {

// A disc in the plane of its section.
struct Circle {
  Eigen::Vector2d center_m = Eigen::Vector2d::Zero();  // section frame, metres
  double radius_m = 0.0;                               // >= 0
};

// The smallest circle that contains all points, to 1e-12 relative: no point is further from the
// centre than the radius, computed as (point - center).norm(). Deterministic. Points may repeat,
// lie on a line or on a common circle. Welzl's problem with Gaertner's pivoting (the furthest
// point enters next): a few passes over the points. No points: radius 0 at the origin.
[[nodiscard]] Circle SmallestEnclosingCircle(std::span<const Eigen::Vector2d> points_m);

// The smallest ball that contains all points, likewise.
[[nodiscard]] Sphere SmallestEnclosingBall(std::span<const Eigen::Vector3d> points_m);

}  // namespace capfit::geometry

#endif  // CAPFIT_CORE_GEOMETRY_SMALLEST_ENCLOSING_H_
