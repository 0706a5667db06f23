#include "core/body/limb_landmarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace capfit::body {
namespace {

// Lengths are shares of the stature unless the name says otherwise; arcs count from the tip.

// Hand. The narrowest place between palm and forearm; a hand makes the arm widen again beyond it.
constexpr double kWristFrom = 0.055;
constexpr double kWristTo = 0.170;
constexpr double kPalmFrom = 0.010;
constexpr double kPalmWiderThanWrist = 1.25;

// Foot. Where its direction and that of the shin are taken, and the turn (35 degrees) between them
// that makes it one.
constexpr double kFootFrom = 0.045;  // past the middle of what a cut shin or thigh ends in
constexpr double kFootTo = 0.095;
constexpr double kShinFrom = 0.170;
constexpr double kShinTo = 0.240;
constexpr double kFootTurnCosine = 0.82;
constexpr double kAnkleFrom = 0.060;
constexpr double kAnkleTo = 0.165;
// The heel's tip is looked for below this height.
constexpr double kHeelHeight = 0.012;
// The ankle joint lies this far above the heel's greatest girth.
constexpr double kAnkleAboveHeelGirth = 0.015;

// A limb that is shorter than this share of the other has lost more than hand or foot.
constexpr double kShortOfOther = 0.85;

// Elbow: share of the way from wrist to shoulder (women 0.48, men 0.505).
constexpr double kElbowShare = 0.495;
constexpr double kElbowShareSpread = 0.015;

// Thigh. The knee on the way from the ankle (0) to the height of the crotch (1).
constexpr double kKneeShare = 0.563;
constexpr double kKneeShareSpread = 0.010;
// The hip joint above, beside and before the crotch.
constexpr double kHipAboveCrotch = 0.043;
constexpr double kHipBeside = 0.061;
constexpr double kHipBeforeCrotch = 0.009;

// Where the corner of a bent limb is looked for: this share of its length to both sides. A bone
// that runs a fiftieth of the limb's length beside the line weighs as much as one spread.
constexpr double kBendReach = 0.06;
constexpr int kBendSteps = 15;
constexpr double kBendTolerance = 0.02;

// The centre of the flat end of a cut limb: its last section carried to the end.
Eigen::Vector3d CutEnd(const LimbProfile& profile) {
  const Station& first = profile.stations.front();
  return first.center - first.arc * first.normal;
}

// The arc of the outer joint of a limb, or where it would be on a limb that is cut short: as far
// from the trunk as that of the other one.
double OuterArc(const Shape& shape, const std::array<std::optional<Limb>, 2>& limbs,
                const std::array<std::optional<LimbProfile>, 2>& profiles, LandmarkId left_joint,
                int side, const Landmarks& landmarks) {
  const bool is_short = IsCutShort(limbs, side);
  const int whole = is_short ? 1 - side : side;
  const double arc = profiles[whole]->NearestArc(landmarks[Sided(left_joint, whole)]->position_m);
  if (!is_short) return arc;
  return arc - shape.distance_unit_m * (limbs[whole]->tip_distance - limbs[side]->tip_distance);
}

// The arc at which the line passes nearest to a point beside it: past the end, what the point is
// further on in the last direction.
double ArcAlong(const LimbProfile& profile, const Eigen::Vector3d& point) {
  const double nearest = profile.NearestArc(point);
  if (nearest < profile.end()) return nearest;
  const Station& last = profile.stations.back();
  return nearest + std::max(0.0, (point - last.center).dot(last.normal));
}

// The joint of a limb of two bones on the middle line: the place that makes the two straight bones
// fit the line between the arcs `outer` and `inner` best, not far from the usual share of the way.
// A straight limb says nothing, so the share decides; a bent one has a corner.
double BendArc(const LimbProfile& limb, double outer, double inner, double usual_share,
               double spread) {
  const double length = inner - outer;
  const Eigen::Vector3d outer_end = limb.At(outer).center;
  const Eigen::Vector3d inner_end = limb.At(inner).center;
  std::array<double, 2 * kBendSteps + 1> costs;
  for (int i = 0; i < static_cast<int>(costs.size()); ++i) {
    const double share = usual_share + (i - kBendSteps) * kBendReach / kBendSteps;
    const double arc = outer + share * length;
    const Eigen::Vector3d joint = limb.At(arc).center;
    double misfit = 0.0;
    int count = 0;
    for (const Station& s : limb.stations) {
      if (s.arc < outer || s.arc > inner) continue;
      const Eigen::Vector3d& end = s.arc < arc ? outer_end : inner_end;
      const Eigen::Vector3d bone = (end - joint).normalized();
      const Eigen::Vector3d off = s.center - joint;
      misfit += (off - off.dot(bone) * bone).squaredNorm();
      ++count;
    }
    const double deviation = (share - usual_share) / spread;
    const double tolerance = std::max(kBendTolerance * std::abs(length), 1e-9);
    costs[i] = misfit / std::max(1, count) / (tolerance * tolerance) + deviation * deviation;
  }
  const auto least = std::min_element(costs.begin(), costs.end());
  double at = static_cast<double>(least - costs.begin());
  if (least != costs.begin() && least + 1 != costs.end()) {
    // Between the steps: the parabola through three neighbours.
    const double curvature = least[-1] - 2.0 * least[0] + least[1];
    if (curvature > 0.0) at += 0.5 * (least[-1] - least[1]) / curvature;
  }
  const double best_share = usual_share + (at - kBendSteps) * kBendReach / kBendSteps;
  return outer + best_share * length;
}

}  // namespace

