// From circles to spheres and tapered capsules (paper, III-C).
#ifndef CAPFIT_CORE_CAPSULE_BUILD_PRIMITIVES_H_
#define CAPFIT_CORE_CAPSULE_BUILD_PRIMITIVES_H_

#include <span>

#include "core/body/body.h"
#include "core/capsule/primitive_set.h"
#include "core/circle/approximate_polygon.h"
#include "core/section/feature_polygon.h"

namespace capfit::capsule {

// One sphere for each circle; a capsule for each pair of circles of neighbouring polygons of a
// chain; where `link_limbs`, one capsule from each limb's first polygon to the nearest sphere of
// the torso that shortens the way (closes the gap at shoulder and hip; not in the paper).
[[nodiscard]] PrimitiveSet BuildPrimitives(
    std::span<const section::FeaturePolygon> polygons,
    std::span<const circle::PolygonApproximation> approximations, bool link_limbs);

// Adds the smallest enclosing ball of each selected head, hand and foot that the body has.
void AddEndBalls(const body::Body& body, const body::PartSelection& parts, PrimitiveSet& set);

// Removes capsules that one other capsule covers, then those that the union of the others covers
// (certified to `tolerance_m`), fewest exclusive surface first, asking again after each removal.
// Spheres stay. Mirrored capsules go together.
void RemoveCoveredCapsules(PrimitiveSet& set, double tolerance_m = 2e-4);

}  // namespace capfit::capsule

#endif  // CAPFIT_CORE_CAPSULE_BUILD_PRIMITIVES_H_
