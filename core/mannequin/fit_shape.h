// Finding the shape that has the wanted girths.
#ifndef CAPFIT_CORE_MANNEQUIN_FIT_SHAPE_H_
#define CAPFIT_CORE_MANNEQUIN_FIT_SHAPE_H_

#include "core/mannequin/body_cage.h"
#include "core/mannequin/quad_sampling.h"

namespace capfit::mannequin {

// Girths of a body, each as a part of its height.
struct Girths {
  double bust, waist, hip;
};

// Height of the whole smooth body, soles to crown, in the cage's unit. Neither girths nor cuts
// change it.
[[nodiscard]] double WholeHeight(BodyShape shape);

// How finely the smooth surface must be known for these divisions. Beyond 2^4 points along an edge
// of the cage (about 3 mm) straight lines between them are as good as the surface.
[[nodiscard]] int LevelsFor(const Divisions& divisions);

// Sets the three factors of `shape` so that the body, divided into about `quads` faces for each
// half, has these girths to 0.1 %. Returns the divisions.
Divisions FitShape(const Girths& wanted, double height, int quads, BodyShape& shape);

}  // namespace capfit::mannequin

#endif  // CAPFIT_CORE_MANNEQUIN_FIT_SHAPE_H_
