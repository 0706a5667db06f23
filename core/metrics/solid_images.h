// Which solids of a set are each other's mirror images: what is measured of one holds for both.
#ifndef CAPFIT_CORE_METRICS_SOLID_IMAGES_H_
#define CAPFIT_CORE_METRICS_SOLID_IMAGES_H_

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/tapered_capsule.h"

namespace capfit::metrics {

// The image of each solid in the plane x = 0; itself where it lies across the plane. Nothing where
// one of them has none. By where they are, not by what a set says of itself (capsule::ImagesOf):
// what is measured must not hang on that, and sets of others say nothing. To a nanometre, as the
// digits that a set loses on its way through another frame do not count. O(n log n), but for sets
// of many alike.
[[nodiscard]] std::vector<std::int32_t> ImagesByPlace(
    std::span<const geometry::TaperedCapsule> solids);

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_SOLID_IMAGES_H_
