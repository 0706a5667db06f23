// Whether points lie in a surface.
#ifndef CAPFIT_CORE_BODY_INSIDE_H_
#define CAPFIT_CORE_BODY_INSIDE_H_

#include <Eigen/Core>

#include "core/body/cross_section.h"

namespace capfit::body {

// By the section at its height; right also where the surface overlaps itself. As CutSurface::Cut.
[[nodiscard]] bool IsInside(const CutSurface& surface, const Eigen::Vector3d& at);

// The same, or no farther than `near` from a vertex of it. O(vertices) for points outside.
[[nodiscard]] bool IsInsideOrNear(const CutSurface& surface, const Eigen::Vector3d& at,
                                  double near);

// How many of `places` points evenly between two others are not.
[[nodiscard]] int PlacesOutside(const CutSurface& surface, const Eigen::Vector3d& from,
                                const Eigen::Vector3d& to, double near, int places);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_INSIDE_H_
