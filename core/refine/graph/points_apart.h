// A few of many points, the best ones, that do not lie together.
#ifndef CAPFIT_CORE_REFINE_GRAPH_POINTS_APART_H_
#define CAPFIT_CORE_REFINE_GRAPH_POINTS_APART_H_

#include <Eigen/Core>
#include <vector>

namespace capfit::refine {

// The first `count` points in falling order of score that keep `apart_m` from all earlier ones;
// scores of 0 and less are left out. Ties go to the lower index.
[[nodiscard]] std::vector<Eigen::Vector3d> BestApart(const std::vector<Eigen::Vector3d>& points_m,
                                                     const std::vector<double>& scores,
                                                     double apart_m, int count);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_GRAPH_POINTS_APART_H_
