// The volumes behind E_r (paper, IV-B), cut exactly along columns.
#ifndef CAPFIT_CORE_METRICS_VOLUMES_H_
#define CAPFIT_CORE_METRICS_VOLUMES_H_

#include <span>

#include "core/base/thread_pool.h"
#include "core/geometry/tapered_capsule.h"
#include "core/mesh/body_mesh.h"
#include "core/metrics/fitted_surface.h"

namespace capfit::metrics {

// In cubic metres. Inside a surface is where its winding number is not 0.
struct Volumes {
  double fitted = 0.0;      // of the fitted parts
  double set = 0.0;         // of the union of the solids
  double outside = 0.0;     // inside the set, outside the whole body
  double uncovered = 0.0;   // inside the fitted parts, outside the set
  double mirror_xor = 0.0;  // in the set or in its image in the plane x = 0, but not in both
};

// `columns` x `columns` columns along z over everything. Rows in parallel, added up in order.
[[nodiscard]] Volumes MeasureVolumes(const mesh::BodyMesh& mesh, const FittedSurface& fitted,
                                     std::span<const geometry::TaperedCapsule> solids, int columns,
                                     const ThreadPool& pool);

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_VOLUMES_H_
