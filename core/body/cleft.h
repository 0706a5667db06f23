// Where two parts of the surface meet: crotch and armpits.
#ifndef CAPFIT_CORE_BODY_CLEFT_H_
#define CAPFIT_CORE_BODY_CLEFT_H_

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "core/body/surface_graph.h"
#include "core/geometry/sphere.h"

namespace capfit::body {

// The innermost point of the cleft between the parts of the surface that hold vertices `a` and
// `b`: a plane across `outward` that comes in from outside finds the two apart until it passes
// this vertex (the way over the surface that stays farthest out must pass it). For the crotch: two
// knees and straight down. Nothing when there is no cleft, that is when the plane reaches one of
// the two vertices no later than the junction. Only ways that stay in `region` count.
// O(n log n), n the vertices in the region.
[[nodiscard]] std::optional<std::uint32_t> FindCleft(std::span<const Eigen::Vector3d> points,
                                                     const SurfaceGraph& graph, std::uint32_t a,
                                                     std::uint32_t b,
                                                     const Eigen::Vector3d& outward,
                                                     const geometry::Sphere& region);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_CLEFT_H_
