// Making a row of weights do exactly what it promises: sum to 1 and reproduce its centre.
#ifndef CAPFIT_CORE_SKINNING_LINEAR_PRECISION_H_
#define CAPFIT_CORE_SKINNING_LINEAR_PRECISION_H_

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "core/skinning/spherical_triangles.h"

namespace capfit::skinning {

// Turns raw weights into weights that sum to 1 and whose weighted mean of `vertices` is the centre,
// lane by lane: divides by the sum, then changes w_i by |w_i| (a + b . (p_i - c)) with the smallest
// a and b that do it (a 4 x 4 system; mean value weights need about 1e-11). A lane whose weights
// have no usable sum starts from its absolute values instead. Vertices of weight 0 keep it.
void MakeLinearlyPrecise(std::span<const Eigen::Vector3d> vertices,
                         const std::array<Eigen::Vector3d, kLanes>& centers,
                         std::vector<Lanes>& weights);

// Mends a row that was rounded to float so that its sum, taken in double, is 1 within 1e-10. A
// weight too small to be told from its rounding takes up the difference; a row that has none (few
// vertices, a centre on a face) is laid on a grid of 2^-24 (coarser where weights pass 1), on which
// sums are exact. Changes no weight by more than about a unit in its last place.
void MendFloatSum(std::span<float> row);

// The weights, which sum to 1 and whose moment (sum of weight * offset) is 0, as floats that do so
// too when they are added up in double: to 1e-10 of the offsets' size, where four of them or more
// are small (1e-2 and below) and do not lie in a plane. What rounding loses is given to four small
// ones, whose own rounding is finer still.
[[nodiscard]] std::vector<float> RoundPrecisely(std::span<const Eigen::Vector3d> offsets,
                                                std::span<const double> weights);

}  // namespace capfit::skinning

#endif  // CAPFIT_CORE_SKINNING_LINEAR_PRECISION_H_
