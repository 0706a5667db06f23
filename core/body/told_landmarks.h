// Landmarks that the caller or a skeleton tells, held against what the surface shows.
#ifndef CAPFIT_CORE_BODY_TOLD_LANDMARKS_H_
#define CAPFIT_CORE_BODY_TOLD_LANDMARKS_H_

#include <vector>

#include "absl/status/statusor.h"
#include "core/base/warning.h"
#include "core/body/find_body.h"
#include "core/body/shape.h"
#include "core/geometry/similarity.h"

namespace capfit::body {

// The landmarks to start from: the caller's, then the skeleton's that are credible. Credible is
// what lies within a tenth of the stature from the same landmark as measured (a tenth of the
// stature around the body's box where nothing was measured); the caller's word is taken up to a
// quarter of the stature. INVALID_ARGUMENT naming the caller's landmark beyond that; a warning
// SKELETON_IGNORED for the skeleton's. `shape` as FindLandmarks takes it, with the limbs found.
[[nodiscard]] absl::StatusOr<Landmarks> ToldLandmarks(const BodyOptions& options,
                                                      const geometry::Similarity& body_from_caller,
                                                      const Extremities& extremities,
                                                      const Shape& shape,
                                                      std::vector<Warning>& warnings);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_TOLD_LANDMARKS_H_
