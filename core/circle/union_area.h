// Areas of several circles together, by their exposed arcs.
#ifndef CAPFIT_CORE_CIRCLE_UNION_AREA_H_
#define CAPFIT_CORE_CIRCLE_UNION_AREA_H_

#include <span>
#include <vector>

#include "core/geometry/smallest_enclosing.h"
#include "core/section/polygon.h"

namespace capfit::circle {

using geometry::Circle;

// Area of the union of the circles, exact up to rounding. O(n^2 log n).
[[nodiscard]] double UnionArea(std::span<const Circle> circles);

// Area of the union of the circles outside `outline`: what several circles share counts once, in
// contrast to the sum of eq. 2. Exact up to rounding. O(n^2 log n + arcs * edges).
[[nodiscard]] double UnionOutsideArea(std::span<const Circle> circles,
                                      const section::Polygon& outline);

// Share of each circle's area that lies in at least one of the others, in [0, 1] (paper, III-B.2,
// teleportation; a circle of radius 0 has 1). O(n^3 log n).
[[nodiscard]] std::vector<double> OverlapRatios(std::span<const Circle> circles);

}  // namespace capfit::circle

#endif  // CAPFIT_CORE_CIRCLE_UNION_AREA_H_
