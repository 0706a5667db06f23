// Circles that cover an outline to the last point, not only at samples.
#ifndef CAPFIT_CORE_CIRCLE_COVER_OUTLINE_H_
#define CAPFIT_CORE_CIRCLE_COVER_OUTLINE_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/circle/cluster.h"
#include "core/section/polygon.h"

namespace capfit::circle {

// A stretch of an edge that no circle covers, or (begin = end) a corner of a hole inside.
struct Gap {
  Eigen::Vector2d begin_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d end_m = Eigen::Vector2d::Zero();
};

// What of the outline's inside and boundary is in no circle, circles taken up to twice
// `tolerance_m` larger. Exact: the polygon lies in the union if and only if every edge does and
// every point where two circles cross inside the polygon lies in a third one. O(circles * (edges +
// circles^2)).
[[nodiscard]] std::vector<Gap> FindGaps(std::span<const Circle> circles,
                                        const section::Polygon& outline, double tolerance_m);

// Moves and grows the clusters' circles, as little as it can, until FindGaps finds nothing at
// `tolerance_m` > 0: each gap goes to the circle that takes it in for the least outside area. The
// points that the clusters covered stay covered. `mirrored`: outline and clusters mirror in x = 0.
// `fitting_rounds`: in so many rounds circles are fitted anew to the middles of gaps; then, or with
// 0 at once, they only grow, which is quicker and wastes more.
void CloseGaps(const section::Polygon& outline, bool mirrored, int fitting_rounds,
               double tolerance_m, std::vector<Cluster>& clusters);

}  // namespace capfit::circle

#endif  // CAPFIT_CORE_CIRCLE_COVER_OUTLINE_H_
