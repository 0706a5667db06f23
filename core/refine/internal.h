// What the sources of this room share.
#ifndef CAPFIT_CORE_REFINE_INTERNAL_H_
#define CAPFIT_CORE_REFINE_INTERNAL_H_

#include <cmath>

namespace capfit::refine {

// No sphere gets smaller than this while it is refined.
inline constexpr double kLeastRadiusM = 0.003;

// Nor does a layout begin with a smaller one.
inline constexpr double kLeastHungRadiusM = 0.006;

// Up to here a change of topology is tried quickly.
inline constexpr int kFewPrimitives = 80;

// Of a whole: steps of so much spread evenly, however many there are.
inline constexpr double kGoldenShare = 0.6180339887498949;

// What is left of x above its next lower integer, in [0, 1).
[[nodiscard]] inline double Fraction(double x) { return x - std::floor(x); }

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_INTERNAL_H_
