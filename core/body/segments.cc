#include "core/body/segments.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

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
constexpr double kArmpitMargin = 0.005;
constexpr double kArmpitBeyondShoulder = 0.045;
constexpr double kBelowArmpit = 0.004;
// No arm begins nearer to the middle than this share of the shoulder's way from there. Where what
// should end at the armpit comes so far, a garment joins arm and trunk below it: then it ends
// further down the arm, by so many steps of this length at most.
constexpr double kInnermostOfArm = 0.6;
// The same of the shoulder's cap, beside a raised arm: what is further in is neck and head.
constexpr double kInnermostOfCap = 0.45;
constexpr double kArmpitStep = 0.01;
constexpr int kMostArmpitSteps = 8;
constexpr double kArmRadius = 0.090;
constexpr double kAside = 0.05;
constexpr double kCapInside = 0.0165;
constexpr double kWristBeyond = 0.005;
constexpr double kKneeBelow = 0.012;
constexpr double kAnkleAbove = 0.011;
// Groin: from below the crotch up and out to the hip bone.
constexpr double kGroinAlong = 0.78;
constexpr double kGroinOut = 0.55;
constexpr double kGroinForward = 0.09;
constexpr double kGroinBelowCrotch = 0.0145;
constexpr double kGroinTaken = 0.060;
// Jaw and nape: the plane that parts head and neck rises from the front to the back.
constexpr double kJawAboveNeck = 0.035;

// A way over the surface stops where it comes to the inner side of the plane within the radius, and
// where it would leave both the limb and the radius.
struct Barrier {
  CutPlane plane;  // normal outward, away from the trunk
  double radius = 0.0;
  const std::vector<char>* in_limb = nullptr;  // by node
  // What is lower stops it as well, and what is not of the limb and further in, from `side` (1:
  // left).
  double lowest_y = -std::numeric_limits<double>::infinity();
  double innermost_x = -std::numeric_limits<double>::infinity();
  double side = 1.0;
  [[nodiscard]] bool Stops(std::uint32_t node, const Eigen::Vector3d& p) const {
    if (p.y() < lowest_y) return true;
    const bool is_inner = plane.Height(p) < 0.0;
    const bool is_of_limb = (*in_limb)[node] != 0;
    if (!is_of_limb && side * p.x() < innermost_x) return true;
    if (is_of_limb != is_inner) return is_inner;  // most vertices
    const bool is_near = (p - plane.origin).norm() < radius;
    return is_of_limb == is_near;
  }
};

// What a flood has covered.
struct Flooded {
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> vertices;  // of these nodes, and of those that stopped it
};

// What can be reached from `start`, itself included. A node is noted when it is met and asked
// whether it stops the way when its turn comes: once each. Of nodes at the edge those vertices
// count that do not stop the way themselves.
Flooded Flood(const Shape& shape, Flooded start, const Barrier& barrier) {
  std::vector<char> is_free(shape.points.size(), 1);
  for (const std::uint32_t n : start.nodes) is_free[n] = 0;
  Flooded reached = std::move(start);
  const std::size_t start_count = reached.nodes.size();
  const auto met = std::make_unique_for_overwrite<std::uint32_t[]>(shape.points.size() + 1);
  std::copy(reached.nodes.begin(), reached.nodes.end(), met.get());
  std::size_t count = start_count;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t node = met[i];
    if (i >= start_count) {
      for (const std::uint32_t v : shape.coarse->VerticesOf(node)) {
        if (!barrier.Stops(node, shape.vertices[v])) reached.vertices.push_back(v);
      }
      if (barrier.Stops(node, shape.points[node])) continue;
      reached.nodes.push_back(node);
    }
    for (const std::uint32_t n : shape.graph->Neighbours(node)) {
      met[count] = n;
      count += static_cast<std::size_t>(is_free[n]);  // as good as chance: no branch
      is_free[n] = 0;
    }
  }
  return reached;
}

Segment OnSide(Segment left, int side) {
  return static_cast<Segment>(static_cast<int>(left) + 3 * side);
}

// The turn that takes what points down to `direction` the shortest way.
Eigen::Quaterniond TurnDown(const Eigen::Vector3d& direction) {
  return Eigen::Quaterniond::FromTwoVectors(-Eigen::Vector3d::UnitY(), direction);
}

// What a limb gives its own labels to: later ones lie on those before.
struct LabelledVertices {
  Segment segment;
  std::vector<std::uint32_t> vertices;
};
using Labels = std::vector<LabelledVertices>;

