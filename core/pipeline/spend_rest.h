// What a budget still allows when no more circles can be bought: capsules cut in two.
#ifndef CAPFIT_CORE_PIPELINE_SPEND_REST_H_
#define CAPFIT_CORE_PIPELINE_SPEND_REST_H_

#include <vector>

#include "core/capsule/primitive_set.h"

namespace capfit::pipeline {

// What may still be spent, at most of each.
struct Spare {
  int spheres = 0;
  int capsules = 0;
  int primitives = 0;
};

// Cuts the capsules in two that promise most by it, by a sphere in their middle that changes
// nothing yet: coverage then moves it to where it serves. A cut costs one sphere and one capsule, a
// mirrored pair of cuts twice that. Stops when fewer than a cut's worth is left of either.
// `promise` has a number for each capsule, such as the volume between it and the body; either half
// of a cut one is taken to promise a quarter of it.
void CutWherePromising(Spare spare, std::vector<double> promise, capsule::PrimitiveSet& set);

// The same, most surface first.
void SpendRest(Spare spare, capsule::PrimitiveSet& set);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_SPEND_REST_H_
