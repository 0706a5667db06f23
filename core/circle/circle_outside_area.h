// Circle outside area, the error metric of the approximation (paper, III-B.1).
#ifndef CAPFIT_CORE_CIRCLE_CIRCLE_OUTSIDE_AREA_H_
#define CAPFIT_CORE_CIRCLE_CIRCLE_OUTSIDE_AREA_H_

#include <Eigen/Core>
#include <span>

#include "core/geometry/smallest_enclosing.h"
#include "core/section/polygon.h"

namespace capfit::circle {

using geometry::Circle;

// Area of the part of `circle` outside `outline` (paper, eq. 1), in square metres.
//
// Exact up to rounding: each edge is clipped by the circle and integrated in closed form, O(edges),
// no sampling. One formula serves centres inside, outside and on the outline, where the paper tells
// two cases apart (eqs. 3 to 5). The result lies in [0, pi r^2]; radius 0 gives 0. Where the
// outline crosses itself, area that it winds round twice counts twice as inside.
[[nodiscard]] double CircleOutsideArea(const Circle& circle, const section::Polygon& outline);

// The area with its derivatives, which cost nothing on top.
struct OutsideArea {
  double area_m2 = 0.0;
  Eigen::Vector2d by_center_m = Eigen::Vector2d::Zero();  // metres: square metres per metre
  double by_radius_m = 0.0;  // length of the circle's arcs outside the outline
};
[[nodiscard]] OutsideArea CircleOutsideAreaWithGradient(const Circle& circle,
                                                        const section::Polygon& outline);

}  // namespace capfit::circle

#endif  // CAPFIT_CORE_CIRCLE_CIRCLE_OUTSIDE_AREA_H_
