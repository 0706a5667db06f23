// Compact clusters of the points of a head, a hand or a foot.
#ifndef CAPFIT_CORE_CAPSULE_POINT_CLUSTERS_H_
#define CAPFIT_CORE_CAPSULE_POINT_CLUSTERS_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/geometry/sphere.h"

namespace capfit::capsule {

struct PointCluster {
  std::vector<Eigen::Vector3d> points_m;
  geometry::Sphere ball;  // the smallest around them; its centre then moved to the plane, if any
};

// The points in `count` clusters, or in fewer where there are not as many distinct ones: first one
// of all, then, as often as needed, the widest is halved across its longest extent and each point
// goes to the nearest centre. Centres are those of smallest enclosing balls: means would be drawn
// to where points are close together. `normal` is zero or a unit vector: then centres are in the
// plane through the origin across it, and halves are parted within that plane. O(points * count).
[[nodiscard]] std::vector<PointCluster> ClustersOf(std::span<const Eigen::Vector3d> points_m,
                                                   int count, const Eigen::Vector3d& normal);

}  // namespace capfit::capsule

#endif  // CAPFIT_CORE_CAPSULE_POINT_CLUSTERS_H_
