// How good a set is: E_r, E_M and coverage (paper, IV-B), measured on the set and the mesh.
#ifndef CAPFIT_CORE_METRICS_MEASURE_H_
#define CAPFIT_CORE_METRICS_MEASURE_H_

#include <array>
#include <optional>
#include <vector>

#include "core/base/backlog.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/capsule/primitive_set.h"
#include "core/metrics/column_grid.h"
#include "core/metrics/fitted_surface.h"
#include "core/tighten/point_grid.h"

namespace capfit::metrics {

struct MeasureOptions {
  int columns = 200;            // per axis: volumes are cut exactly along each column; >= 2
  int surface_samples = 6'000;  // >= 1
  body::PartSelection parts;    // what the set is meant to cover
};

// How far the surface of the fitted parts is from the boundary of the set's union, whether the set
// stands off from the covered surface or the surface sticks out of the set: absolute values over
// samples that lie evenly on the area, the mean and the largest with the help of all vertices. All
// 0 where there are no samples.
struct GapStatistics {
  double mean_m = 0.0;
  double p95_m = 0.0;  // 95 % of the area is nearer
  double max_m = 0.0;
};

// The same for one part alone. Each volume of the whole is shared out among the parts (see Volumes
// for the rule): absolute volumes add up to those of the whole. Ratios are relative to this part's
// own volume, E_M to the same diagonal as that of the whole.
struct PartMetrics {
  int spheres = 0;   // that the set says belong to this part
  int capsules = 0;  // by capsule::PartOfCapsule
  double volume_m3 = 0.0;
  double E_r = 0.0;
  double outside = 0.0;
  double uncovered = 0.0;
  double E_M = 0.0;
  double volume_ratio = 0.0;
  GapStatistics gap;
  double surface_out = 0.0;
  int vertices_out = 0;
  double max_out_m = 0.0;
};

// Volumes are relative to the volume of the fitted parts (M_n of the paper), closed flat at the
// cuts; what is outside is outside of the whole body (M_o). Inside the body is where the winding
// number of its surface is not 0.
struct Metrics {
  int n_p = 0;  // spheres + capsules
  int spheres = 0;
  int capsules = 0;
  double E_r = 0.0;           // outside + uncovered
  double outside = 0.0;       // inside the set, outside the body
  double uncovered = 0.0;     // inside the fitted parts, outside the set
  double E_M = 0.0;           // gap.mean_m in % of the diagonal of the fitted parts' box
  double hausdorff = 0.0;     // gap.max_m in % of the diagonal
  double max_gap_m = 0.0;     // certified: no point of the fitted surface is further out
  double volume_ratio = 0.0;  // set / fitted parts
  double iou = 0.0;  // common volume / joint volume; what the set has in parts not fitted left out
  double mirror_error = 0.0;  // volume of (set xor its mirror image) / volume of the set
  GapStatistics gap;
  double surface_out = 0.0;  // share of the fitted parts' area that is more than 0.1 mm out
  int vertices_out = 0;      // of body.enclosed() in the fitted parts, more than 0.1 mm out
  double max_out_m = 0.0;    // the worst of all their vertices; 0 when none is out
  // By Part; nothing where the part is not fitted or the body does not have it.
  std::array<std::optional<PartMetrics>, body::kPartCount> parts;
};

// What measuring takes from the body alone: made once for several sets, and before there is one.
struct MeasureGround {
  // O(n). Not whole until the backlog is done, nor where its observer cancels. `knows_vertices`:
  // Measure will be told how far they are from the set.
  MeasureGround(const body::Body& body, const MeasureOptions& options, bool knows_vertices,
                Backlog& backlog);
  MeasureGround(const MeasureGround&) = delete;
  MeasureGround& operator=(const MeasureGround&) = delete;

  FittedSurface fitted;
  std::optional<tighten::PointGrid> vertices;  // those of `fitted`, unless they are known
  ColumnGrid columns;                          // over the body's box
  BodyRows rows;                               // of `fitted` on `columns`
};

// All but max_gap_m, which coverage proves. With nothing to measure (no part of the body selected,
// or no primitive) only n_p and the volumes that still mean something are set. Deterministic:
// columns and samples in parallel, added up in order. About 5 ms on one core for 64k triangles
// and 64 primitives, 2 of them for the ground; the numbers by part take about 0.5 ms. On bodies E_r
// is within 0.3 % of itself of what ten times the columns tell, E_M within 0.2 %. Cancelled: what
// was not reached is 0.
[[nodiscard]] Metrics Measure(const body::Body& body, const capsule::PrimitiveSet& set,
                              const MeasureOptions& options, const ThreadPool& pool,
                              const FitObserver& observer);
// The same; `ground`: of this body, options.parts and options.columns. `at_vertices`: distances of
// ground.fitted.vertices from capsule::Solids(set), where they are known already; empty: they are
// measured.
[[nodiscard]] Metrics Measure(const body::Body& body, const MeasureGround& ground,
                              const capsule::PrimitiveSet& set, const MeasureOptions& options,
                              const ThreadPool& pool, const FitObserver& observer,
                              const tighten::UnionDistances& at_vertices = {});

// For each vertex of body.enclosed() the signed distance to the boundary of the set's union in
// metres: > 0 outside of the set, < 0 where the set covers it. NaN for vertices of parts that are
// not selected (the set does not stand for them). An empty set gives infinity. About 6 ms on one
// core for 64k triangles and 64 primitives.
[[nodiscard]] std::vector<double> SignedGaps(const body::Body& body,
                                             const capsule::PrimitiveSet& set,
                                             const body::PartSelection& parts,
                                             const ThreadPool& pool);

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_MEASURE_H_
