// Landmarks of arms and legs: wrists, elbows, hips, knees, ankles and the ends. Shoulders:
// shoulder_landmarks.h.
#ifndef CAPFIT_CORE_BODY_LIMB_LANDMARKS_H_
#define CAPFIT_CORE_BODY_LIMB_LANDMARKS_H_

#include <array>
#include <optional>

#include "core/body/shape.h"

namespace capfit::body {

// Whether so much is missing of the limb, beside the other, that hand or foot cannot be there.
[[nodiscard]] bool IsCutShort(const std::array<std::optional<Limb>, 2>& limbs, int side);

// Wrist and, where there is a hand, fingertip; sets has_hand. The wrist is where the arm is
// narrowest between hand and forearm, or the cut.
void FindWrist(Shape& shape, int side, Landmarks& landmarks);

// How far the wrist (the ankle) lies from the limb's tip along its middle line, once those of both
// sides are known. Of a limb that is cut off above: where it would be, by the other one; below 0
// where that is beyond the cut.
[[nodiscard]] double WristArc(const Shape& shape, int side, const Landmarks& landmarks);
[[nodiscard]] double AnkleArc(const Shape& shape, int side, const Landmarks& landmarks);

// Once wrists and shoulders are known.
void FindElbow(const Shape& shape, int side, Landmarks& landmarks);

// Ankle and, where there is a foot, heel and toe; sets has_foot.
void FindAnkle(Shape& shape, int side, Landmarks& landmarks);

// Once the crotch is known.
void FindHip(const Shape& shape, int side, Landmarks& landmarks);

// Once ankles and hips are known.
void FindKnee(const Shape& shape, int side, Landmarks& landmarks);

// From the ankle up to the height of the crotch, along the leg however it is bent, once crotch, hip
// and ankle are known.
[[nodiscard]] double LegLength(const Shape& shape, int side, const Landmarks& landmarks);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_LIMB_LANDMARKS_H_
