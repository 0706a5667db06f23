// Comparing what may be equal but for rounding.
#ifndef CAPFIT_CORE_BASE_TIES_H_
#define CAPFIT_CORE_BASE_TIES_H_

#include <cmath>

namespace capfit {

// Numbers that differ by less than this share of what they are measured by count as equal where
// something is chosen by them: distances to a circle that runs through points, costs of nothing.
inline constexpr double kTie = 1e-6;

// True where a is less than b by more than a millionth of b: a choice made by it does not fall out
// differently for input that differs by rounding, where two ways are equally good (two mirrored
// halves, one minimum found twice). b may be infinite.
[[nodiscard]] inline bool ClearlyLess(double a, double b) {
  return a < b && !(b - a < kTie * std::abs(b));
}

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_TIES_H_
