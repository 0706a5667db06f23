// Landmarks, segments and medial curves of a body whose frame is known (paper, III-A).
#ifndef CAPFIT_CORE_BODY_FIND_PARTS_H_
#define CAPFIT_CORE_BODY_FIND_PARTS_H_

#include "absl/status/status.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/coarse_surface.h"
#include "core/body/extremities.h"
#include "core/body/find_body.h"
#include "core/body/intrinsic_frame.h"
#include "core/body/skeleton_names.h"
#include "core/body/surface_graph.h"

namespace capfit::body {

// What is known of the body by then.
struct FramedBody {
  const Rig& rig;
  const SurfaceGraph& graph;    // of the nodes of `coarse`
  const CoarseSurface& coarse;  // in the body frame
  const Extremities& extremities;
  const IntrinsicFrame& frame;
  double stature_m = 0.0;  // see Shape, as the next
  double distance_unit_m = 1.0;
};

// Finds what `body`, whose mesh and height are there, still lacks, and adds its warnings. Errors:
// NOT_A_BODY, where a limb cannot be measured; PART_MISSING, where the options require a part that
// is not there; CANCELLED.
[[nodiscard]] absl::Status FindParts(const BodyOptions& options, const FramedBody& found,
                                     const ThreadPool& pool, const FitObserver& observer,
                                     Body& body);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_FIND_PARTS_H_
