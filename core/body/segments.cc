#include "core/body/segments.h"

#include <algorithm>
#include <cmath>

namespace capfit::body {
namespace {

// Offsets are shares of the stature.

// The boundaries follow how skin moves: they are planes through or near the joints, tilted where
// a muscle or fold makes the skin of one bone reach over to the next.
constexpr double kWristRadius = 0.060;
constexpr double kElbowRadius = 0.090;
constexpr double kShoulderRadius = 0.140;
constexpr double kAnkleRadius = 0.100;
constexpr double kKneeRadius = 0.110;
constexpr double kHipRadius = 0.200;
constexpr double kNeckRadius = 0.200;

// Shoulder cap: the plane turns by about a third of what the arm is raised.
constexpr double kCapTiltRad = 0.17;
constexpr double kCapTiltPerRadian = 0.37;
constexpr double kCapForward = 0.24;
constexpr double kCapInside = 0.017;
constexpr double kElbowAbove = 0.005;
// Groin: from below the crotch up and out to the hip bone.
constexpr double kGroinBelowCrotch = 0.022;

// A way over the surface stops where it comes to the inner side of the plane within the radius.
struct Barrier {
  CutPlane plane;  // normal outward, away from the trunk
  double radius = 0.0;
  [[nodiscard]] bool Stops(const Eigen::Vector3d& p) const {
    return plane.Height(p) < 0.0 && (p - plane.origin).norm() < radius;
  }
};

void Flood(const Shape& shape, std::uint32_t tip, const Barrier& barrier, Segment segment,
           std::vector<Segment>& segments) {
  std::vector<char> seen(shape.points.size(), 0);
  std::vector<std::uint32_t> reached = {tip};
  seen[tip] = 1;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    segments[reached[i]] = segment;
    for (const std::uint32_t n : shape.graph->Neighbours(reached[i])) {
      if (seen[n] || barrier.Stops(shape.points[n])) continue;
      seen[n] = 1;
      reached.push_back(n);
    }
  }
}

Segment OnSide(Segment left, int side) {
  return static_cast<Segment>(static_cast<int>(left) + 3 * side);
}

class Labeller {
 public:
  Labeller(const Shape& shape, const Landmarks& landmarks)
      : shape_(shape), landmarks_(landmarks), segments_(shape.points.size(), Segment::kTorso) {}

  std::vector<Segment> Run() && {
    LabelHead();
    for (const int side : {kLeft, kRight}) {
      if (shape_.legs[side]) LabelLeg(side);
      if (shape_.arms[side]) LabelArm(side);
    }
    return std::move(segments_);
  }

 private:
  [[nodiscard]] bool Has(LandmarkId left, int side = kLeft) const {
    return landmarks_[Sided(left, side)].has_value();
  }
  [[nodiscard]] Eigen::Vector3d At(LandmarkId left, int side = kLeft) const {
    return landmarks_[Sided(left, side)]->position_m;
  }
  [[nodiscard]] Barrier Across(const Eigen::Vector3d& origin, const Eigen::Vector3d& outward,
                               double shift, double radius) const {
    const Eigen::Vector3d normal = outward.normalized();
    return {{origin + shift * shape_.stature_m * normal, normal}, radius * shape_.stature_m};
  }

  // The outermost first: each later flood must not paint over the one before, so go from the
  // trunk outward.
  void LabelArm(int side) {
    if (!Has(LandmarkId::kLeftShoulder, side) || !Has(LandmarkId::kLeftElbow, side)) return;
    const std::uint32_t tip = shape_.arms[side]->tip;
    const Eigen::Vector3d shoulder = At(LandmarkId::kLeftShoulder, side);
    const Eigen::Vector3d elbow = At(LandmarkId::kLeftElbow, side);
    const Eigen::Vector3d wrist = At(LandmarkId::kLeftWrist, side);
    const double raised = std::acos(std::clamp(-(elbow - shoulder).normalized().y(), -1.0, 1.0));
    const double tilt = kCapTiltRad + kCapTiltPerRadian * raised;
    const Eigen::Vector3d cap(SideSign(side) * std::cos(tilt), std::sin(tilt), kCapForward);
    Flood(shape_, tip, Across(shoulder, cap, -kCapInside, kShoulderRadius),
          OnSide(Segment::kLeftUpperArm, side), segments_);
    Flood(shape_, tip, Across(elbow, wrist - shoulder, -kElbowAbove, kElbowRadius),
          OnSide(Segment::kLeftForearm, side), segments_);
    if (!shape_.has_hand[side]) return;
    Flood(shape_, tip, Across(wrist, wrist - elbow, 0.0, kWristRadius),
          OnSide(Segment::kLeftHand, side), segments_);
  }

  void LabelLeg(int side) {
    if (!Has(LandmarkId::kLeftHip, side) || !Has(LandmarkId::kCrotch)) return;
    const std::uint32_t tip = shape_.legs[side]->tip;
    const Eigen::Vector3d knee = At(LandmarkId::kLeftKnee, side);
    const Eigen::Vector3d ankle = At(LandmarkId::kLeftAnkle, side);
    const Eigen::Vector3d groin(SideSign(side) * 0.60, -0.78, 0.13);
    const Eigen::Vector3d below =
        At(LandmarkId::kCrotch) - Eigen::Vector3d(0, kGroinBelowCrotch * shape_.stature_m, 0);
    Flood(shape_, tip, Across(below, groin, 0.0, kHipRadius), OnSide(Segment::kLeftThigh, side),
          segments_);
    const Eigen::Vector3d knee_normal(SideSign(side) * 0.28, -0.86, -0.42);
    Flood(shape_, tip, Across(knee, knee_normal, 0.0115, kKneeRadius),
          OnSide(Segment::kLeftCalf, side), segments_);
    if (!shape_.has_foot[side]) return;
    const Eigen::Vector3d ankle_normal(0.0, -0.97, 0.24);
    Flood(shape_, tip, Across(ankle, ankle_normal, -0.0115, kAnkleRadius),
          OnSide(Segment::kLeftFoot, side), segments_);
  }

  void LabelHead() {
    if (!shape_.head || !Has(LandmarkId::kNeck)) return;
    const std::uint32_t tip = shape_.head->tip;
    const Eigen::Vector3d neck = At(LandmarkId::kNeck);
    if (!shape_.has_head) return;
    Flood(shape_, tip, Across(neck, Eigen::Vector3d(0, 0.96, 0.28), 0.0, kNeckRadius),
          Segment::kNeck, segments_);
    const Eigen::Vector3d skull = neck + Eigen::Vector3d(0, 0.036, 0.02) * shape_.stature_m;
    Flood(shape_, tip, Across(skull, Eigen::Vector3d(0, 0.75, 0.66), 0.0, kNeckRadius),
          Segment::kHead, segments_);
  }

  const Shape& shape_;
  const Landmarks& landmarks_;
  std::vector<Segment> segments_;
};

}  // namespace

std::vector<Segment> LabelVertices(const Shape& shape, const Landmarks& landmarks) {
  return Labeller(shape, landmarks).Run();
}

}  // namespace capfit::body
