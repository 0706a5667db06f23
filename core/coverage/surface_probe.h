// What lies between the vertices: how far triangles stick out of the set, proved.
#ifndef CAPFIT_CORE_COVERAGE_SURFACE_PROBE_H_
#define CAPFIT_CORE_COVERAGE_SURFACE_PROBE_H_

#include <Eigen/Core>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/coverage/cover_body.h"
#include "core/tighten/point_grid.h"

namespace capfit::coverage {

// Points inside triangles that are more than `asked_m` outside all solids, one or a few for each
// triangle of which it cannot be proved that nothing of it is more than `max_gap_m` outside;
// asked_m < max_gap_m. None: proved for all triangles. Triangles with a corner that far out are
// left alone: the corner has to come in first.
//
// A triangle is proved when its corners are that near to one solid (which is convex), or when a
// corner or its middle is near enough for its size; otherwise it is cut into four. `at_vertices`
// are the distances of the target's points, by the target's index. O(triangles) and a little.
[[nodiscard]] std::vector<Eigen::Vector3d> FindPointsOutside(
    const tighten::CoverTarget& target, const tighten::UnionDistances& at_vertices,
    const std::vector<geometry::TaperedCapsule>& solids, double asked_m, double max_gap_m,
    const ThreadPool& pool);

// The CertifiedGap of cover_body.h where the distances of the target's points are known already.
[[nodiscard]] double CertifiedGap(const tighten::CoverTarget& target,
                                  const tighten::UnionDistances& at_vertices,
                                  const std::vector<geometry::TaperedCapsule>& solids,
                                  double tolerance_m, const ThreadPool& pool);

// Distances of the target's points by the target's index.
[[nodiscard]] tighten::UnionDistances InCallersOrder(const tighten::PointGrid& points,
                                                     const tighten::UnionDistances& distances);

}  // namespace capfit::coverage

#endif  // CAPFIT_CORE_COVERAGE_SURFACE_PROBE_H_
