// What a best fit leaves out by far: the part of its objective that is no volume.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_FAR_MISSES_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_FAR_MISSES_H_

#include <vector>

#include "core/capsule/mirrored_set.h"
#include "core/tighten/point_grid.h"

namespace capfit::refine {

// What is left out further than this counts beside E_r, so that a body keeps its forearms and
// hands: a mean miss of 1 cm over the surface as much as a tenth of the volume.
inline constexpr double kFarMissM = 0.04;

// The points of the fitted surface (at x >= 0 for mirrored sets), and how far one may stick out.
struct SurfacePoints {
  tighten::PointGrid grid;
  double allowed_m = 0.0;
};

// How far each point sticks out of the set beyond what is allowed, in the grid's order; some number
// <= 0 inside.
[[nodiscard]] std::vector<double> ExcessOf(const SurfacePoints& points,
                                           const capsule::MirroredSet& graph);

// How much further out than kFarMissM each point is; 0 within.
[[nodiscard]] std::vector<double> FarMisses(const SurfacePoints& points,
                                            const capsule::MirroredSet& graph);

// What a sum of misses, in metres, counts beside E_r.
[[nodiscard]] double MissPenalty(const SurfacePoints& points, double miss_m);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_FAR_MISSES_H_
