#include "core/refine/graph/points_apart.h"

#include <algorithm>
#include <cstddef>

namespace capfit::refine {

std::vector<Eigen::Vector3d> BestApart(const std::vector<Eigen::Vector3d>& points_m,
                                       const std::vector<double>& scores, double apart_m,
                                       int count) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (scores[i] > 0.0) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return scores[a] != scores[b] ? scores[a] > scores[b] : a < b;
  });
  std::vector<Eigen::Vector3d> chosen;
  for (const std::size_t i : order) {
    if (static_cast<int>(chosen.size()) >= count) break;
    const bool apart = std::all_of(chosen.begin(), chosen.end(), [&](const Eigen::Vector3d& p) {
      return (p - points_m[i]).norm() >= apart_m;
    });
    if (apart) chosen.push_back(points_m[i]);
  }
  return chosen;
}

}  // namespace capfit::refine
