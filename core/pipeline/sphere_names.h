// What the spheres of a set are called.
#ifndef CAPFIT_CORE_PIPELINE_SPHERE_NAMES_H_
#define CAPFIT_CORE_PIPELINE_SPHERE_NAMES_H_

#include <string>
#include <vector>

#include "core/body/body.h"
#include "core/capsule/primitive_set.h"

namespace capfit::pipeline {

// A name for each sphere of `set` (body frame), by where it lies and not by how the set lists it:
//   "left_upper_arm_1", "left_forearm_1", "right_thigh_2", "right_calf_1": by elbow and knee,
//     counted from the trunk outward; "left_arm_1" or "left_leg_1" where that joint is not known
//   "left_hand_1", "left_foot_1": counted from wrist and ankle outward
//   "pelvis_1", "waist_1", "chest_1", "shoulder_1", "neck_1": the nearest of the trunk's landmarks
//     along the trunk, counted upward; "torso_1" where none of them is known; "head_1"
//   "chest_left_1", "chest_right_1": what does not lie in the body's middle
// No two are the same. A sphere and its image (SphereOrigin::mirror) have one name but for "left"
// and "right".
[[nodiscard]] std::vector<std::string> SphereNames(const body::Body& body,
                                                   const capsule::PrimitiveSet& set);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_SPHERE_NAMES_H_
