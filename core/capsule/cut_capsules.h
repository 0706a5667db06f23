// What is left of a budget, spent on capsules cut in two.
#ifndef CAPFIT_CORE_CAPSULE_CUT_CAPSULES_H_
#define CAPFIT_CORE_CAPSULE_CUT_CAPSULES_H_

#include <functional>
#include <vector>

#include "core/capsule/budget.h"
#include "core/capsule/mirrored_set.h"

namespace capfit::capsule {

// What half of a cut capsule is worth: `half` is its index in the set now, `whole` what the capsule
// and its image were worth together.
using WorthOfHalf = std::function<double(const MirroredSet& set, int half, double whole)>;

// Either half is worth a quarter of the whole: the gap between a capsule and a curved surface, and
// with it the volume there, shrinks with the square of the length.
[[nodiscard]] inline double QuarterOfWhole(const MirroredSet& /*set*/, int /*half*/, double whole) {
  return 0.25 * whole;
}

// Cuts the capsule that is worth most per primitive, with its image, again and again as long as one
// that fits the budget is worth anything. The spheres in the middle change no shape yet. `worth`:
// by capsule; of a pair of images both have what the two are worth together. O(cuts * capsules).
void CutWorthiest(const Budget& budget, std::vector<double> worth, const WorthOfHalf& worth_of_half,
                  MirroredSet& set);

// About the area of the capsule seen from the side, without its caps, and as much for its image, in
// square metres: what a cut is worth where nothing else is known.
[[nodiscard]] double OutlineArea(const MirroredSet& set, int capsule);
// Of all capsules.
[[nodiscard]] std::vector<double> OutlineAreas(const MirroredSet& set);

}  // namespace capfit::capsule

#endif  // CAPFIT_CORE_CAPSULE_CUT_CAPSULES_H_
