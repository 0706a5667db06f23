// A circle together with the points it is responsible for.
#ifndef CAPFIT_CORE_CIRCLE_CLUSTER_H_
#define CAPFIT_CORE_CIRCLE_CLUSTER_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/circle/fit_circle.h"

namespace capfit::circle {

struct Cluster {
  Place place = Place::kFree;
  Circle circle;                      // of a pair: the one with x >= 0
  std::vector<Eigen::Vector2d> hull;  // of its points; the circle covers them
  std::vector<int> points;            // indices of the points assigned to it
  double outside_area_m2 = 0.0;       // of the one circle
};

[[nodiscard]] inline Circle Mirrored(const Circle& circle) {
  return {{-circle.center_m.x(), circle.center_m.y()}, circle.radius_m};
}

// How many circles a cluster stands for.
[[nodiscard]] inline int CircleCount(Place place) { return place == Place::kPaired ? 2 : 1; }

// All circles, the mirrored ones included: cluster by cluster, a pair's x >= 0 circle first.
[[nodiscard]] inline std::vector<Circle> AllCircles(std::span<const Cluster> clusters) {
  std::vector<Circle> circles;
  for (const Cluster& cluster : clusters) {
    circles.push_back(cluster.circle);
    if (cluster.place == Place::kPaired) circles.push_back(Mirrored(cluster.circle));
  }
  return circles;
}

}  // namespace capfit::circle

#endif  // CAPFIT_CORE_CIRCLE_CLUSTER_H_
