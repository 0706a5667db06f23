// Colliders for NvCloth and the cloth of PhysX 3: arrays in a header of C.
#ifndef CAPFIT_CORE_EXPORT_NVCLOTH_H_
#define CAPFIT_CORE_EXPORT_NVCLOTH_H_

#include "core/export/collider_set.h"

namespace capfit::exports {

// nvcloth_colliders.h in YUpFrame(), metres; compiles as C and as C++ without any include but
// <stdint.h>. Constants CAPFIT_SPHERE_COUNT and CAPFIT_CAPSULE_COUNT; capfit_spheres, four floats
// each (x, y, z, radius: a PxVec4), for Cloth::setSpheres; capfit_capsules, two indices each, for
// Cloth::setCapsules; the name of each, and the joint that carries it, in a comment beside it. An
// array without entries has one of zeros, since C has no empty arrays.
//
// Warnings: COLLIDER_LIMIT (more than 32 spheres or capsules: NvCloth refuses them), INNER_SPHERES
// (capsules with one sphere inside the other, or touching it from inside: NvCloth skips them, and
// the spheres alone are the same solid), RIG_LEFT_OUT (the spheres stand as the body stood: to be
// moved by the caller).
[[nodiscard]] Exported WriteNvCloth(const ColliderSet& set);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_NVCLOTH_H_
