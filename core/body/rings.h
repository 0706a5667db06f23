// Limbs and trunk cut into rings of equal distance from the middle of the body.
#ifndef CAPFIT_CORE_BODY_RINGS_H_
#define CAPFIT_CORE_BODY_RINGS_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/enum_index.h"
#include "core/body/extremities.h"

namespace capfit::body {

// Centroids of the rings of equal distance of one limb, from its junction to its tip.
using LevelCentroids = std::vector<Eigen::Vector3d>;

// Number of rings a limb is cut into.
inline constexpr int kLevels = 24;

struct Rings {
  std::array<std::optional<LevelCentroids>, kTipCount> limbs;
  LevelCentroids trunk;

  [[nodiscard]] const std::optional<LevelCentroids>& limb(Tip tip) const {
    return limbs[Index(tip)];
  }
};

// 1 for each vertex of the limbs at these tips.
inline constexpr std::array<Tip, kTipCount> kAllTips = {Tip::kHead, Tip::kHandA, Tip::kHandB,
                                                        Tip::kFootA, Tip::kFootB};
[[nodiscard]] std::vector<char> LimbMask(std::size_t count, const Extremities& extremities,
                                         std::span<const Tip> tips = kAllTips);

// `areas` by vertex; `is_limb`: LimbMask. O(vertices).
[[nodiscard]] Rings RingsOf(std::span<const Eigen::Vector3d> points, std::span<const double> areas,
                            const Extremities& extremities, const std::vector<char>& is_limb);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_RINGS_H_
