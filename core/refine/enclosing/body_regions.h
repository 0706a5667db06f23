// The few large regions of a body that its capsules seldom reach across.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_BODY_REGIONS_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_BODY_REGIONS_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "core/body/body.h"
#include "core/refine/layouts/bones.h"

namespace capfit::refine {

// Arms reach from the shoulder to the fingertips, legs from the hip to the toes; the trunk has the
// head, and above the waist the chest.
enum class Region : std::uint8_t { kTrunk, kBelly, kLeftArm, kRightArm, kLeftLeg, kRightLeg };
inline constexpr int kRegionCount = 6;

template <typename Value>
using ByRegion = std::array<Value, kRegionCount>;

// For each region the one that it counts as.
using RegionGroups = ByRegion<Region>;

// A body divided at its shoulders and hips, and one divided at its shoulders and waist.
inline constexpr std::array<RegionGroups, 2> kDivisions = {
    {{Region::kTrunk, Region::kTrunk, Region::kLeftArm, Region::kRightArm, Region::kLeftLeg,
      Region::kRightLeg},
     {Region::kTrunk, Region::kBelly, Region::kLeftArm, Region::kRightArm, Region::kBelly,
      Region::kBelly}}};

// Tells them by the nearest bone, in radii of the bone.
class BodyRegions {
 public:
  // Everything is trunk.
  BodyRegions() = default;
  // So it is, too, where the body has no landmarks. Of a symmetric body both sides count as left.
  explicit BodyRegions(const body::Body& body);

  // `point_m`: body frame. O(bones).
  [[nodiscard]] Region RegionAt(Eigen::Vector3d point_m) const;

 private:
  std::optional<Skeleton> skeleton_;
  bool is_symmetric_ = false;
};

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_BODY_REGIONS_H_
