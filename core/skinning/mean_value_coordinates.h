// Mean value coordinates (Ju, Schaefer, Warren 2005; paper, IV-A): what carries the spheres along.
#ifndef CAPFIT_CORE_SKINNING_MEAN_VALUE_COORDINATES_H_
#define CAPFIT_CORE_SKINNING_MEAN_VALUE_COORDINATES_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/mesh/body_mesh.h"

namespace capfit::skinning {

// Row-major: weights[sphere * vertex_count + vertex]. Each row sums to 1 within 1e-9 (added up in
// double) and reproduces the sphere's centre from the rest vertices to 1e-6 of the body's height.
// Vertices that the mesh left out (unused, other parts) weigh 0; welded copies share their weight
// evenly. Weights may be negative where the surface is seen from behind.
struct DenseWeights {
  std::size_t sphere_count = 0;
  std::size_t vertex_count = 0;  // the caller's vertices, in the caller's order
  std::vector<float> weights;

  [[nodiscard]] std::span<const float> Row(std::size_t sphere) const& {
    return std::span(weights).subspan(sphere * vertex_count, vertex_count);
  }
  std::span<const float> Row(std::size_t sphere) && = delete;
};

// Vertices that carry the weights in place of those of the mesh, where that is only a stand-in for
// the surface that the caller has. Their positions are in the mesh's frame.
struct Carriers {
  std::span<const Eigen::Vector3d> positions_m;
  std::span<const std::uint32_t> of_mesh_vertex;    // the carrier that gets its weight, a near one
  std::span<const std::int32_t> carrier_of_source;  // as BodyMesh::vertex_of_source
};

// O(centres * triangles): about 0.6 ms for a centre and 64k triangles; centres in parallel.
// Finite centres may lie inside, on or outside the surface: on a vertex all weight is that
// vertex's, on a face or edge the weights are the barycentric ones. Weight of a vertex that no
// caller's vertex maps to (the middle of a closed hole) goes to its neighbours. Every row depends
// on its own centre only, and its bits on nothing else. Cancelled: rows not reached are 0.
[[nodiscard]] DenseWeights MeanValueWeights(const mesh::BodyMesh& mesh,
                                            std::span<const Eigen::Vector3d> centers_m,
                                            const ThreadPool& pool, const FitObserver& observer,
                                            const std::optional<Carriers>& carriers = {});

// Centres carried by the deformed vertices: sum of weight * position. `vertices` are the caller's,
// weights.vertex_count of them, all finite, in any frame and unit: a turn, move or uniform scale of
// the vertices turns, moves or scales the centres with them, however far from the origin.
// O(spheres * vertices): about 4 ms for 64 x 32k.
[[nodiscard]] std::vector<Eigen::Vector3d> Apply(const DenseWeights& weights,
                                                 std::span<const Eigen::Vector3d> vertices,
                                                 const ThreadPool& pool);

}  // namespace capfit::skinning

#endif  // CAPFIT_CORE_SKINNING_MEAN_VALUE_COORDINATES_H_
