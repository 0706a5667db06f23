// The set of a given topology with the smallest E_r: gradient descent on sampled boundaries.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_DESCENT_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_DESCENT_H_

#include <cstdint>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/occupancy_grid.h"

namespace capfit::refine {

struct BestFitOptions {
  int steps = 100;
  double first_rate_m = 0.008;   // how far a step moves at first: 8 mm from a rough start, 3 from
  double last_rate_m = 0.00015;  // a good one; cosine in between
  double spacing_m = 0.024;      // of the boundary samples, drawn anew in every step
  std::uint64_t seed = 0;
  // Only these nodes move. Null: all.
  const std::vector<char>* active = nullptr;
};

// Adam, with one second moment per centre and one step for centre and radius alike. The gradient
// is exact for the continuous boundary. Symmetric graphs stay so bit for bit. About 0.1 ms a step
// at 64 primitives; no further step once the observer cancels.
void DescendBestFit(const OccupancyGrid& grid, const BestFitOptions& options,
                    const ThreadPool& pool, const FitObserver& observer,
                    capsule::MirroredSet& graph);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_DESCENT_H_
