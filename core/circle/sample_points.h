// The points that circles are asked to cover: the outline's vertices and a grid inside (paper,
// III-B.2, initialization).
#ifndef CAPFIT_CORE_CIRCLE_SAMPLE_POINTS_H_
#define CAPFIT_CORE_CIRCLE_SAMPLE_POINTS_H_

#include <Eigen/Core>
#include <vector>

#include "core/section/polygon.h"

namespace capfit::circle {

// Centres of the cells of a square grid that lie inside the outline, row by row (scan conversion):
// about `count` of them. The grid's columns mirror in x = 0, so a mirrored outline gets mirrored
// points. O(rows * edges).
[[nodiscard]] std::vector<Eigen::Vector2d> InteriorPoints(const section::Polygon& outline,
                                                          int count);

}  // namespace capfit::circle

#endif  // CAPFIT_CORE_CIRCLE_SAMPLE_POINTS_H_
