// Landmarks of arms and legs: wrists, elbows, hips, knees, ankles and the ends. Shoulders:
// shoulder_landmarks.h.
#ifndef CAPFIT_CORE_BODY_LIMB_LANDMARKS_H_
#define CAPFIT_CORE_BODY_LIMB_LANDMARKS_H_

#include "core/body/shape.h"

namespace capfit::body {

// Wrist and, where there is a hand, fingertip; sets has_hand. The wrist is where the arm is
// narrowest between hand and forearm, or the cut.
void FindWrist(Shape& shape, int side, Landmarks& landmarks);

// Once wrist and shoulder are known.
void FindElbow(const Shape& shape, int side, Landmarks& landmarks);

// Ankle and, where there is a foot, heel and toe; sets has_foot.
void FindAnkle(Shape& shape, int side, Landmarks& landmarks);

// Hip and knee, once the crotch is known.
void FindThigh(const Shape& shape, int side, Landmarks& landmarks);

// From the ankle up to the height of the crotch, along the leg however it is bent, once crotch, hip
// and ankle are known.
[[nodiscard]] double LegLength(const Shape& shape, int side, const Landmarks& landmarks);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_LIMB_LANDMARKS_H_
