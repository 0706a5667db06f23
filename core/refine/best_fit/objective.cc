#include "core/refine/best_fit/objective.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

Eigen::AlignedBox3d ReachOf(const capsule::MirroredSet& graph, const std::vector<char>& active) {
  constexpr double kMarginM = 0.02;
  Eigen::AlignedBox3d box;
  const auto add = [&](int v) {
    const geometry::Sphere& node = graph.sphere(v);
    Eigen::Vector3d center = node.center_m;
    if (graph.is_mirrored()) center.x() = std::abs(center.x());
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(node.radius_m + kMarginM);
    box.extend(center - reach);
    box.extend(center + reach);
  };
  for (const capsule::CapsuleEnds& e : graph.capsules()) {
    if (!active[static_cast<std::size_t>(e[0])] && !active[static_cast<std::size_t>(e[1])])
      continue;
    add(e[0]);
    add(e[1]);
  }
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (active[static_cast<std::size_t>(v)]) add(v);
  }
  return box;
}

}  // namespace capfit::refine
