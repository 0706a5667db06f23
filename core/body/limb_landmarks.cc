#include "core/body/limb_landmarks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/body/cleft.h"

namespace capfit::body {
namespace {

// Lengths are shares of the stature unless the name says otherwise; arcs count from the tip.

// Hand. The narrowest place between palm and forearm; a hand makes the arm widen again beyond it.
constexpr double kWristFrom = 0.055;
constexpr double kWristTo = 0.170;
constexpr double kPalmFrom = 0.010;
constexpr double kPalmWiderThanWrist = 1.25;

// Foot. It sticks out from the axis of the shin; a cut ankle does not.
constexpr double kAnkleFrom = 0.060;
constexpr double kAnkleTo = 0.165;
constexpr double kToeReach = 0.055;
// The ankle joint lies this far above the heel's greatest girth.
constexpr double kAnkleAboveHeelGirth = 0.015;

// Upper arm: direction between these two places, counted from the wrist.
constexpr double kUpperArmFrom = 0.150;
constexpr double kUpperArmTo = 0.200;
// The shoulder joint on the way from the armpit to the top of the shoulder, as a share of that
// way, and how that way leans out when the arm hangs and in when it is raised (per radian).
constexpr double kShoulderHeightShare = 0.54;
constexpr double kShoulderLean = 0.165;
constexpr double kShoulderLeanPerRadian = 0.20;
// Elbow: share of the way from wrist to shoulder (women 0.48, men 0.505).
constexpr double kElbowShare = 0.495;
constexpr double kElbowShareSpread = 0.015;

// Thigh. Knee between ankle (0) and crotch (1); the joint is where the leg is narrowest near that.
constexpr double kKneeShare = 0.563;
constexpr double kKneeWindow = 0.030;
// Hip joint above and beside the crotch.
constexpr double kHipAboveCrotch = 0.043;
constexpr double kHipBeside = 0.061;

std::uint32_t NearestVertex(const Shape& shape, std::span<const std::uint32_t> among,
                            const Eigen::Vector3d& point) {
  std::uint32_t best = among.front();
  for (const std::uint32_t v : among) {
    if ((shape.points[v] - point).squaredNorm() < (shape.points[best] - point).squaredNorm()) {
      best = v;
    }
  }
  return best;
}

Landmark Measured(const Eigen::Vector3d& position_m, double confidence) {
  return {position_m, LandmarkMethod::kMeasured, confidence};
}

Landmark ByRatio(const Eigen::Vector3d& position_m, double confidence) {
  return {position_m, LandmarkMethod::kRatio, confidence};
}

// The centre of the flat end of a cut limb: its last section carried to the end.
Eigen::Vector3d CutEnd(const LimbProfile& profile) {
  const Station& first = profile.stations.front();
  return first.center - first.arc * first.normal;
}

}  // namespace

void FindWrist(Shape& shape, int side, Landmarks& landmarks) {
  const LimbProfile& arm = *shape.arm_profiles[side];
  const double stature = shape.stature_m;
  const double arc = arm.NarrowestArc(kWristFrom * stature, kWristTo * stature);
  const double palm = arm.MaxGirth(kPalmFrom * stature, arc);
  shape.has_hand[side] = palm > kPalmWiderThanWrist * arm.At(arc).girth;
  if (!shape.has_hand[side]) {
    landmarks[Sided(LandmarkId::kLeftWrist, side)] = Measured(CutEnd(arm), 0.9);
    return;
  }
  landmarks[Sided(LandmarkId::kLeftWrist, side)] = Measured(arm.At(arc).center, 0.9);
  landmarks[Sided(LandmarkId::kLeftFingertip, side)] =
      Measured(shape.points[shape.arms[side]->tip], 0.9);
}

void FindAnkle(Shape& shape, int side, Landmarks& landmarks) {
  const LimbProfile& leg = *shape.leg_profiles[side];
  const double stature = shape.stature_m;
  double heel_arc = kAnkleFrom * stature;
  for (const Station& s : leg.stations) {
    if (s.arc < kAnkleFrom * stature || s.arc > kAnkleTo * stature) continue;
    if (s.girth > leg.At(heel_arc).girth) heel_arc = s.arc;
  }
  const Eigen::Vector3d ankle = leg.At(heel_arc + kAnkleAboveHeelGirth * stature).center;
  const Eigen::Vector3d& toe = shape.points[shape.legs[side]->tip];
  shape.has_foot[side] =
      Eigen::Vector2d(toe.x() - ankle.x(), toe.z() - ankle.z()).norm() > kToeReach * stature;
  if (!shape.has_foot[side]) {
    landmarks[Sided(LandmarkId::kLeftAnkle, side)] = Measured(CutEnd(leg), 0.9);
    return;
  }
  landmarks[Sided(LandmarkId::kLeftAnkle, side)] = Measured(ankle, 0.8);
  landmarks[Sided(LandmarkId::kLeftToe, side)] = Measured(toe, 0.8);
  // The heel: farthest from the toe along the foot, below the ankle.
  const Eigen::Vector3d back = Eigen::Vector3d(ankle.x() - toe.x(), 0, ankle.z() - toe.z());
  Eigen::Vector3d heel = ankle;
  for (const std::uint32_t v : shape.legs[side]->vertices) {
    const Eigen::Vector3d& p = shape.points[v];
    if (p.y() < ankle.y() && back.dot(p) > back.dot(heel)) heel = p;
  }
  landmarks[Sided(LandmarkId::kLeftHeel, side)] = Measured(heel, 0.8);
}

void FindThigh(const Shape& shape, int side, Landmarks& landmarks) {
  const LimbProfile& leg = *shape.leg_profiles[side];
  const double stature = shape.stature_m;
  const Eigen::Vector3d crotch = landmarks[Index(LandmarkId::kCrotch)]->position_m;
  const Eigen::Vector3d ankle = landmarks[Sided(LandmarkId::kLeftAnkle, side)]->position_m;
  const double ankle_arc = leg.NearestArc(ankle);
  const double crotch_arc = std::min(leg.end(), ankle_arc + (crotch - ankle).norm());
  const double expected = ankle_arc + kKneeShare * (crotch_arc - ankle_arc);
  const double knee_arc =
      leg.NarrowestArc(expected - kKneeWindow * stature, expected + kKneeWindow * stature);
  landmarks[Sided(LandmarkId::kLeftKnee, side)] = Measured(leg.At(knee_arc).center, 0.8);
  const Eigen::Vector3d hip = crotch + Eigen::Vector3d(SideSign(side) * kHipBeside * stature,
                                                       kHipAboveCrotch * stature, 0.0);
  landmarks[Sided(LandmarkId::kLeftHip, side)] = ByRatio(hip, 0.6);
}

namespace {

struct Armpit {
  Eigen::Vector3d position_m;
  Eigen::Vector3d arm;  // unit, outward along the upper arm
};

std::optional<Armpit> FindArmpit(const Shape& shape, int side, const Landmarks& landmarks) {
  const LimbProfile& profile = *shape.arm_profiles[side];
  const double stature = shape.stature_m;
  const double wrist_arc =
      profile.NearestArc(landmarks[Sided(LandmarkId::kLeftWrist, side)]->position_m);
  const Station lower = profile.At(wrist_arc + kUpperArmFrom * stature);
  const Station upper = profile.At(wrist_arc + kUpperArmTo * stature);
  Armpit armpit;
  armpit.arm = (lower.center - upper.center).normalized();
  const Eigen::Vector3d outward = (armpit.arm - Eigen::Vector3d::UnitY()).normalized();
  const Eigen::Vector3d crotch = landmarks[Index(LandmarkId::kCrotch)]->position_m;
  const Eigen::Vector3d flank =
      crotch + Eigen::Vector3d(0.06 * SideSign(side), 0.10, 0.0) * stature;
  std::vector<std::uint32_t> all(shape.points.size());
  for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
  const std::uint32_t on_arm = NearestVertex(shape, shape.arms[side]->vertices, lower.center);
  const auto cleft =
      FindCleft(shape.points, *shape.graph, on_arm, NearestVertex(shape, all, flank), outward);
  if (!cleft) return std::nullopt;
  armpit.position_m = shape.points[*cleft];
  return armpit;
}

// Where the plane x = armpit.x cuts the shoulder above the armpit: its top, and its middle depth.
struct ShoulderCut {
  double top_y = 0.0;
  double middle_z = 0.0;
};

ShoulderCut CutShoulder(const Shape& shape, const Armpit& armpit) {
  const CutPlane plane = {armpit.position_m, Eigen::Vector3d::UnitX()};
  const Eigen::Vector3d above = armpit.position_m + Eigen::Vector3d(0, 0.03 * shape.stature_m, 0);
  ShoulderCut cut = {above.y(), above.z()};
  double nearest = std::numeric_limits<double>::infinity();
  for (const SectionLoop& loop : CutSection(shape.points, shape.triangles, plane)) {
    const double distance = (loop.centroid - above).norm();
    if (!loop.is_closed || distance >= nearest) continue;
    nearest = distance;
    double front = -std::numeric_limits<double>::infinity();
    double back = -front;
    cut.top_y = loop.Max(Eigen::Vector3d::UnitY());
    for (const Eigen::Vector3d& p : loop.outline) {
      if (p.y() < armpit.position_m.y()) continue;
      front = std::max(front, p.z());
      back = std::min(back, p.z());
    }
    cut.middle_z = 0.5 * (front + back);
  }
  return cut;
}

// The point of the middle line that makes wrist-elbow-shoulder fit it best, not far from the usual
// share of the way.
double ElbowArc(const LimbProfile& arm, double wrist_arc, double shoulder_arc,
                const Eigen::Vector3d& wrist, const Eigen::Vector3d& shoulder) {
  const double length = shoulder_arc - wrist_arc;
  double best = std::numeric_limits<double>::infinity();
  double elbow_arc = wrist_arc + kElbowShare * length;
  for (double share = kElbowShare - 0.06; share <= kElbowShare + 0.06; share += 0.004) {
    const double arc = wrist_arc + share * length;
    const Eigen::Vector3d elbow = arm.At(arc).center;
    double misfit = 0.0;
    int count = 0;
    for (const Station& s : arm.stations) {
      if (s.arc < wrist_arc || s.arc > shoulder_arc) continue;
      const Eigen::Vector3d& end = s.arc < arc ? wrist : shoulder;
      const Eigen::Vector3d bone = (end - elbow).normalized();
      const Eigen::Vector3d off = s.center - elbow;
      misfit += (off - off.dot(bone) * bone).squaredNorm();
      ++count;
    }
    const double deviation = (share - kElbowShare) / kElbowShareSpread;
    // A bone that runs 2 % of the arm's length beside the line weighs as much as one spread.
    const double cost =
        misfit / std::max(1, count) / (4e-4 * length * length) + deviation * deviation;
    if (cost >= best) continue;
    best = cost;
    elbow_arc = arc;
  }
  return elbow_arc;
}

}  // namespace

void FindUpperArm(const Shape& shape, int side, Landmarks& landmarks) {
  const std::optional<Armpit> armpit = FindArmpit(shape, side, landmarks);
  if (!armpit) return;
  landmarks[Sided(LandmarkId::kLeftArmpit, side)] = Measured(armpit->position_m, 0.8);
  const ShoulderCut cut = CutShoulder(shape, *armpit);
  const double thickness = cut.top_y - armpit->position_m.y();
  const double raised = std::acos(std::clamp(-armpit->arm.y(), -1.0, 1.0));  // 0: arm hangs
  const double lean = kShoulderLean - kShoulderLeanPerRadian * raised;
  const Eigen::Vector3d shoulder(armpit->position_m.x() + SideSign(side) * lean * thickness,
                                 armpit->position_m.y() + kShoulderHeightShare * thickness,
                                 cut.middle_z);
  landmarks[Sided(LandmarkId::kLeftShoulder, side)] = Measured(shoulder, 0.7);
  const LimbProfile& arm = *shape.arm_profiles[side];
  const Eigen::Vector3d wrist = landmarks[Sided(LandmarkId::kLeftWrist, side)]->position_m;
  const double wrist_arc = arm.NearestArc(wrist);
  const double nearest = arm.NearestArc(shoulder);
  const double shoulder_arc =
      nearest + (nearest >= arm.end() ? (shoulder - arm.At(nearest).center).norm() : 0.0);
  landmarks[Sided(LandmarkId::kLeftElbow, side)] =
      Measured(arm.At(ElbowArc(arm, wrist_arc, shoulder_arc, wrist, shoulder)).center, 0.8);
}

}  // namespace capfit::body
