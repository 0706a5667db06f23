// The inner loop of mean value coordinates: what each triangle of a closed mesh adds to the weights
// of its corners, for four centres at once (Ju, Schaefer, Warren 2005, section 4).
#ifndef CAPFIT_CORE_SKINNING_SPHERICAL_TRIANGLES_H_
#define CAPFIT_CORE_SKINNING_SPHERICAL_TRIANGLES_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/body_mesh.h"

namespace capfit::skinning {

inline constexpr int kLanes = 4;
// One number for each of four centres; one AVX register.
using Lanes = Eigen::Array<double, kLanes, 1>;

// A centre that lies on the surface: its weights are the barycentric ones of what it touches.
struct SurfaceHit {
  std::array<std::uint32_t, 3> vertices{};
  std::array<double, 3> weights{};  // sum 1
};

// Raw weights (not yet divided by their sum) of all mesh vertices for four centres.
struct RawWeights {
  std::vector<Lanes> weights;  // one for each mesh vertex
  std::array<std::optional<SurfaceHit>, kLanes>
      hits;  // where set, that lane's weights mean nothing
};

// Each lane's numbers are the same bits whatever the other lanes hold. O(vertices + triangles),
// about 6 ns a triangle and lane.
[[nodiscard]] RawWeights MeanValueRawWeights(const mesh::BodyMesh& mesh,
                                             const std::array<Eigen::Vector3d, kLanes>& centers);

// What one triangle adds, for one centre.
struct TriangleWeights {
  bool is_hit = false;              // the centre lies on the triangle
  std::array<double, 3> weights{};  // of its corners; where it is hit, barycentric with sum 1
};

// The same numbers as in MeanValueRawWeights for up to four triangles and one centre. `corners`
// relative to the centre, none of them 0.
[[nodiscard]] std::array<TriangleWeights, kLanes> MeanValueTriangles(
    std::span<const std::array<Eigen::Vector3d, 3>> corners);

}  // namespace capfit::skinning

#endif  // CAPFIT_CORE_SKINNING_SPHERICAL_TRIANGLES_H_
