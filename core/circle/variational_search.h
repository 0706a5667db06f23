// Lloyd iteration with teleportation (paper, III-B.2): several local minima, the best one kept.
#ifndef CAPFIT_CORE_CIRCLE_VARIATIONAL_SEARCH_H_
#define CAPFIT_CORE_CIRCLE_VARIATIONAL_SEARCH_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/circle/approximate_polygon.h"
#include "core/circle/cluster.h"
#include "core/section/polygon.h"

namespace capfit::circle {

// What a search has to cover, and how its circles may lie.
struct Region {
  enum class Kind {
    kWhole,   // free circles
    kFolded,  // mirrors in x = 0: points with x >= 0 only; pairs and centred circles
    kHalf     // one of two mirrored pieces, the one with x >= 0: pairs only
  };
  Kind kind = Kind::kWhole;
  std::vector<Eigen::Vector2d> points_m;  // sorted by x, then y
  // Same size: which of the boundary's points each is, -1 for points of the interior.
  std::vector<int> place_on_boundary;
  int last_on_boundary = -1;
};

// Keeps the points that `region.kind` asks for and sorts them.
[[nodiscard]] Region MakeRegion(Region::Kind kind, std::span<const Eigen::Vector2d> boundary_m,
                                std::span<const Eigen::Vector2d> interior_m);

// Covers the region's points with `circle_count` circles (kHalf: an even number). Outside areas are
// those of the whole `outline`. The rounds work on every fourth point and vertex of the outline, of
// more than three circles on every other, which is as good a guide; then all points go to the
// nearest circles, which are fitted to them. Every cluster has a point unless there are fewer
// points than circles. Deterministic for options.seed; stops early when the observer says so.
[[nodiscard]] std::vector<Cluster> SearchClusters(const Region& region,
                                                  const section::Polygon& outline, int circle_count,
                                                  const CircleOptions& options,
                                                  const FitObserver& observer);

// Outside area of all circles: eq. 2, pairs counted twice.
[[nodiscard]] double OutsideAreaSum(std::span<const Cluster> clusters);

}  // namespace capfit::circle

#endif  // CAPFIT_CORE_CIRCLE_VARIATIONAL_SEARCH_H_
