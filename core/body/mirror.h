// Bodies that mirror themselves get landmarks and curves that do so exactly.
#ifndef CAPFIT_CORE_BODY_MIRROR_H_
#define CAPFIT_CORE_BODY_MIRROR_H_

#include <array>
#include <optional>

#include "core/body/body.h"
#include "core/body/shape.h"

namespace capfit::body {

// Whether limbs are there on both sides or on none, their landmarks mirror each other, and so does
// the surface, all within 1 % of the height. A sample of the vertices is looked at, against
// sections of the mirrored side.
[[nodiscard]] bool IsSymmetric(const Shape& shape, const Landmarks& landmarks);

// Replaces each pair by its mirrored mean, and moves what has no other side into the plane.
void Symmetrise(Landmarks& landmarks);
void Symmetrise(Shape& shape);  // trunk_base_m, neck_base_m and neck_middle_m
void Symmetrise(std::array<std::optional<MedialCurve>, kChainCount>& chains);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_MIRROR_H_
