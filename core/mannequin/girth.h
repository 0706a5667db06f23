// What a tape around the body reads.
#ifndef CAPFIT_CORE_MANNEQUIN_GIRTH_H_
#define CAPFIT_CORE_MANNEQUIN_GIRTH_H_

#include <Eigen/Core>
#include <vector>

#include "core/mannequin/quad_mesh.h"

namespace capfit::mannequin {

// Length of a tape pulled tight around the points: the outline of their convex hull.
[[nodiscard]] double TapeLength(std::vector<Eigen::Vector2d> points);

// The tape around a mirror-symmetric body at height `y`, given its left half: all edges of `quads`
// are cut, and the points found taken together with their mirror images. 0 where nothing is cut.
[[nodiscard]] double HalfBodyGirth(const std::vector<Eigen::Vector3d>& vertices,
                                   const std::vector<Quad>& quads, double y);

}  // namespace capfit::mannequin

#endif  // CAPFIT_CORE_MANNEQUIN_GIRTH_H_
