#include "core/base/did_you_mean.h"

#include <algorithm>

namespace capfit {

int EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::vector<int>> cost(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t k = 0; k <= b.size(); ++k) {
      if (i == 0 || k == 0) {
        cost[i][k] = static_cast<int>(i + k);
        continue;
      }
      cost[i][k] = std::min({cost[i - 1][k] + 1, cost[i][k - 1] + 1,
                             cost[i - 1][k - 1] + (a[i - 1] == b[k - 1] ? 0 : 1)});
      if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1]) {
        cost[i][k] = std::min(cost[i][k], cost[i - 2][k - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

const std::string* NearestOf(const std::string& word, const std::vector<std::string>& known) {
  const std::string* nearest = nullptr;
  int least = 1 + std::max(1, static_cast<int>(word.size()) / 3);
  for (const std::string& one : known) {
    const bool is_begun = word.size() >= 3 && one.compare(0, word.size(), word) == 0;
    const int distance = is_begun ? 0 : EditDistance(word, one);
    if (distance >= least) continue;
    least = distance;
    nearest = &one;
  }
  return nearest;
}

std::string DidYouMean(const std::string& word, const std::vector<std::string>& known) {
  const std::string* const nearest = NearestOf(word, known);
  return nearest == nullptr ? "" : "; did you mean " + *nearest + "?";
}

}  // namespace capfit
