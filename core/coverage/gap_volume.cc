#include "core/coverage/gap_volume.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/coverage/point_grid.h"

namespace capfit::coverage {
namespace {

std::vector<double> AreasAround(const CoverTarget& target) {
  std::vector<double> areas(target.points_m.size(), 0.0);
  for (const mesh::Triangle& t : target.triangles) {
    const Eigen::Vector3d& a = target.points_m[t[0]];
    const double area = 0.5 * (target.points_m[t[1]] - a).cross(target.points_m[t[2]] - a).norm();
    for (const std::uint32_t corner : t) areas[corner] += area / 3.0;
  }
  return areas;
}

}  // namespace

std::vector<double> GapVolumes(const CoverTarget& target, const capsule::PrimitiveSet& set,
                               const ThreadPool& pool) {
  std::vector<double> volumes(set.capsules.size(), 0.0);
  if (target.points_m.empty() || set.spheres.empty()) return volumes;
  const std::vector<double> areas = AreasAround(target);
  const PointGrid grid(target.points_m);
  // Capsules come first among the solids.
  const UnionDistances at =
      grid.DistancesTo(capsule::Solids(set), -std::numeric_limits<double>::infinity(), pool);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const auto solid = static_cast<std::size_t>(at.solid[i]);
    if (solid >= volumes.size()) continue;
    volumes[solid] += areas[grid.order()[i]] * std::max(0.0, -at.distance_m[i]);
  }
  return volumes;
}

}  // namespace capfit::coverage
