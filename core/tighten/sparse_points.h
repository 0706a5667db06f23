// A few points that stand for all of a surface, without a choice that could fall out differently.
#ifndef CAPFIT_CORE_TIGHTEN_SPARSE_POINTS_H_
#define CAPFIT_CORE_TIGHTEN_SPARSE_POINTS_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"

namespace capfit::tighten {

struct SparsePoints {
  std::vector<Eigen::Vector3d> points_m;
  std::vector<double> weights;  // of the points each stands for, summed
};

// About a point for each square of `spacing_m` of the surface: each the mean of the points around a
// node of a grid, nearer ones counting more, up to none a spacing away. So the result moves
// smoothly with the points, whatever cell they come to lie in; it lies a little inside of a convex
// surface (0.7 mm on a sphere of 50 mm at a spacing of 20). O(points).
[[nodiscard]] SparsePoints MakeSparse(std::span<const Eigen::Vector3d> points_m,
                                      std::span<const double> weights, double spacing_m,
                                      const ThreadPool& pool = ThreadPool(1));

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_SPARSE_POINTS_H_
