// All landmarks, in the order in which they lean on each other.
#ifndef CAPFIT_CORE_BODY_LANDMARKS_H_
#define CAPFIT_CORE_BODY_LANDMARKS_H_

#include <vector>

#include "absl/status/status.h"
#include "core/base/warning.h"
#include "core/body/shape.h"

namespace capfit::body {

// Fills in what `landmarks` (the caller's own) leaves open and the parts of `shape` that say what
// there is: profiles, stature, has_head and so on. A limb without enough of a tube is dropped.
// Each part that is missing is a warning PART_MISSING. Errors: FAILED_PRECONDITION with reason
// PART_MISSING where two legs do not part, NOT_A_BODY where no limb is left;
// CANCELLED once shape.observer cancels.
[[nodiscard]] absl::Status FindLandmarks(const Extremities& extremities, Shape& shape,
                                         Landmarks& landmarks, std::vector<Warning>& warnings);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_LANDMARKS_H_
