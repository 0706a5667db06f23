// What an engine makes of a capsule between two spheres, where that is not their tangent hull.
#ifndef CAPFIT_CORE_CAPSULE_CAPSULE_PROFILE_H_
#define CAPFIT_CORE_CAPSULE_CAPSULE_PROFILE_H_

#include "core/capsule/primitive_set.h"

namespace capfit::capsule {

enum class CapsuleProfile {
  kTangentHull,    // the convex hull of its two spheres: what all rooms reckon with
  kLerpedRadius,   // around each point of the axis the radius interpolated between the ends; lies
                   // within the hull, by up to (1/cos - 1) of the radius on a taper
  kUniformRadius,  // one radius for the whole capsule; ends are not shared between capsules
};

// The same capsules, each with two spheres of its own that share the mean of the two radii. Spheres
// that no capsule uses come last. Mirrored capsules stay images of each other. Encloses neither
// less nor more than before in general: to be covered again, with CoverOptions::uniform_radius.
[[nodiscard]] PrimitiveSet WithUniformRadii(const PrimitiveSet& set);

// Gives both ends of each capsule the larger of their radii: the hull of what it was, and more.
void RaiseToUniformRadii(PrimitiveSet& set);

// Grows radii until each capsule contains, in the lerped profile too, the tangent hull that it was.
// A ball c(t), r(t) of a cone with half angle b reaches r / cos b across the axis, so that is what
// the ends must have; capsules steeper than sin b = 0.5 have their smaller end raised first.
void GrowForLerpedRadius(PrimitiveSet& set);

// Shapes that an engine without shared spheres needs: capsules, and spheres that none of them uses.
[[nodiscard]] int ShapeCount(const PrimitiveSet& set);

}  // namespace capfit::capsule

#endif  // CAPFIT_CORE_CAPSULE_CAPSULE_PROFILE_H_