// Labels one limb.
class Labeller {
 public:
  Labeller(const Shape& shape, const Landmarks& landmarks) : shape_(shape), landmarks_(landmarks) {}

  Labels Arm(int side) && {
    if (!Has(LandmarkId::kLeftShoulder, side) || !Has(LandmarkId::kLeftElbow, side)) return {};
    TakeUp(*shape_.arms[side]);
    const Flooded tip = From(shape_.arms[side]->tip);
    const Eigen::Vector3d shoulder = At(LandmarkId::kLeftShoulder, side);
    const Eigen::Vector3d elbow = At(LandmarkId::kLeftElbow, side);
    const Eigen::Vector3d wrist = At(LandmarkId::kLeftWrist, side);
    const Eigen::Vector3d arm = (elbow - shoulder).normalized();
    const Eigen::Vector3d aside = SideSign(side) * Eigen::Vector3d::UnitX();
    // What an arm that hangs has turned by; one straight up was raised sideways.
    const Eigen::Quaterniond raised = TurnDown(arm + kAside * aside);
    const Eigen::Vector3d cap =
        Eigen::Quaterniond::Identity().slerp(kCapTiltPerRadian, raised) *
        Eigen::Vector3d(SideSign(side) * std::cos(kCapTiltRad), std::sin(kCapTiltRad), kCapForward);
    // First all that lies beyond the armpit, then on to the cap's plane: an arm that hangs beside
    // the ribs crosses that plane again below the armpit.
    const double hanging = std::clamp(-arm.y(), 0.0, 1.0);
    const Eigen::Vector3d across_arm = shoulder + kArmpitBeyondShoulder * shape_.stature_m * arm;
    const Eigen::Vector3d armpit =
        across_arm + hanging * (At(LandmarkId::kLeftArmpit, side) - across_arm);
    const Eigen::Vector3d outward = arm - hanging * Eigen::Vector3d::UnitY();
    const double radius = kArmRadius + hanging * (kShoulderRadius - kArmRadius);
    const double inner_x = kInnermostOfArm * std::abs(shoulder.x());
    Flooded beyond = Flood(shape_, tip, Across(armpit, outward, kArmpitMargin, radius));
    for (int i = 1; i <= kMostArmpitSteps && HasRunIntoTrunk(beyond, side, inner_x); ++i) {
      beyond = Flood(shape_, tip, Across(armpit, outward, kArmpitMargin + i * kArmpitStep, radius));
    }
    // The side of a wide chest lies beyond the cap's plane too, but below the armpit, and beside a
    // raised arm neck and head do, but further in.
    Barrier at_cap = Across(shoulder, cap, -kCapInside, kShoulderRadius);
    at_cap.lowest_y = At(LandmarkId::kLeftArmpit, side).y() - kBelowArmpit * shape_.stature_m;
    at_cap.innermost_x = kInnermostOfCap * std::abs(shoulder.x());
    at_cap.side = SideSign(side);
    Label(OnSide(Segment::kLeftUpperArm, side), std::move(beyond), at_cap);
    Label(OnSide(Segment::kLeftForearm, side), tip,
          Across(elbow, wrist - shoulder, 0.0, kElbowRadius));
    if (shape_.has_hand[side]) {
      Label(OnSide(Segment::kLeftHand, side), tip,
            Across(wrist, wrist - elbow, kWristBeyond, kWristRadius));
    }
    return std::move(labels_);
  }

