// The plane in which a body is most nearly its own mirror image.
#ifndef CAPFIT_CORE_BODY_SYMMETRY_PLANE_H_
#define CAPFIT_CORE_BODY_SYMMETRY_PLANE_H_

#include <Eigen/Core>

#include "core/body/rings.h"

namespace capfit::body {

// normal . p = offset
struct MirrorPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0.0;
};

// Robust least squares over what mirrors what: rings of left and right limbs, rings of trunk and
// head onto themselves. Limbs in different poses lose their say. In units of the square root of the
// surface's area.
[[nodiscard]] MirrorPlane SymmetryPlane(const Rings& rings);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_SYMMETRY_PLANE_H_
