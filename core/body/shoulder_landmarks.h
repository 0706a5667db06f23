// Where the arms begin: armpits and shoulder joints.
#ifndef CAPFIT_CORE_BODY_SHOULDER_LANDMARKS_H_
#define CAPFIT_CORE_BODY_SHOULDER_LANDMARKS_H_

#include <Eigen/Core>
#include <optional>

#include "core/body/shape.h"

namespace capfit::body {

struct Armpit {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  // unit, outward along the upper arm
};

// Once the wrist is known. Where the arm is raised or held to the front there is none to be seen:
// then armpit and shoulder are put by the arm's length (kRatio).
[[nodiscard]] std::optional<Armpit> FindArmpit(const Shape& shape, int side, Landmarks& landmarks);

// The shoulder over an armpit that was seen.
void FindShoulder(const Shape& shape, int side, const Armpit& armpit, Landmarks& landmarks);

// Shoulders hardly move against the trunk: where both are there and do not mirror each other, they
// come nearer to each other's images, the more doubtful one by far the most (kRatio). Takes
// confidence from both.
void MatchShoulders(const Shape& shape, Landmarks& landmarks);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_SHOULDER_LANDMARKS_H_
