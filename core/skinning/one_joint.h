// Which joint carries a sphere or a capsule best, for engines that hang each on one, and how far
// that is from the truth.
#ifndef CAPFIT_CORE_SKINNING_ONE_JOINT_H_
#define CAPFIT_CORE_SKINNING_ONE_JOINT_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/formats/polygon_soup.h"
#include "core/skinning/bone_weights.h"

namespace capfit::skinning {

// The drift of a sphere on a joint: how far its centre is from where the bone weights put it when
// any one of the skeleton's joints turns by 30 degrees about its own position (with all that hangs
// below it), the worst joint and axis. In the mesh's unit; 0 where one joint alone holds the
// sphere.
struct OneJoint {
  std::vector<std::int32_t> of_sphere;  // the joint of least drift
  std::vector<double> sphere_drift;     // its drift
  std::vector<std::int32_t>
      of_capsule;  // the joint of which the larger drift of both ends is least
};

// `joints` are those that the weights are for, at rest; each parent's index may be any but lead to
// no ring. Of equals the lowest joint. O(entries of a row squared * depth).
[[nodiscard]] OneJoint ChooseJoints(const BoneWeights& weights,
                                    std::span<const formats::NamedJoint> joints,
                                    std::span<const std::array<int, 2>> capsules);

// The drift of one sphere on one joint.
[[nodiscard]] double DriftOn(std::int32_t joint, std::size_t sphere, const BoneWeights& weights,
                             std::span<const formats::NamedJoint> joints);

// `centers` (mesh's frame), each carried by its one joint alone: where an engine has it that hangs
// each collider on one. `of_center` are indices into `joints`, as long as `centers`; a joint
// without an inverse (it has no volume) leaves its centres at the joint itself.
[[nodiscard]] BoneWeights OnOneJoint(std::span<const Eigen::Vector3d> centers,
                                     std::span<const std::int32_t> of_center,
                                     std::span<const formats::NamedJoint> joints);

}  // namespace capfit::skinning

#endif  // CAPFIT_CORE_SKINNING_ONE_JOINT_H_
