// The vertices of a glTF primitive: morphed, held by joints, placed.
#ifndef CAPFIT_CORE_FORMATS_GLTF_VERTICES_H_
#define CAPFIT_CORE_FORMATS_GLTF_VERTICES_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/formats/file_error.h"
#include "core/formats/gltf_accessor.h"
#include "core/formats/gltf_skins.h"
#include "core/formats/polygon_soup.h"

namespace capfit::formats {

// A morph target that counts: its displacements, and how much of them.
struct MorphTarget {
  GltfAccessor displacements;
  double weight = 0.0;
};

// JOINTS_n and WEIGHTS_n, four joints for each vertex.
struct InfluenceSet {
  GltfAccessor joints;
  GltfAccessor weights;
};

// Up to eight joints of a skin and their shares of a vertex, which sum to 1 or are all 0.
struct SkinInfluences {
  std::array<std::uint16_t, 8> joint{};
  std::array<float, 8> weight{};
};

// The influences of each of `count` vertices on joints of `skin`. Weights that are negative or no
// numbers count as 0. OUT_OF_RANGE for a joint with a weight that the skin does not have.
[[nodiscard]] absl::StatusOr<std::vector<SkinInfluences>> ReadInfluences(
    std::span<const InfluenceSet> sets, std::size_t count, const GltfSkin& skin,
    const FilePlace& place);

// The strongest four, summing to 1, on the skeleton's joints.
[[nodiscard]] JointInfluences StrongestFour(const SkinInfluences& influences, const GltfSkin& skin);

// If all joints that hold these vertices would place them alike (to a hundred-thousandth of
// `largest`, their largest coordinate), as in the bind pose: that placing, the skin's first.
[[nodiscard]] std::optional<Placing> CommonPlacing(std::span<const SkinInfluences> influences,
                                                   const GltfSkin& skin, double largest);

// `stored` where its joints place it, as glTF says: the sum of weight * placing * stored. What no
// joint with a sensible matrix holds follows `fallback`.
[[nodiscard]] Eigen::Vector3d Skinned(const Eigen::Vector3d& stored,
                                      const SkinInfluences& influences, const GltfSkin& skin,
                                      const Placing& fallback);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_VERTICES_H_
