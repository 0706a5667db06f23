// Which piece of the body each vertex belongs to.
#ifndef CAPFIT_CORE_BODY_SEGMENTS_H_
#define CAPFIT_CORE_BODY_SEGMENTS_H_

#include <vector>

#include "core/body/shape.h"

namespace capfit::body {

// One segment for each vertex. The pieces of a limb are what is reached from its tip before the
// plane through the next joint stops the way; a limb's own tube is so cut without touching what
// else the plane passes through. What no limb claims is torso. O(vertices).
[[nodiscard]] std::vector<Segment> LabelVertices(const Shape& shape, const Landmarks& landmarks);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_SEGMENTS_H_
