// Where a body's front is.
#ifndef CAPFIT_CORE_BODY_FACING_H_
#define CAPFIT_CORE_BODY_FACING_H_

#include <Eigen/Core>
#include <span>

#include "core/body/extremities.h"
#include "core/body/rings.h"

namespace capfit::body {

// Evidence that `forward` is the front, negative where it is the back; beyond 1 either way it is
// clear. From toes, calves, elbows, hands and head.
[[nodiscard]] double Facing(const Rings& rings, std::span<const Eigen::Vector3d> points,
                            const Extremities& extremities, const Eigen::Vector3d& up,
                            const Eigen::Vector3d& forward);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_FACING_H_
