#include "core/body/shoulder_landmarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/body/cleft.h"
#include "core/body/limb_landmarks.h"

namespace capfit::body {
namespace {

// Lengths are shares of the stature unless the name says otherwise; arcs count from the tip.

// Upper arm: direction between these two places, counted from the wrist.
constexpr double kUpperArmFrom = 0.150;
constexpr double kUpperArmTo = 0.200;
// Where the flank is, seen from the inner end of the arm's middle line, and how far around that
// the armpit is looked for.
constexpr double kFlankInside = 0.02;
constexpr std::array<double, 3> kFlankBelow = {0.14, 0.10, 0.06};
constexpr double kArmpitRegion = 0.25;
// What is further to the front or back of the armpit is an arm that is held there.
constexpr double kShoulderDepth = 0.085;
// The shoulder joint on the way from the armpit to the top of the shoulder, as a share of that
// way, and how that way leans out when the arm hangs and in when it is raised (per radian).
constexpr double kShoulderHeightShare = 0.54;
constexpr double kShoulderLean = 0.165;
constexpr double kShoulderLeanPerRadian = 0.20;
// The way from wrist to shoulder where no armpit can be found, and how far below that one would be.
constexpr double kArmLength = 0.285;
constexpr double kArmpitBelowShoulder = 0.045;
// Sines of the arm's rise (25 degrees over level) and reach to the front (55 degrees) beyond which
// that is so.
constexpr double kRaisedSlope = 0.42;
constexpr double kForwardSlope = 0.82;
// Shoulders that miss each other's image by the first are alike, by the second one of them is
// wrong; one that was not measured is the more doubtful by the third.
constexpr double kUnlike = 0.030;
constexpr double kVeryUnlike = 0.050;
constexpr double kUnmeasured = 0.030;
// An arm that much longer or shorter than usual puts the shoulder in doubt.
constexpr double kDoubtfulArm = 0.045;

// Of the vertices that are in the limb or, if not `wanted`, of those that are not.
std::uint32_t NearestVertex(const Shape& shape, const std::vector<char>& in_limb, bool wanted,
                            const Eigen::Vector3d& point) {
  std::uint32_t best = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t v = 0; v < shape.points.size(); ++v) {
    const double distance = (shape.points[v] - point).squaredNorm();
    if (distance >= nearest || (in_limb[v] != 0) != wanted) continue;
    nearest = distance;
    best = v;
  }
  return best;
}

// Where the arm parts from the trunk.
std::optional<Armpit> CleftOfArm(const Shape& shape, int side, const Landmarks& landmarks) {
  const LimbProfile& profile = *shape.arm_profiles[side];
  const double stature = shape.stature_m;
  const double wrist_arc = WristArc(shape, side, landmarks);
  const Station lower = profile.At(wrist_arc + kUpperArmFrom * stature);
  const Station upper = profile.At(wrist_arc + kUpperArmTo * stature);
  Armpit armpit;
  armpit.arm = (lower.center - upper.center).normalized();
  const Eigen::Vector3d outward = (armpit.arm - Eigen::Vector3d::UnitY()).normalized();
  // The flank beside the waist, and a way from there to the arm that stays near the shoulder. Where
  // the arm is raised the flank may lie as far in as the armpit: then a nearer place on it.
  const Eigen::Vector3d root = profile.stations.back().center;
  std::vector<char> in_arm(shape.points.size(), 0);
  for (const std::uint32_t v : shape.arms[side]->vertices) in_arm[v] = 1;
  const std::uint32_t on_arm = NearestVertex(shape, in_arm, true, lower.center);
  for (const double below : kFlankBelow) {
    const Eigen::Vector3d flank =
        root + Eigen::Vector3d(-kFlankInside * SideSign(side), -below, 0.0) * stature;
    const auto cleft = FindCleft(shape, on_arm, NearestVertex(shape, in_arm, false, flank), outward,
                                 {root, kArmpitRegion * stature});
    if (!cleft) continue;
    armpit.position_m = *cleft;
    return armpit;
  }
  return std::nullopt;
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
  for (const SectionLoop& loop : shape.mesh_surface->Cut(plane)) {
    const double distance = (loop.centroid - above).norm();
    if (!loop.is_closed || distance >= nearest) continue;
    nearest = distance;
    double front = -std::numeric_limits<double>::infinity();
    double back = -front;
    cut.top_y = above.y();
    for (const Eigen::Vector3d& p : loop.outline) {
      const bool is_arm =
          std::abs(p.z() - armpit.position_m.z()) > kShoulderDepth * shape.stature_m;
      if (p.y() < armpit.position_m.y() || is_arm) continue;
      cut.top_y = std::max(cut.top_y, p.y());
      front = std::max(front, p.z());
      back = std::min(back, p.z());
    }
    // An arm held across may hide the whole outline: it has no depth then.
    cut.middle_z = front >= back ? 0.5 * (front + back) : above.z();
  }
  return cut;
}

// The joint stands over the armpit, at a share of the thickness of the shoulder there.
Eigen::Vector3d ShoulderOver(const Shape& shape, int side, const Armpit& armpit) {
  const ShoulderCut cut = CutShoulder(shape, armpit);
  const double thickness = cut.top_y - armpit.position_m.y();
  const double raised = std::acos(std::clamp(-armpit.arm.y(), -1.0, 1.0));  // 0: arm hangs
  const double lean = kShoulderLean - kShoulderLeanPerRadian * raised;
  return {armpit.position_m.x() + SideSign(side) * lean * thickness,
          armpit.position_m.y() + kShoulderHeightShare * thickness, cut.middle_z};
}

// An arm above the shoulder, or held out to the front, has no cleft that says where it begins. Its
// length does, along its own middle line.
bool HasNoCleft(const Eigen::Vector3d& arm) {
  return arm.y() > kRaisedSlope || std::abs(arm.z()) > kForwardSlope;
}

Eigen::Vector3d ShoulderAlong(const Shape& shape, const LimbProfile& arm, double wrist_arc) {
  const double arc = wrist_arc + kArmLength * shape.stature_m;
  const Station& last = arm.stations.back();
  if (arc <= last.arc) return arm.At(arc).center;
  return last.center + (arc - last.arc) * last.normal;
}

// How far the way from wrist to shoulder is from the usual, as a share of the stature.
double ArmMisfit(const Shape& shape, int side, const Landmarks& landmarks) {
  const LimbProfile& arm = *shape.arm_profiles[side];
  const double wrist = WristArc(shape, side, landmarks);
  const double shoulder = arm.ArcTo(landmarks[Sided(LandmarkId::kLeftShoulder, side)]->position_m);
  return std::abs((shoulder - wrist) / shape.stature_m - kArmLength);
}

// Takes away half of the confidence where the doubt is 1.
void Doubt(double doubt, Landmark& landmark) {
  if (landmark.method == LandmarkMethod::kCaller || landmark.method == LandmarkMethod::kSkeleton) {
    return;
  }
  landmark.confidence /= 1.0 + doubt * doubt;
}

Eigen::Vector3d MirroredPoint(const Eigen::Vector3d& p) { return {-p.x(), p.y(), p.z()}; }

}  // namespace

