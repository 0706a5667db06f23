// Spheres in place of a capsule, for readers that know nothing else.
#ifndef CAPFIT_CORE_EXPORT_SPHERE_CHAIN_H_
#define CAPFIT_CORE_EXPORT_SPHERE_CHAIN_H_

#include <vector>

#include "core/geometry/sphere.h"
#include "core/geometry/tapered_capsule.h"

namespace capfit::exports {

// The fewest spheres, evenly along the axis from end to end, each `overshoot_m` > 0 larger than the
// hull is there, whose union contains the hull; nowhere do they stand out by more. One, as large as
// it is, where the hull is a ball. At most length / (2 overshoot) + 2.
[[nodiscard]] std::vector<geometry::Sphere> SphereChain(const geometry::TaperedCapsule& hull,
                                                        double overshoot_m);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_SPHERE_CHAIN_H_
