#include "core/body/cleft.h"

#include <algorithm>
#include <queue>
#include <utility>
#include <vector>

namespace capfit::body {

// Floods from `a`, always over the outermost vertex on the shore; the lowest it had to go when it
// arrives at `b` is the cleft.
std::optional<std::uint32_t> FindCleft(std::span<const Eigen::Vector3d> points,
                                       const SurfaceGraph& graph, std::uint32_t a, std::uint32_t b,
                                       const Eigen::Vector3d& outward,
                                       const geometry::Sphere& region) {
  std::vector<char> seen(points.size(), 0);
  std::priority_queue<std::pair<double, std::uint32_t>> shore;
  bool is_joined = false;
  std::uint32_t cleft = a;
  double level = outward.dot(points[a]);
  shore.emplace(level, a);
  seen[a] = 1;
  while (!shore.empty()) {
    const auto [height, vertex] = shore.top();
    shore.pop();
    if (height < level) {
      level = height;
      cleft = vertex;
    }
    is_joined = vertex == b;
    if (is_joined) break;
    for (const std::uint32_t n : graph.Neighbours(vertex)) {
      if (seen[n] || geometry::SignedDistance(region, points[n]) > 0.0) continue;
      seen[n] = 1;
      shore.emplace(outward.dot(points[n]), n);
    }
  }
  if (!is_joined || cleft == a || cleft == b) return std::nullopt;
  return cleft;
}

}  // namespace capfit::body
