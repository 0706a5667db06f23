// The coarse cage of quads around a human body.
#ifndef CAPFIT_CORE_MANNEQUIN_BODY_CAGE_H_
#define CAPFIT_CORE_MANNEQUIN_BODY_CAGE_H_

#include <Eigen/Core>
#include <cstddef>

#include "core/mannequin/mannequin.h"
#include "core/mannequin/proportions.h"
#include "core/mannequin/quad_mesh.h"

namespace capfit::mannequin {

// What the cage is built from: the sex's proportions, each girth times a factor.
struct BodyShape {
  MannequinSex sex = MannequinSex::kFemale;
  double bust_factor = 1.0;
  double waist_factor = 1.0;
  double hip_factor = 1.0;
  double arm_angle_rad = 0.8;  // from straight down
  double head_factor = 1.0;    // of its size: a child's is larger
  bool with_head = true;
  bool with_hands = true;
  bool with_feet = true;
};

// Where the arm runs: details on the hand need it.
struct ArmFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // at t = 0 of the straight part, extended back
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();  // up when the arm is level
};

struct BodyCage {
  QuadMesh half;          // the left half, in body heights
  std::size_t trunk_end;  // its first quads, up to this one, are the trunk without limbs and head
  ArmFrame arm;
  double leg_x_at_crotch;  // the leg's axis
  double leg_x_at_ankle;
};

[[nodiscard]] BodyCage BuildBodyCage(const BodyShape& shape);

}  // namespace capfit::mannequin

#endif  // CAPFIT_CORE_MANNEQUIN_BODY_CAGE_H_
