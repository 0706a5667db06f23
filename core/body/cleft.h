// Where two parts of the surface meet: crotch and armpits.
#ifndef CAPFIT_CORE_BODY_CLEFT_H_
#define CAPFIT_CORE_BODY_CLEFT_H_

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/body/shape.h"
#include "core/geometry/sphere.h"

namespace capfit::body {

// The innermost point of the cleft between the parts of the surface that hold nodes `a` and `b`: a
// plane across `outward` that comes in from outside finds the two apart until it passes this point
// (the way over the surface that stays farthest out must pass it). For the crotch: two knees and
// straight down. Nothing when there is no cleft, that is when the plane reaches one of the two
// nodes no later than the junction. Only ways that stay in `region` count. Sought among nodes, then
// among the vertices around the one that was found. O(n log n), n the nodes in the region.
[[nodiscard]] std::optional<Eigen::Vector3d> FindCleft(const Shape& shape, std::uint32_t a,
                                                       std::uint32_t b,
                                                       const Eigen::Vector3d& outward,
                                                       const geometry::Sphere& region);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_CLEFT_H_
