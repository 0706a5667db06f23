// A set whose topology is given, settled for the smallest E_r.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_SETTLE_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_SETTLE_H_

#include <cstdint>

#include "core/base/fit_observer.h"
#include "core/body/body.h"
#include "core/capsule/primitive_set.h"
#include "core/refine/best_fit/occupancy_grid.h"

namespace capfit::refine {

// The grid that SettleBestFit takes; made once for several settlings.
[[nodiscard]] OccupancyGrid BestFitGrid(const body::Body& body, const body::PartSelection& parts);

// Moves and grows the spheres of `set` for the smallest E_r; which spheres are joined stays, but
// for capsules swallowed by an end and lone spheres inside others, which go. Spheres keep their
// origins (indices of mirrored spheres follow). A set whose spheres all name their images on a
// symmetric body gets exactly symmetric. `first_rate_m`: how far a step moves at first; 8 mm for a
// start made for something else, 3 mm after small changes. About 40 ms at 64 primitives, less when
// the observer cancels.
[[nodiscard]] capsule::PrimitiveSet SettleBestFit(const OccupancyGrid& grid, double first_rate_m,
                                                  std::uint64_t seed, const FitObserver& observer,
                                                  capsule::PrimitiveSet set);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_SETTLE_H_
