// The word that was meant.
#ifndef CAPFIT_CORE_BASE_DID_YOU_MEAN_H_
#define CAPFIT_CORE_BASE_DID_YOU_MEAN_H_

#include <string>
#include <vector>

namespace capfit {

// How many letters must be changed, added, left out or swapped with their neighbour.
[[nodiscard]] int EditDistance(const std::string& a, const std::string& b);

// The nearest of `known` that `word` begins, or that is at most a third of its letters away;
// nullptr where none is.
[[nodiscard]] const std::string* NearestOf(const std::string& word,
                                           const std::vector<std::string>& known);

// "; did you mean approximate?" for that; "" where none is.
[[nodiscard]] std::string DidYouMean(const std::string& word,
                                     const std::vector<std::string>& known);

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_DID_YOU_MEAN_H_
