// A polygon as a few circles: variational approximation by circle outside area (paper, III-B).
#ifndef CAPFIT_CORE_CIRCLE_APPROXIMATE_POLYGON_H_
#define CAPFIT_CORE_CIRCLE_APPROXIMATE_POLYGON_H_

#include <cstdint>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/geometry/smallest_enclosing.h"
#include "core/section/feature_polygon.h"

namespace capfit::circle {

using geometry::Circle;

struct CircleOptions {
  int interior_points = 100;   // grid points inside the outline (scan conversion)
  int max_iterations = 24;     // partition + fit rounds for one local minimum
  int max_idle_teleports = 3;  // give up after so many local minima without improvement
  int gap_fitting_rounds = 6;  // rounds in which circles are fitted to gaps between them
  bool symmetric = false;      // the outline mirrors in x = 0: fit circles in mirrored pairs
  std::uint64_t seed = 0;
};

// For circles that only tell how many a polygon is worth, or that something else moves on: one
// local minimum, nearly reached, over fewer points, whose circles grow over gaps. They cover as
// well and waste about a sixth more, in about a tenth of the time.
[[nodiscard]] CircleOptions DraftOptions(const CircleOptions& options);

// Circles that cover the outline, and what they waste.
struct PolygonApproximation {
  std::vector<Circle> circles;   // section frame; ordered by x, then y
  double outside_area_m2 = 0.0;  // of the union of the circles, outside the polygon
};

// Covers `polygon` with exactly `circle_count` >= 1 circles: every point of the outline and of its
// inside lies in a circle to 1e-9 m. One circle is the smallest enclosing one. Split polygons
// (III-E) with circles for every piece are fitted piece by piece, judged against the whole outline,
// unless circles that ignore the split waste far less. Where `options.symmetric`, the outline must
// mirror in x = 0 to the bit, and so do the circles. Deterministic for a seed; about a millisecond
// for three circles, three for six. When the observer cancels, the circles still cover but may be
// fewer, and are not the best.
[[nodiscard]] PolygonApproximation ApproximatePolygon(const section::FeaturePolygon& polygon,
                                                      int circle_count,
                                                      const CircleOptions& options,
                                                      const FitObserver& observer);

}  // namespace capfit::circle

#endif  // CAPFIT_CORE_CIRCLE_APPROXIMATE_POLYGON_H_
