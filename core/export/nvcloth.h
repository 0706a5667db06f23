// Colliders for NvCloth and the cloth of PhysX 3: arrays in a header of C.
#ifndef CAPFIT_CORE_EXPORT_NVCLOTH_H_
#define CAPFIT_CORE_EXPORT_NVCLOTH_H_

#include "core/export/collider_set.h"

namespace capfit::exports {

// nvcloth_colliders.h in YUpFrame(), metres; compiles as C and as C++ without any include but
// <stdint.h>. Constants CAPFIT_SPHERE_COUNT, CAPFIT_CAPSULE_COUNT and CAPFIT_JOINT_COUNT;
// capfit_spheres, four floats each (x, y, z, radius: a PxVec4), for Cloth::setSpheres;
// capfit_capsules, two indices each, for Cloth::setCapsules; the name of each in a comment beside
// it. To move them: capfit_joint_names; capfit_sphere_joints, the index of the joint that carries
// each sphere, or -1; capfit_sphere_offsets, three floats each, the centre in that joint's own
// frame (JointFrame). An array without entries has one of nothing, since C has no empty arrays.
//
// Warnings: COLLIDER_LIMIT (more than 32 spheres or capsules: NvCloth refuses them), INNER_SPHERES
// (capsules with one sphere inside the other, or touching it from inside: NvCloth skips them, and
// the spheres alone are the same solid).
[[nodiscard]] Exported WriteNvCloth(const ColliderSet& set);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_NVCLOTH_H_
