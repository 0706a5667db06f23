// Which solids of a set are each other's mirror images: what is measured of one holds for both.
#ifndef CAPFIT_CORE_METRICS_SOLID_IMAGES_H_
#define CAPFIT_CORE_METRICS_SOLID_IMAGES_H_

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/tapered_capsule.h"

namespace capfit::metrics {

// The image of each solid in the plane x = 0, to a nanometre: the digits that a set loses on its
// way through another frame do not count. Itself where it lies across the plane. Nothing where one
// of them has none. O(n log n), but for sets of many alike.
[[nodiscard]] std::vector<std::int32_t> ImagesOf(std::span<const geometry::TaperedCapsule> solids);

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_SOLID_IMAGES_H_
