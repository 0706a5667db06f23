// How the volume of the union changes when its spheres move and grow.
#ifndef CAPFIT_CORE_TIGHTEN_UNION_VOLUME_H_
#define CAPFIT_CORE_TIGHTEN_UNION_VOLUME_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/tighten/full_cells.h"
#include "core/tighten/set_variables.h"

namespace capfit::tighten {

struct VolumeGradient {
  // By (x, y, z, radius) of each sphere, square metres. A sphere's last entry is the part of the
  // union's exposed surface that hangs on it: the share (1 - t) or t of each piece of slant, and
  // all of its own caps; negative where most of that bounds hollows.
  std::vector<Eigen::Vector4d> by_sphere;
  double area_m2 = 0.0;    // of the union's surface
  double volume_m3 = 0.0;  // of the union, by the divergence theorem: to half a per cent with
                           // samples half a radius apart
};

// The volume changes by the normal speed of its surface: a piece dA of slant with normal n at axis
// parameter t adds dA (1 - t) (n, 1) to one end and dA t (n, 1) to the other, a piece of a cap
// dA (n, 1) to its sphere. Surface inside another solid does not count; the border is softened over
// a tenth of the spacing to either side, so that the result follows the set smoothly. Sampled about
// every `spacing_m` with rings turned by random angles from `seed`; solids and spheres in parallel.
// Of a set that is its own mirror image one half is sampled.
//
// With full cells, surface in them bounds a hollow, and counts as what is left to fill: the volume
// is the union's and twice that of hollows, that is E_r (paper, III-D) but for a constant, and all
// of the surface wants to move outwards there. Least volume alone leaves bodies hollow where the
// spheres are much smaller than the body is thick.
// `variables` must be the set's own.
[[nodiscard]] VolumeGradient UnionVolumeGradient(const capsule::PrimitiveSet& set,
                                                 const SetVariables& variables, double spacing_m,
                                                 std::uint64_t seed, const ThreadPool& pool,
                                                 const FullCells* full = nullptr);

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_UNION_VOLUME_H_