  Labels Leg(int side) && {
    if (!Has(LandmarkId::kLeftHip, side) || !Has(LandmarkId::kCrotch)) return {};
    TakeUp(*shape_.legs[side]);
    const Flooded tip = From(shape_.legs[side]->tip);
    const Eigen::Vector3d knee = At(LandmarkId::kLeftKnee, side);
    const Eigen::Vector3d ankle = At(LandmarkId::kLeftAnkle, side);
    // The groin's plane turns half as far as the thigh when that is lifted.
    const Eigen::Vector3d thigh = (knee - At(LandmarkId::kLeftHip, side)).normalized();
    const Eigen::Vector3d shin = (ankle - knee).normalized();
    const Eigen::Vector3d half = thigh - Eigen::Vector3d::UnitY();
    const Eigen::Vector3d groin =
        TurnDown(half) * Eigen::Vector3d(SideSign(side) * kGroinOut, -kGroinAlong, kGroinForward);
    // A lifted thigh takes the skin of the groin along to the front.
    const double lift = std::atan2(thigh.z(), -thigh.y());
    const double taken =
        std::clamp((lift - kHangingThighRad) / (kLiftedThighRad - kHangingThighRad), 0.0, 1.0);
    const Eigen::Vector3d origin = At(LandmarkId::kCrotch) + taken * kGroinTaken *
                                                                 shape_.stature_m * thigh.z() *
                                                                 Eigen::Vector3d::UnitZ();
    Label(OnSide(Segment::kLeftThigh, side), tip,
          Across(origin, groin, kGroinBelowCrotch, kHipRadius));
    const Eigen::Vector3d knee_normal =
        TurnDown(thigh + shin) * Eigen::Vector3d(SideSign(side) * 0.28, -0.86, -0.42);
    Label(OnSide(Segment::kLeftCalf, side), tip,
          Across(knee, knee_normal, kKneeBelow, kKneeRadius));
    if (shape_.has_foot[side]) {
      const Eigen::Vector3d ankle_normal = TurnDown(shin) * Eigen::Vector3d(0.0, -0.97, 0.24);
      Label(OnSide(Segment::kLeftFoot, side), tip,
            Across(ankle, ankle_normal, -kAnkleAbove, kAnkleRadius));
    }
    return std::move(labels_);
  }

  Labels Head() && {
    if (!shape_.neck_base_m) return {};
    TakeUp(*shape_.head);
    const Flooded tip = From(shape_.head->tip);
    const Eigen::Vector3d base = *shape_.neck_base_m;
    Label(Segment::kNeck, tip, Across(base, Eigen::Vector3d(0, 0.96, 0.28), 0.0, kNeckRadius));
    if (shape_.has_head) {
      Label(Segment::kHead, tip,
            Across(base, Eigen::Vector3d(0, 0.745, 0.667), kJawAboveNeck, kNeckRadius));
    }
    return std::move(labels_);
  }

 private:
  [[nodiscard]] bool Has(LandmarkId left, int side = kLeft) const {
    return landmarks_[Sided(left, side)].has_value();
  }
  [[nodiscard]] Eigen::Vector3d At(LandmarkId left, int side = kLeft) const {
    return landmarks_[Sided(left, side)]->position_m;
  }
  [[nodiscard]] bool HasRunIntoTrunk(const Flooded& reached, int side, double inner_x) const {
    return std::any_of(reached.nodes.begin(), reached.nodes.end(), [&](std::uint32_t node) {
      return in_limb_[node] == 0 && SideSign(side) * shape_.points[node].x() < inner_x;
    });
  }
  [[nodiscard]] Barrier Across(const Eigen::Vector3d& origin, const Eigen::Vector3d& outward,
                               double shift, double radius) const {
    const Eigen::Vector3d normal = outward.normalized();
    return {
        {origin + shift * shape_.stature_m * normal, normal}, radius * shape_.stature_m, &in_limb_};
  }
  void TakeUp(const Limb& limb) {
    in_limb_.assign(shape_.points.size(), 0);
    for (const std::uint32_t v : limb.vertices) in_limb_[v] = 1;
  }
  [[nodiscard]] Flooded From(std::uint32_t node) const {
    const std::span<const std::uint32_t> vertices = shape_.coarse->VerticesOf(node);
    return {{node}, {vertices.begin(), vertices.end()}};
  }
  void Label(Segment segment, Flooded start, const Barrier& barrier) {
    labels_.push_back({segment, Flood(shape_, std::move(start), barrier).vertices});
  }

  const Shape& shape_;
  const Landmarks& landmarks_;
  Labels labels_;
  std::vector<char> in_limb_;
};

}  // namespace

std::vector<Segment> LabelVertices(const Shape& shape, const Landmarks& landmarks) {
  std::array<Labels, 5> limbs;
  const auto label = [&](std::size_t limb) -> Labels {
    if (limb == 0) return shape.head ? Labeller(shape, landmarks).Head() : Labels();
    const int side = limb < 3 ? kLeft : kRight;
    if (limb % 2 == 1) return shape.legs[side] ? Labeller(shape, landmarks).Leg(side) : Labels();
    return shape.arms[side] ? Labeller(shape, landmarks).Arm(side) : Labels();
  };
  shape.pool->ForEach(limbs.size(), [&](std::size_t limb) { limbs[limb] = label(limb); });
  std::vector<Segment> segments(shape.vertices.size(), Segment::kTorso);
  for (const Labels& labels : limbs) {
    for (const LabelledVertices& part : labels) {
      for (const std::uint32_t v : part.vertices) segments[v] = part.segment;
    }
  }
  return segments;
}

}  // namespace capfit::body
