// The few vertices that carry each centre: mean value coordinates in a small form for the wire and
// for every frame.
#ifndef CAPFIT_CORE_SKINNING_SPARSE_WEIGHTS_H_
#define CAPFIT_CORE_SKINNING_SPARSE_WEIGHTS_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/mesh/body_mesh.h"
#include "core/skinning/mean_value_coordinates.h"

namespace capfit::skinning {

// Row after row: sphere s has the entries from row_ends[s - 1] (0 for the first) to row_ends[s].
// The weights of a row sum to 1 and reproduce the sphere's centre from the rest vertices, both to
// 1e-9 (of the unit) when added up in double; of a mesh of a few dozen vertices to 1e-6 of its
// size. They may be negative.
struct SparseWeights {
  std::size_t vertex_count = 0;  // the caller's vertices, in the caller's order
  std::vector<std::uint32_t> row_ends;
  std::vector<std::uint32_t> vertices;  // the caller's indices, ascending in each row
  std::vector<float> weights;

  [[nodiscard]] std::size_t sphere_count() const { return row_ends.size(); }
  [[nodiscard]] std::size_t RowBegin(std::size_t sphere) const {
    return sphere == 0 ? 0 : row_ends[sphere - 1];
  }
};

// At most so many weights for a centre, and at least, where the mesh has them.
inline constexpr std::size_t kMostSparseWeights = 128;
inline constexpr std::size_t kLeastSparseWeights = 64;

// In place of all vertices a centre gets one of each patch of them: patches are small near it and
// large far from it, and each vertex has what all of its patch weigh. Neighbouring patches, and all
// of a part of the body, keep the weight and the mean place of what they stand for, so that parts
// that move as one move the centre as the dense weights do: within 2 mm of them over a walk, 0.2 mm
// in the mean. Some 85 weights a centre.
//
// `parts`: for each of the mesh's vertices which part of the body it belongs to, below 16 (patches
// keep them apart, which matters where an arm is near the trunk); empty: nobody knows. `mesh` and
// `carriers` as in MeanValueWeights; of welded copies one carries. O(vertices + centres log n):
// some 0.08 us a vertex and 40 us a centre. Every row depends on its own centre only, and its bits
// on nothing else. Cancelled: rows not reached are empty.
[[nodiscard]] SparseWeights SparseMeanValueWeights(const mesh::BodyMesh& mesh,
                                                   std::span<const Eigen::Vector3d> centers_m,
                                                   const ThreadPool& pool,
                                                   const FitObserver& observer,
                                                   std::span<const std::uint8_t> parts = {},
                                                   const std::optional<Carriers>& carriers = {});

// Mends what another frame has rounded: the rows reproduce `centers` from `vertices`, the caller's,
// to 1e-9 of their unit again. Changes weights by some 1e-8.
void MakeExact(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3d> centers,
               SparseWeights& weights);

// As for dense weights: `vertices` are the caller's, weights.vertex_count of them, in any frame and
// unit. About 0.2 us a centre.
[[nodiscard]] std::vector<Eigen::Vector3d> Apply(const SparseWeights& weights,
                                                 std::span<const Eigen::Vector3d> vertices);

}  // namespace capfit::skinning

#endif  // CAPFIT_CORE_SKINNING_SPARSE_WEIGHTS_H_
