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
        Level({.044 * bust, .727, .060 * bust}, {.050, .056, .09}, {.003, -.004, .022}));
    bumps.push_back(
        Level({.047 * bust, .715, .068 * bust}, {.038, .036, .08}, {.002, -.003, .011}));
  } else {
    bumps.push_back(
        Level({.050 * bust, .745, .060 * bust}, {.056, .046, .08}, {.002, -.002, .008}));
    bumps.push_back(Level({0, .745, .064 * bust}, {.010, .050, .06}, {0, 0, -.003}));  // breastbone
  }
  bumps.push_back(Level({.046 * hip, .508, -.066 * hip}, {.060, .062, .08}, {.001, -.002, -.014}));
  bumps.push_back(Level({0, .490, .050}, {.075, .058, .08}, {0, 0, .0025}));             // pubis
  bumps.push_back(Level({0, .500, -.070 * hip}, {.012, .045, .08}, {0, 0, .010}));       // cleft
  bumps.push_back(Level({0, .680, -.055 * bust}, {.022, .13, .05}, {0, 0, .005}));       // spine
  bumps.push_back(Level({.050, .772, -.070 * bust}, {.035, .045, .05}, {0, 0, -.004}));  // blade
  bumps.push_back(Level({.042, .826, .024}, {.045, .007, .03}, {0, .001, .003}));  // collarbone
}

// In the frame of a head of the usual size.
std::vector<Bump> FaceBumps() {
  std::vector<Bump> bumps;
  bumps.push_back(Level({0, .918, .066}, {.011, .013, .03}, {0, -.002, .011}));  // tip of the nose
  bumps.push_back(Level({0, .932, .066}, {.008, .022, .03}, {0, 0, .005}));      // its bridge
  bumps.push_back(Level({.018, .939, .060}, {.016, .011, .03}, {0, 0, -.006}));  // eye socket
  bumps.push_back(Level({.018, .939, .060}, {.009, .006, .03}, {0, 0, .0035}));  // eye
  bumps.push_back(Level({0, .880, .062}, {.018, .013, .03}, {0, -.001, .005}));  // chin
  bumps.push_back(Level({0, .902, .066}, {.016, .0045, .03}, {0, 0, .003}));     // lips
  bumps.push_back(Level({0, .895, .066}, {.015, .0045, .03}, {0, 0, .002}));
  bumps.push_back(Level({.049, .930, -.006}, {.02, .018, .011}, {.007, 0, -.004}));  // ear
  return bumps;
}

// The head grows about the top of the neck.
void AddFaceBumps(const BodyShape& shape, std::vector<Bump>& bumps) {
  const double factor = shape.head_factor;
  const Vector3d neck(0, ProportionsOf(shape.sex).trunk.back().y_side, 0);
  for (Bump bump : FaceBumps()) {
    bump.center = neck + factor * (bump.center - neck);
    bump.radii *= factor;
    bump.push *= factor;
    bumps.push_back(bump);
  }
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
      bumps.push_back({center, axes, {.048, .007, .0055}, -side * .003 * arm.up});
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
  bumps.push_back(Level({knee_x, .288, .035}, {.028, .034, .04}, {0, 0, .0022}));
  if (shape.with_head) AddFaceBumps(shape, bumps);
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
