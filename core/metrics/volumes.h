// The volumes behind E_r (paper, IV-B), cut exactly along columns.
#ifndef CAPFIT_CORE_METRICS_VOLUMES_H_
#define CAPFIT_CORE_METRICS_VOLUMES_H_

#include <array>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/body/anatomy.h"
#include "core/capsule/primitive_set.h"
#include "core/geometry/tapered_capsule.h"
#include "core/metrics/column_grid.h"
#include "core/metrics/fitted_surface.h"

namespace capfit::metrics {

// In cubic metres.
struct PartVolumes {
  double fitted = 0.0;       // of the fitted parts
  double set = 0.0;          // of the union of the solids
  double outside = 0.0;      // inside the set, outside the whole body
  double uncovered = 0.0;    // inside the fitted parts, outside the set
  double fitted_flux = 0.0;  // of z through the part's surface, as the columns see it
};

// Inside a surface is where its winding number is not 0. All of each volume belongs to some fitted
// part, so that `all` is the sum of `parts`:
// - Inside the body, along a column, each half of the way through it belongs to the part of the
//   surface at its end. Parts that are not fitted hand on what is in them: the head to the torso, a
//   hand to its arm, a foot to its leg, and all others to the first part that is fitted.
// - Outside of it, a stretch that begins or ends at the surface of a fitted part belongs to that
//   part, half and half where it does both; one that touches the body nowhere (beside the body's
//   silhouette) belongs to the part of the nearer end sphere of the solid that the column is in.
struct Volumes {
  PartVolumes all;
  std::array<PartVolumes, body::kPartCount> parts;  // by Part
  double mirror_xor = 0.0;  // in the set or in its image in the plane x = 0, but not in both
};

// The parts of the two end spheres of each of capsule::Solids(set), in its order.
using SolidParts = std::array<body::Part, 2>;
[[nodiscard]] std::vector<SolidParts> PartsOfSolids(const capsule::PrimitiveSet& set);

// The body and the fitted surface, and the columns along z that cover them.
struct CutBody {
  const FittedSurface& fitted;
  const ColumnGrid& grid;
  const BodyRows& rows;  // of `fitted` on `grid`
};

// On the body's columns and as many more as the solids take; where they are much larger than the
// body, on as many over everything. `fitted` is exact, but for how columns through two parts are
// shared out. Rows in parallel, added up in order; none where the observer cancels.
[[nodiscard]] Volumes MeasureVolumes(const CutBody& body,
                                     std::span<const geometry::TaperedCapsule> solids,
                                     std::span<const SolidParts> solid_parts,
                                     const ThreadPool& pool, const FitObserver& observer);

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_VOLUMES_H_
