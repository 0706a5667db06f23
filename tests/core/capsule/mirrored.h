// Whether a set is what it says: for the tests of all that changes sets.
#ifndef CAPFIT_TESTS_CORE_CAPSULE_MIRRORED_H_
#define CAPFIT_TESTS_CORE_CAPSULE_MIRRORED_H_

#include "core/capsule/mirrored_set.h"

namespace capfit::capsule {

// A mirrored set that is its own image, bit for bit, in geometry and in its bookkeeping.
inline bool IsExactlyMirrored(const MirroredSet& set) {
  for (int v = 0; v < set.sphere_count(); ++v) {
    const int image = set.set().origins[v].mirror;
    if (image < 0 || image >= set.sphere_count() || set.ImageOf(v) != image) return false;
    const geometry::Sphere mirrored = MirrorImage(set.sphere(v));
    if (set.ImageOf(image) != v || set.sphere(image).radius_m != mirrored.radius_m ||
        set.sphere(image).center_m != mirrored.center_m) {
      return false;
    }
  }
  for (int e = 0; e < set.capsule_count(); ++e) {
    const auto [a, b] = set.ends(e);
    const auto [c, d] = set.ends(set.ImageOfCapsule(e));
    const bool is_image = (set.ImageOf(a) == c && set.ImageOf(b) == d) ||
                          (set.ImageOf(a) == d && set.ImageOf(b) == c);
    if (a >= b || !is_image || set.ImageOfCapsule(set.ImageOfCapsule(e)) != e) return false;
  }
  return set.is_mirrored();
}

}  // namespace capfit::capsule

#endif  // CAPFIT_TESTS_CORE_CAPSULE_MIRRORED_H_
