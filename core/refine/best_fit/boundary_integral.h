// How volume changes when spheres move and grow: integrals over the exposed boundary of the union.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_BOUNDARY_INTEGRAL_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_BOUNDARY_INTEGRAL_H_

#include <Eigen/Core>
#include <vector>

#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/occupancy_grid.h"
#include "core/refine/graph/cone.h"

namespace capfit::refine {

struct BoundaryOptions {
  double spacing_m = 0.011;  // between samples; the gradient's noise falls with its square
  // In [0, 1): shifts and turns all samples. A new one in every step keeps the search from fitting
  // itself to the samples.
  double phase = 0.5;
  // Weighs each sample by the cost of filling it: the gradient of E_r. Null: weight 1, the gradient
  // of the union's volume.
  const OccupancyGrid* body = nullptr;
  // Only primitives at these nodes are sampled. Null: all.
  const std::vector<char>* active = nullptr;
};

// Both by node; those of the images are folded onto the representatives and zero themselves.
struct BoundaryIntegral {
  // d/d(x, y, z, r) of the integral of the weight over the solid, m2.
  std::vector<Eigen::Vector4d> gradient_m2;
  std::vector<double> area_m2;  // exposed area, shared out like the gradient
};

// Exact for the continuous boundary (a moving surface sweeps weight * normal speed * area);
// sampled by rings on the sides and spirals on the ends. O(samples * overlapping primitives).
[[nodiscard]] BoundaryIntegral IntegrateBoundary(const capsule::MirroredSet& graph,
                                                 const std::vector<Cone>& cones,
                                                 const BoundaryOptions& options);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_BOUNDARY_INTEGRAL_H_