bool IsCutShort(const std::array<std::optional<Limb>, 2>& limbs, int side) {
  if (!limbs[1 - side]) return false;
  const double junction = std::min(limbs[kLeft]->junction, limbs[kRight]->junction);
  return limbs[side]->tip_distance - junction <
         kShortOfOther * (limbs[1 - side]->tip_distance - junction);
}

double WristArc(const Shape& shape, int side, const Landmarks& landmarks) {
  return OuterArc(shape, shape.arms, shape.arm_profiles, LandmarkId::kLeftWrist, side, landmarks);
}

double AnkleArc(const Shape& shape, int side, const Landmarks& landmarks) {
  return OuterArc(shape, shape.legs, shape.leg_profiles, LandmarkId::kLeftAnkle, side, landmarks);
}

void FindWrist(Shape& shape, int side, Landmarks& landmarks) {
  const LimbProfile& arm = *shape.arm_profiles[side];
  const double stature = shape.stature_m;
  const double arc = arm.NarrowestArc(kWristFrom * stature, kWristTo * stature);
  const double palm = arm.MaxGirth(kPalmFrom * stature, arc);
  shape.has_hand[side] =
      palm > kPalmWiderThanWrist * arm.At(arc).girth && !IsCutShort(shape.arms, side);
  if (!shape.has_hand[side]) {
    Put(landmarks, Sided(LandmarkId::kLeftWrist, side), CutEnd(arm), 0.9);
    return;
  }
  Put(landmarks, Sided(LandmarkId::kLeftWrist, side), arm.At(arc).center, 0.9);
  Put(landmarks, Sided(LandmarkId::kLeftFingertip, side), shape.points[shape.arms[side]->tip], 0.9);
}

namespace {

// A foot makes the middle line turn at the ankle; a cut shin goes on straight.
bool EndsInFoot(const LimbProfile& leg, double stature) {
  const auto direction = [&](double from, double to) {
    return (leg.At(to * stature).center - leg.At(from * stature).center).normalized();
  };
  return direction(kFootFrom, kFootTo).dot(direction(kShinFrom, kShinTo)) < kFootTurnCosine;
}

}  // namespace

