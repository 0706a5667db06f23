// Radii that follow the body's stretch: a belly that bulges or a muscle that swells.
#ifndef CAPFIT_CORE_SKINNING_STRETCHED_RADII_H_
#define CAPFIT_CORE_SKINNING_STRETCHED_RADII_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/formats/polygon_soup.h"
#include "core/skinning/bone_weights.h"
#include "core/skinning/mean_value_coordinates.h"
#include "core/skinning/sparse_weights.h"

namespace capfit::skinning {

// A radius stays within these shares of what it is at rest: beyond, a weight's error shows more
// than the body's stretch.
inline constexpr double kLeastStretch = 0.8;
inline constexpr double kMostStretch = 1.25;

// Body's vertices and the centres that the weights give for them.
struct CarriedCenters {
  std::span<const Eigen::Vector3d> vertices;
  std::span<const Eigen::Vector3d> centers;
};

// Of each sphere the factor of its radius: the sum of weight * |vertex - centre| now over the same
// at rest, within the two limits. Both poses in the same unit. O(weights).
[[nodiscard]] std::vector<double> Stretch(const SparseWeights& weights, const CarriedCenters& rest,
                                          const CarriedCenters& now);
[[nodiscard]] std::vector<double> Stretch(const DenseWeights& weights, const CarriedCenters& rest,
                                          const CarriedCenters& now);

// Bones that only turn keep radii as they are; those that scale, scale them: the weighted mean of
// the cube root of the change of volume of the joints' frames, within the two limits.
[[nodiscard]] std::vector<double> Stretch(const BoneWeights& weights,
                                          std::span<const formats::Placing> rest,
                                          std::span<const formats::Placing> now);

}  // namespace capfit::skinning

#endif  // CAPFIT_CORE_SKINNING_STRETCHED_RADII_H_
