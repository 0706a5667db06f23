// The points that an enclosing search works on: few, and with the area that each stands for.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_THINNED_POINTS_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_THINNED_POINTS_H_

#include <Eigen/Core>
#include <vector>

#include "core/tighten/cover_target.h"

namespace capfit::refine {

struct ThinnedPoints {
  std::vector<Eigen::Vector3d> points_m;
  std::vector<double> areas_m2;  // that each stands for
  double size_m = 0.0;           // of the body, the square root of its surface area
};

// `spacing` between the points, relative to the body's size; those of a symmetric body at x >= 0.
// Where vertices are further apart, points of the triangles between them too. O(points).
[[nodiscard]] ThinnedPoints ThinnedPointsOf(const tighten::CoverTarget& target, bool symmetric,
                                            double spacing);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_THINNED_POINTS_H_
