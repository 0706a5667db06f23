// Landmarks that the caller or a skeleton tells, held against what the surface shows.
#ifndef CAPFIT_CORE_BODY_TOLD_LANDMARKS_H_
#define CAPFIT_CORE_BODY_TOLD_LANDMARKS_H_

#include <vector>

#include "absl/status/statusor.h"
#include "core/base/warning.h"
#include "core/body/find_body.h"
#include "core/body/shape.h"
#include "core/body/skeleton_names.h"
#include "core/geometry/similarity.h"

namespace capfit::body {

// The landmarks to start from: the caller's, then the skeleton's that are credible. Credible is
// what lies in the body or near it and
// - within a tenth of the stature from the same landmark as measured, or where none was, or
// - in a limb that as a whole lies in the body: shoulder, elbow and wrist, or hip, knee and ankle,
//   the bones between them and the skeleton's size fit a human's. What is measured on clothes may
//   be off by more than a tenth of the stature (the crotch of a skirt is its hem), while a skeleton
//   of another body or pose leaves this one somewhere along a limb.
// Where no more than a third of the bones are credible it is another body's skeleton, and none
// counts. A warning SKELETON_IGNORED for each bone that does not. The caller's word is taken up to
// a quarter of the stature from what was measured; INVALID_ARGUMENT naming the landmark beyond
// that. `rig`: options.skeleton's. `shape` as FindLandmarks takes it, with the limbs found.
[[nodiscard]] absl::StatusOr<Landmarks> ToldLandmarks(const BodyOptions& options, const Rig& rig,
                                                      const geometry::Similarity& body_from_caller,
                                                      const Extremities& extremities,
                                                      const Shape& shape,
                                                      std::vector<Warning>& warnings);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_TOLD_LANDMARKS_H_
