// Where a skeleton says that head, hands and feet are, and which way the trunk lies.
#ifndef CAPFIT_CORE_BODY_RIG_ENDS_H_
#define CAPFIT_CORE_BODY_RIG_ENDS_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "core/base/thread_pool.h"
#include "core/body/coarse_surface.h"
#include "core/body/skeleton_names.h"
#include "core/body/working_copy.h"

namespace capfit::body {

enum class RigEnd : std::uint8_t { kHead, kLeftHand, kRightHand, kLeftFoot, kRightFoot };
inline constexpr int kRigEndCount = 5;

// In the working copy's coordinates.
struct RigEnds {
  // The node nearest to the head's joint, each wrist and each ankle. Nothing for the head where the
  // skeleton has no joint of a known name for it, and for ankles where the body ends above its
  // knees.
  std::array<std::optional<std::uint32_t>, kRigEndCount> vertex = {};
  // From the hips to the neck, and from right to left through shoulders and hips; of length 1.
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  Eigen::Vector3d left = Eigen::Vector3d::UnitX();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // of shoulders and hips
};

// Nothing where a joint but the head's is missing, or where the skeleton is another body's: its
// size does not go with the surface, an end is far from it, or its bones do not run inside.
// O(nodes).
[[nodiscard]] std::optional<RigEnds> FindRigEnds(const Rig& rig, const WorkingCopy& copy,
                                                 const CoarseSurface& coarse,
                                                 const ThreadPool& pool);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_RIG_ENDS_H_
