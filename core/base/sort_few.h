// Sorting where there are mostly a handful.
#ifndef CAPFIT_CORE_BASE_SORT_FEW_H_
#define CAPFIT_CORE_BASE_SORT_FEW_H_

#include <algorithm>
#include <cstddef>
#include <span>

namespace capfit {

// As std::sort, of plain numbers. The usual handful is sorted by insertion that does not stop at
// the right place: to go on costs less than a branch that is guessed wrong half of the time.
// Thousands, as at the hub of a wheel, need better.
template <typename Number>
inline void SortFew(std::span<Number> values) {
  if (values.size() > 16) {
    std::sort(values.begin(), values.end());
    return;
  }
  for (std::size_t i = 1; i < values.size(); ++i) {
    Number least = values[i];
    for (std::size_t k = i; k > 0; --k) {
      const Number before = values[k - 1];
      values[k] = before < least ? least : before;
      least = before < least ? before : least;
    }
    values[0] = least;
  }
}

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_SORT_FEW_H_
