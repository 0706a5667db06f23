// Where the arms begin: armpits and shoulder joints.
#ifndef CAPFIT_CORE_BODY_SHOULDER_LANDMARKS_H_
#define CAPFIT_CORE_BODY_SHOULDER_LANDMARKS_H_

#include "core/body/shape.h"

namespace capfit::body {

// Armpit and shoulder, once the wrist is known. Where the arm is raised or held to the front, by
// its length (kRatio).
void FindShoulder(const Shape& shape, int side, Landmarks& landmarks);

// Shoulders hardly move against the trunk: where both are there and do not mirror each other, they
// come nearer to each other's images, the more doubtful one by far the most (kRatio). Takes
// confidence from both.
void MatchShoulders(const Shape& shape, Landmarks& landmarks);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_SHOULDER_LANDMARKS_H_
