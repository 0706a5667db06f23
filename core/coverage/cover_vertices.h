// Growing the set until nothing of the body sticks out (paper, III-D), and proving it.
#ifndef CAPFIT_CORE_COVERAGE_COVER_VERTICES_H_
#define CAPFIT_CORE_COVERAGE_COVER_VERTICES_H_

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/capsule/primitive_set.h"

namespace capfit::coverage {

// What has to be inside: vertices and triangles of the fitted parts, in the body frame.
struct CoverTarget {
  std::vector<Eigen::Vector3d> points_m;
  std::vector<mesh::Triangle> triangles;  // indices into points_m
  std::vector<body::Part> point_parts;    // which part each point belongs to
};

// The vertices of the selected parts, and the triangles whose three corners are all among them.
[[nodiscard]] CoverTarget TargetOf(const body::Body& body, const body::PartSelection& parts);

struct CoverOptions {
  // Between vertices: triangles are cut finer until no point of them is further out than this.
  double max_gap_m = 1e-3;
  int refit_rounds = 8;  // re-fits of the radii after the growing
};

struct CoverReport {
  int growth_steps = 0;
  int added_points = 0;                // inside triangles, where vertices alone were not enough
  double max_vertex_distance_m = 0.0;  // furthest vertex outside; <= 0 when all are inside
  double certified_gap_m = 0.0;        // no point of the surface is further out than this (proved)
};

// Moves and grows spheres until every point is inside and no triangle sticks out by more than
// options.max_gap_m, with the least growth it can find. Keeps mirrored spheres mirrored.
// Terminates: every step covers a point and uncovers none.
[[nodiscard]] CoverReport CoverBody(const CoverTarget& target, const CoverOptions& options,
                                    const ThreadPool& pool, const FitObserver& observer,
                                    capsule::PrimitiveSet& set);

// Upper bound of the distance by which any point of the target's triangles sticks out of the set,
// by branch and bound (the distance is 1-Lipschitz), to `tolerance_m`.
[[nodiscard]] double CertifiedGap(const CoverTarget& target, const capsule::PrimitiveSet& set,
                                  double tolerance_m, const ThreadPool& pool);

}  // namespace capfit::coverage

#endif  // CAPFIT_CORE_COVERAGE_COVER_VERTICES_H_
