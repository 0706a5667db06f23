// What a search for the tightest set is asked.
#ifndef CAPFIT_CORE_REFINE_REFINE_OPTIONS_H_
#define CAPFIT_CORE_REFINE_REFINE_OPTIONS_H_

#include <cstdint>

#include "core/body/body.h"
#include "core/capsule/budget.h"

namespace capfit::refine {

struct RefineOptions {
  // True: the selected parts are inside but for a little that coverage takes in, without
  // loosening the set again. False: the smallest E_r.
  bool enclose = true;
  capsule::Budget budget;    // at least 3 spheres' worth
  double tolerance_m = 0.0;  // how far a vertex may stick out when enclosing; [0, 0.1]
  body::PartSelection parts;
  // False: one round, in place of three to eight, that improves what the layouts lead to, and one
  // exchange or none in a best fit: less than half the time, and some hundredths more E_r.
  bool thorough = true;
  // The set is to be carried to other poses. What a thorough search wins last it wins by hugging
  // the pose at hand: of E_r .5 % less in that pose and 1 % more in others.
  bool will_move = false;
  std::uint64_t seed = 0;  // of the best fit's samples
};

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_REFINE_OPTIONS_H_