std::optional<Armpit> FindArmpit(const Shape& shape, int side, Landmarks& landmarks) {
  const std::size_t armpit_at = Sided(LandmarkId::kLeftArmpit, side);
  std::optional<Armpit> armpit = CleftOfArm(shape, side, landmarks);
  if (armpit && !HasNoCleft(armpit->arm)) {
    Put(landmarks, armpit_at, armpit->position_m, 0.8);
    armpit->position_m = landmarks[armpit_at]->position_m;
    return armpit;
  }
  const LimbProfile& arm = *shape.arm_profiles[side];
  const Eigen::Vector3d shoulder = ShoulderAlong(shape, arm, WristArc(shape, side, landmarks));
  const Eigen::Vector3d below =
      shoulder - kArmpitBelowShoulder * shape.stature_m * Eigen::Vector3d::UnitY();
  Put(landmarks, armpit_at, below, 0.2, LandmarkMethod::kRatio);
  Put(landmarks, Sided(LandmarkId::kLeftShoulder, side), shoulder, 0.4, LandmarkMethod::kRatio);
  return std::nullopt;
}

void FindShoulder(const Shape& shape, int side, const Armpit& armpit, Landmarks& landmarks) {
  Put(landmarks, Sided(LandmarkId::kLeftShoulder, side), ShoulderOver(shape, side, armpit), 0.7);
}

void MatchShoulders(const Shape& shape, Landmarks& landmarks) {
  for (const int side : {kLeft, kRight}) {
    auto& shoulder = landmarks[Sided(LandmarkId::kLeftShoulder, side)];
    if (!shoulder || !shape.arm_profiles[side]) continue;
    Doubt(ArmMisfit(shape, side, landmarks) / kDoubtfulArm, *shoulder);
  }
  std::array<Landmark, 2> found;
  std::array<double, 2> doubt = {0.0, 0.0};
  for (const int side : {kLeft, kRight}) {
    const auto& shoulder = landmarks[Sided(LandmarkId::kLeftShoulder, side)];
    if (!shoulder || !shape.arm_profiles[side]) return;
    found[side] = *shoulder;
    doubt[side] = ArmMisfit(shape, side, landmarks) +
                  (shoulder->method == LandmarkMethod::kRatio ? kUnmeasured : 0.0);
  }
  const double miss =
      (found[kLeft].position_m - MirroredPoint(found[kRight].position_m)).norm() / shape.stature_m;
  const double share = std::clamp((miss - kUnlike) / (kVeryUnlike - kUnlike), 0.0, 1.0);
  for (const int side : {kLeft, kRight}) {
    Doubt(miss / kVeryUnlike, *landmarks[Sided(LandmarkId::kLeftShoulder, side)]);
  }
  if (share <= 0.0) return;
  const double both = std::pow(doubt[kLeft], 4) + std::pow(doubt[kRight], 4);
  if (!(both > 0.0)) return;
  for (const int side : {kLeft, kRight}) {
    const double way = share * std::pow(doubt[side], 4) / both;
    const std::size_t at = Sided(LandmarkId::kLeftShoulder, side);
    const Eigen::Vector3d image = MirroredPoint(found[1 - side].position_m);
    const bool is_image = way > 0.5;
    Put(landmarks, at, found[side].position_m + way * (image - found[side].position_m),
        landmarks[at]->confidence, is_image ? LandmarkMethod::kRatio : found[side].method);
  }
}

}  // namespace capfit::body
