// What lies between the vertices: how far triangles stick out of the set, proved.
#ifndef CAPFIT_CORE_COVERAGE_SURFACE_PROBE_H_
#define CAPFIT_CORE_COVERAGE_SURFACE_PROBE_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/coverage/cover_body.h"
#include "core/tighten/point_grid.h"

namespace capfit::coverage {

// What sticks out of triangles of which it cannot be proved that nothing of them is more than
// `max_gap_m` outside. Nothing: proved for all triangles.
struct Unproved {
  // Points inside of them that are more than `asked_m` outside all solids, one or a few for each;
  // asked_m < max_gap_m.
  std::vector<Eigen::Vector3d> points_m;
  std::vector<std::uint32_t> triangles;  // the target's, that they are in
};

// Triangles with a corner further out than `max_gap_m` are left alone: the corner has to come in
// first.
//
// A triangle is proved when its corners are that near to one solid (which is convex), or when a
// corner or its middle is near enough for its size; otherwise it is cut into four. `at_vertices`
// are the distances of the target's points, by the target's index. O(triangles) and a little.
[[nodiscard]] Unproved FindPointsOutside(const tighten::CoverTarget& target,
                                         const tighten::UnionDistances& at_vertices,
                                         const std::vector<geometry::TaperedCapsule>& solids,
                                         double asked_m, double max_gap_m, const ThreadPool& pool);

// The same among some triangles, whose corners are in: those that were not proved for smaller
// solids. O(triangles * solids).
[[nodiscard]] Unproved FindPointsOutside(const tighten::CoverTarget& target,
                                         std::span<const std::uint32_t> triangles,
                                         const std::vector<geometry::TaperedCapsule>& solids,
                                         double asked_m, double max_gap_m, const ThreadPool& pool);

// The largest signed distance of the target's points from the union, to the last digit where
// `at_vertices` tell them to a micrometre. -infinity without points.
[[nodiscard]] double MaxVertexDistance(const tighten::CoverTarget& target,
                                       const tighten::UnionDistances& at_vertices,
                                       const std::vector<geometry::TaperedCapsule>& solids,
                                       const ThreadPool& pool);

// The CertifiedGap of cover_body.h where the distances of the target's points are known already.
// `at_least_m`: the triangles stick out as far somewhere, and no point of the target further. The
// more it is, the fewer triangles have to be looked at closely.
[[nodiscard]] double CertifiedGap(const tighten::CoverTarget& target,
                                  const tighten::UnionDistances& at_vertices,
                                  const std::vector<geometry::TaperedCapsule>& solids,
                                  double at_least_m, double tolerance_m, const ThreadPool& pool);

// Distances of the target's points by the target's index.
[[nodiscard]] tighten::UnionDistances InCallersOrder(const tighten::PointGrid& points,
                                                     const tighten::UnionDistances& distances,
                                                     const ThreadPool& pool);

}  // namespace capfit::coverage

#endif  // CAPFIT_CORE_COVERAGE_SURFACE_PROBE_H_
