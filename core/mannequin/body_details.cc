#include "core/mannequin/body_details.h"

#include <cmath>

namespace capfit::mannequin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Bump Level(const Vector3d& center, const Vector3d& radii, const Vector3d& push) {
  return {center, Matrix3d::Identity(), radii, push};
}

void AddTrunkBumps(const BodyShape& shape, std::vector<Bump>& bumps) {
  const double bust = shape.bust_factor;
  const double hip = shape.hip_factor;
  if (shape.sex == MannequinSex::kFemale) {
    bumps.push_back(
        Level({.045 * bust, .722, .058 * bust}, {.052, .058, .09}, {.004, -.004, .030}));
    bumps.push_back(
        Level({.048 * bust, .710, .066 * bust}, {.038, .036, .08}, {.002, -.003, .012}));
  } else {
    bumps.push_back(Level({.050 * bust, .745, .06 * bust}, {.052, .050, .08}, {.001, -.002, .009}));
  }
  bumps.push_back(Level({.047 * hip, .505, -.068 * hip}, {.055, .065, .08}, {.002, -.004, -.020}));
  bumps.push_back(Level({0, .500, -.070 * hip}, {.012, .050, .08}, {0, 0, .012}));       // cleft
  bumps.push_back(Level({0, .680, -.055 * bust}, {.022, .13, .05}, {0, 0, .006}));       // spine
  bumps.push_back(Level({.050, .765, -.070 * bust}, {.035, .045, .05}, {0, 0, -.004}));  // blade
}

void AddFaceBumps(std::vector<Bump>& bumps) {
  bumps.push_back(Level({0, .921, .070}, {.012, .016, .03}, {0, -.003, .016}));  // tip of the nose
  bumps.push_back(Level({0, .934, .068}, {.009, .022, .03}, {0, 0, .008}));      // its bridge
  bumps.push_back(Level({.018, .939, .062}, {.015, .012, .03}, {0, 0, -.007}));  // eye socket
  bumps.push_back(Level({0, .878, .064}, {.018, .014, .03}, {0, -.001, .006}));  // chin
  bumps.push_back(Level({0, .902, .068}, {.018, .005, .03}, {0, 0, .004}));      // lips
  bumps.push_back(Level({0, .893, .068}, {.018, .006, .03}, {0, 0, -.003}));
  bumps.push_back(Level({.048, .930, -.004}, {.02, .018, .010}, {.008, 0, -.003}));  // ear
}

// Three shallow furrows between the fingers, on both sides of the hand.
void AddFingerBumps(const ArmFrame& arm, std::vector<Bump>& bumps) {
  Matrix3d axes;
  axes.col(0) = arm.along;
  axes.col(1) = arm.up;
  axes.col(2) = Vector3d::UnitZ();
  for (const double side : {-1.0, 1.0}) {
    for (const double across : {-.0125, 0.0, .0125}) {
      const Vector3d center =
          arm.origin + .432 * arm.along + side * .0085 * arm.up + Vector3d(0, 0, .026 + across);
      bumps.push_back({center, axes, {.030, .007, .0055}, -side * .003 * arm.up});
    }
  }
}

double Falloff(const Bump& bump, const Vector3d& point) {
  const Vector3d q = (bump.axes.transpose() * (point - bump.center)).cwiseQuotient(bump.radii);
  const double inside = 1.0 - q.squaredNorm();
  return inside <= 0.0 ? 0.0 : inside * inside * (1.0 + 2.0 * q.squaredNorm());
}

Vector3d Mirror(const Vector3d& p) { return {-p.x(), p.y(), p.z()}; }

// 0 below -kSoftness, y above +kSoftness, a parabola between.
double PressedToFloor(double y) {
  constexpr double kSoftness = 0.003;
  if (y >= kSoftness) return y;
  if (y <= -kSoftness) return 0.0;
  return (y + kSoftness) * (y + kSoftness) / (4.0 * kSoftness);
}

}  // namespace

std::vector<Bump> BodyBumps(const BodyShape& shape, const BodyCage& cage) {
  std::vector<Bump> bumps;
  AddTrunkBumps(shape, bumps);
  const double knee_x = 0.38 * cage.leg_x_at_crotch + 0.62 * cage.leg_x_at_ankle;
  bumps.push_back(Level({knee_x, .288, .035}, {.024, .026, .03}, {0, 0, .005}));
  if (shape.with_head) AddFaceBumps(bumps);
  if (shape.with_hands) AddFingerBumps(cage.arm, bumps);
  return bumps;
}

void ApplyBumps(const std::vector<Bump>& bumps, std::vector<Vector3d>& points) {
  for (Vector3d& p : points) {
    const bool on_plane = p.x() == 0.0;
    Vector3d move = Vector3d::Zero();
    for (const Bump& bump : bumps) {
      move += Falloff(bump, p) * bump.push;
      if (bump.center.x() != 0.0) move += Falloff(bump, Mirror(p)) * Mirror(bump.push);
    }
    p += move;
    if (on_plane) p.x() = 0.0;
    p.y() = PressedToFloor(p.y());
  }
}

}  // namespace capfit::mannequin
