// What a budget still allows when no more circles can be bought: capsules cut in two.
#ifndef CAPFIT_CORE_PIPELINE_SPEND_REST_H_
#define CAPFIT_CORE_PIPELINE_SPEND_REST_H_

#include "core/capsule/primitive_set.h"

namespace capfit::pipeline {

// Cuts the capsules with most surface in two, by a sphere in their middle that changes nothing yet:
// coverage then moves it to where it serves. A cut costs one sphere and one capsule, a mirrored
// pair of cuts twice that. Stops when no cut fits into `budget`, what the whole set may have.
// Either half of a cut capsule counts as a quarter of it.
void SpendRest(const capsule::Budget& budget, capsule::PrimitiveSet& set);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_SPEND_REST_H_
