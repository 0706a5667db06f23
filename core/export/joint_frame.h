// The joints' own frames as engines of rigid bodies have them: turned and moved, never scaled.
#ifndef CAPFIT_CORE_EXPORT_JOINT_FRAME_H_
#define CAPFIT_CORE_EXPORT_JOINT_FRAME_H_

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/export/collider_set.h"
#include "core/export/frame.h"

namespace capfit::exports {

// From the frame of the joint at `index` of an upright set (Upright) to the upright frame: where
// the joint stands, with the rotation nearest to its matrix (scale, shear and mirroring left out).
// The identity for -1.
[[nodiscard]] Eigen::Isometry3d JointFrame(const ColliderSet& upright, std::int32_t index);

// The same in another right-handed frame, metres: from a joint's frame with the same axes as before
// to `frame`.
[[nodiscard]] Eigen::Isometry3d JointFrameIn(const Frame& frame, const ColliderSet& upright,
                                             std::int32_t index);

// Of each sphere of an upright set its centre in the frame of its joint (JointFrame); where no
// joint carries it the centre itself.
[[nodiscard]] std::vector<Eigen::Vector3d> CentersInJoints(const ColliderSet& upright);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_JOINT_FRAME_H_
