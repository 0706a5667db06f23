// The partitioning step: which circle covers which point (paper, III-B.2).
#ifndef CAPFIT_CORE_CIRCLE_PARTITION_H_
#define CAPFIT_CORE_CIRCLE_PARTITION_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/circle/fit_circle.h"
#include "core/section/polygon.h"

namespace capfit::circle {

// A circle before it has a radius.
struct Seed {
  Eigen::Vector2d center_m = Eigen::Vector2d::Zero();
  Place place = Place::kFree;
};

// For each point the index of the seed it is assigned to. All radii start at 0; points come in the
// order of their distance to the nearest seed, and each goes to the seed whose outside area grows
// least when its radius takes the point in (a pair counts twice). Points that fall inside circles
// already go to the nearest in power; further ties to the lower index.
//
// The area as a function of the radius is tabulated where it is asked for and interpolated by
// Hermite cubics (value and exact slope), which is far cheaper than one exact area for each point
// and seed: O(points * seeds + seeds * table * edges).
[[nodiscard]] std::vector<int> Partition(std::span<const Eigen::Vector2d> points_m,
                                         std::span<const Seed> seeds,
                                         const section::Polygon& outline);

}  // namespace capfit::circle

#endif  // CAPFIT_CORE_CIRCLE_PARTITION_H_
