// Centres carried by the bones of a skeleton: no vertices are needed to move them.
#ifndef CAPFIT_CORE_SKINNING_BONE_WEIGHTS_H_
#define CAPFIT_CORE_SKINNING_BONE_WEIGHTS_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/formats/polygon_soup.h"
#include "core/skinning/sparse_weights.h"

namespace capfit::skinning {

// Row after row: sphere s has the entries from row_ends[s - 1] (0 for the first) to row_ends[s].
// Its centre is the sum of weight * to_mesh(joint) * offset, where to_mesh leads from the joint's
// own frame, as it now stands, to the mesh's: at rest exactly (to 1e-9 of the mesh's unit) the
// fitted centre. The weights of a row sum to 1; a few may be negative.
struct BoneWeights {
  std::size_t joint_count = 0;
  std::vector<std::uint32_t> row_ends;
  std::vector<std::uint16_t> joints;  // ascending in each row
  std::vector<float> weights;
  std::vector<Eigen::Vector3d> offsets;  // in the joint's own frame and unit

  [[nodiscard]] std::size_t sphere_count() const { return row_ends.size(); }
  [[nodiscard]] std::size_t RowBegin(std::size_t sphere) const {
    return sphere == 0 ? 0 : row_ends[sphere - 1];
  }
};

// What joints with less of a centre than this have is handed on to the joint above them.
inline constexpr double kLeastBoneWeight = 1e-3;

// The sparse rows carried over to the joints that hold their vertices: for a body that moves by
// linear blend skinning with the soup's joints and influences the centres are where `sparse` puts
// them, but for what joints below kLeastBoneWeight would do by themselves, in any pose. A vertex
// that no joint holds moves with the nearest one that some do. `centers` and the soup are in the
// mesh's frame. Nothing where no vertex of the soup has a joint that could carry. O(weights +
// vertices).
[[nodiscard]] std::optional<BoneWeights> BonesOfSparse(const SparseWeights& sparse,
                                                       std::span<const Eigen::Vector3d> centers,
                                                       const formats::PolygonSoup& soup);

// The centres with joints standing at `to_mesh`, one for each of the skeleton's, in its order.
[[nodiscard]] std::vector<Eigen::Vector3d> Apply(const BoneWeights& weights,
                                                 std::span<const formats::Placing> to_mesh);

}  // namespace capfit::skinning

#endif  // CAPFIT_CORE_SKINNING_BONE_WEIGHTS_H_