void FindAnkle(Shape& shape, int side, Landmarks& landmarks) {
  const LimbProfile& leg = *shape.leg_profiles[side];
  const double stature = shape.stature_m;
  const double heel_arc = leg.WidestArc(kAnkleFrom * stature, kAnkleTo * stature);
  const Eigen::Vector3d ankle = leg.At(heel_arc + kAnkleAboveHeelGirth * stature).center;
  const Eigen::Vector3d& toe = shape.points[shape.legs[side]->tip];
  shape.has_foot[side] =
      EndsInFoot(leg, stature) && !IsCutShort(shape.legs, side) && !shape.legs_are_cut;
  if (!shape.has_foot[side]) {
    Put(landmarks, Sided(LandmarkId::kLeftAnkle, side), CutEnd(leg), 0.9);
    return;
  }
  Put(landmarks, Sided(LandmarkId::kLeftAnkle, side), ankle, 0.8);
  Put(landmarks, Sided(LandmarkId::kLeftToe, side), toe, 0.8);
  // The heel: farthest from the toe along the foot, below the ankle.
  const Eigen::Vector3d back = Eigen::Vector3d(ankle.x() - toe.x(), 0, ankle.z() - toe.z());
  Eigen::Vector3d heel(ankle.x(), 0.0, ankle.z());
  VisitVertices(shape, *shape.legs[side], [&](const Eigen::Vector3d& p) {
    if (p.y() < kHeelHeight * stature && back.dot(p) > back.dot(heel)) heel = p;
  });
  Put(landmarks, Sided(LandmarkId::kLeftHeel, side), heel, 0.8);
}

namespace {

// A joint between others is known no better than they are.
double Following(double own, const Landmark& other, double usual) {
  return own * (0.4 + 0.6 * std::min(1.0, other.confidence / usual));
}

}  // namespace

void FindElbow(const Shape& shape, int side, Landmarks& landmarks) {
  const LimbProfile& arm = *shape.arm_profiles[side];
  const Eigen::Vector3d shoulder = landmarks[Sided(LandmarkId::kLeftShoulder, side)]->position_m;
  const double arc = BendArc(arm, WristArc(shape, side, landmarks), arm.ArcTo(shoulder),
                             kElbowShare, kElbowShareSpread);
  Put(landmarks, Sided(LandmarkId::kLeftElbow, side), arm.At(arc).center,
      Following(0.8, *landmarks[Sided(LandmarkId::kLeftShoulder, side)], 0.7));
}

void FindHip(const Shape& shape, int side, Landmarks& landmarks) {
  const double stature = shape.stature_m;
  const Eigen::Vector3d crotch = landmarks[Index(LandmarkId::kCrotch)]->position_m;
  const Eigen::Vector3d hip = crotch + stature * Eigen::Vector3d(SideSign(side) * kHipBeside,
                                                                 kHipAboveCrotch, kHipBeforeCrotch);
  const Landmark& base = *landmarks[Index(LandmarkId::kCrotch)];
  Put(landmarks, Sided(LandmarkId::kLeftHip, side), hip, Following(0.6, base, 0.9),
      LandmarkMethod::kRatio);
}

void FindKnee(const Shape& shape, int side, Landmarks& landmarks) {
  const LimbProfile& leg = *shape.leg_profiles[side];
  const Landmark& base = *landmarks[Index(LandmarkId::kCrotch)];
  const double ankle_arc = AnkleArc(shape, side, landmarks);
  const double arc = BendArc(leg, ankle_arc, ankle_arc + LegLength(shape, side, landmarks),
                             kKneeShare, kKneeShareSpread);
  Put(landmarks, Sided(LandmarkId::kLeftKnee, side), leg.At(arc).center, Following(0.8, base, 0.9));
}

double LegLength(const Shape& shape, int side, const Landmarks& landmarks) {
  const LimbProfile& leg = *shape.leg_profiles[side];
  // The height of the crotch on the thigh, wherever that points.
  const double inner = ArcAlong(leg, landmarks[Sided(LandmarkId::kLeftHip, side)]->position_m) -
                       kHipAboveCrotch * shape.stature_m;
  return inner - AnkleArc(shape, side, landmarks);
}

}  // namespace capfit::body
