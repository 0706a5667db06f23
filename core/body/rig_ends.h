// Where a skeleton says that head, hands and feet are, and which way the trunk lies.
#ifndef CAPFIT_CORE_BODY_RIG_ENDS_H_
#define CAPFIT_CORE_BODY_RIG_ENDS_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "core/body/skeleton_names.h"
#include "core/body/working_copy.h"

namespace capfit::body {

enum class RigEnd : std::uint8_t { kHead, kLeftHand, kRightHand, kLeftFoot, kRightFoot };
inline constexpr int kRigEndCount = 5;

// In the working copy's coordinates.
struct RigEnds {
  // The vertex nearest to the head's joint, each wrist and each ankle.
  std::array<std::optional<std::uint32_t>, kRigEndCount> vertex;
  // From the hips to the neck, and from right to left through shoulders and hips; of length 1.
  std::optional<Eigen::Vector3d> up;
  std::optional<Eigen::Vector3d> left;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // of shoulders and hips
};

// Nothing where the skeleton lies elsewhere or is of another size: fewer than three of its ends are
// near the surface, or those lie closer together than a body's do. O(vertices).
[[nodiscard]] std::optional<RigEnds> FindRigEnds(const Rig& rig, const WorkingCopy& copy);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_RIG_ENDS_H_
