// Points of a surface that tell whether it is covered.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_THIN_OUT_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_THIN_OUT_H_

#include <Eigen/Core>
#include <span>
#include <vector>

namespace capfit::refine {

// Of each cell of `cell_m` only the points that are furthest out along one of 26 directions: hulls
// that hold these hold nearly all. (tighten::MakeSparse instead gives means, which follow the
// surface smoothly and lie a little inside of it.) O(n log n).
[[nodiscard]] std::vector<Eigen::Vector3f> ThinOut(std::span<const Eigen::Vector3f> points,
                                                   double cell_m);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_THIN_OUT_H_
