// What a centre sees of a surface, in a few patches: the mean value weight of each of them and
// where in the patch it lies.
#ifndef CAPFIT_CORE_SKINNING_PATCH_WEIGHTS_H_
#define CAPFIT_CORE_SKINNING_PATCH_WEIGHTS_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/skinning/surface_tree.h"

namespace capfit::skinning {

// Some of SurfaceTree::order(). All patches of a centre together are all of them, in order.
struct SeenPatch {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t group = 0;  // the same for neighbours in the tree, PatchCounts::group at most
  std::uint32_t part = 0;   // the same for all of a part of the body; groups lie within one
  double weight = 0.0;      // sum of the weights of its vertices, not divided by that of all
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // the same of weight * (vertex - centre)
};

// How many patches: at least and at most so many, where the mesh has them. Between, as many as it
// takes that what the coarseness of none of them can matter is more than a limit.
struct PatchCounts {
  std::size_t least = 64;
  std::size_t most = 128;
  std::size_t group = 12;
};

// Weights agree with MeanValueRawWeights, summed over each patch, to some percent of them:
// triangles near the centre are summed exactly, farther ones as if they were in their vertices, far
// ones as if they were in the middle of a small patch. O(counts.most * log n), some 25 us.
[[nodiscard]] std::vector<SeenPatch> PatchesSeenFrom(const Eigen::Vector3d& center,
                                                     const SurfaceTree& tree,
                                                     const PatchCounts& counts);

}  // namespace capfit::skinning

#endif  // CAPFIT_CORE_SKINNING_PATCH_WEIGHTS_H_
