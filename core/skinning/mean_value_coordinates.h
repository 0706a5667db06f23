// Mean value coordinates (Ju, Schaefer, Warren 2005; paper, IV-A): what carries the spheres along.
#ifndef CAPFIT_CORE_SKINNING_MEAN_VALUE_COORDINATES_H_
#define CAPFIT_CORE_SKINNING_MEAN_VALUE_COORDINATES_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/mesh/body_mesh.h"

namespace capfit::skinning {

// Row-major: weights[sphere * vertex_count + vertex]. Each row sums to 1 (to float precision) and
// reproduces the sphere's centre from the rest vertices to 1e-6 of the body's height. Vertices that
// the mesh left out (unused, other parts) weigh 0; welded copies share their weight evenly.
struct DenseWeights {
  std::size_t sphere_count = 0;
  std::size_t vertex_count = 0;  // the caller's vertices, in the caller's order
  std::vector<float> weights;
};

// O(centres * triangles), centres in parallel. Centres may lie inside, on or outside the surface.
[[nodiscard]] DenseWeights MeanValueWeights(const mesh::BodyMesh& mesh,
                                            std::span<const Eigen::Vector3d> centers_m,
                                            const ThreadPool& pool, const FitObserver& observer);

// Centres carried by the deformed vertices (the caller's vertices, any frame): sum of weight *
// position. O(spheres * vertices).
[[nodiscard]] std::vector<Eigen::Vector3d> Apply(const DenseWeights& weights,
                                                 std::span<const Eigen::Vector3d> vertices,
                                                 const ThreadPool& pool);

}  // namespace capfit::skinning

#endif  // CAPFIT_CORE_SKINNING_MEAN_VALUE_COORDINATES_H_
