#include "tests/bench/pose_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/body/anatomy.h"

namespace capfit::body {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// Rounds of averaging over neighbours by which a bone's hold on the skin fades.
constexpr int kFadeRounds = 12;

double Radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

class Poser {
 public:
  explicit Poser(const TrueBody& rest) : body_(rest) {
    FindNeighbours();
    FindCrotch();
  }

  void PoseSide(const std::string& side, double sign, const LimbPose& pose) {
    const Segment upper_arm = sign > 0 ? Segment::kLeftUpperArm : Segment::kRightUpperArm;
    const Segment thigh = sign > 0 ? Segment::kLeftThigh : Segment::kRightThigh;
    // First straight, then bent, then turned as a whole: from the outside inward.
    Turn(side, "elbow", {"wrist"}, upper_arm, 1, Between(side, "elbow", "wrist", Bone(side)));
    const Vector3d down = -Vector3d::UnitY();
    Turn(side, "shoulder", {"elbow", "wrist"}, upper_arm, 0,
         Quaterniond::FromTwoVectors(Bone(side), down));
    Turn(side, "elbow", {"wrist"}, upper_arm, 1,
         AboutY(-sign * pose.arm_inward) * AboutX(-pose.elbow_bend));
    Turn(side, "shoulder", {"elbow", "wrist"}, upper_arm, 0,
         AboutZ(sign * pose.arm_aside) * AboutX(-pose.arm_forward));
    Turn(side, "knee", {"ankle"}, thigh, 1, AboutX(pose.knee_bend));
    Turn(side, "hip", {"knee", "ankle"}, thigh, 0,
         AboutZ(sign * pose.leg_aside) * AboutX(-pose.leg_forward));
  }

  // The crotch is a place on the skin and has gone where that went.
  TrueBody Take() && {
    if (crotch_) body_.joints.at("crotch") = body_.soup.positions[*crotch_];
    return std::move(body_);
  }

 private:
  static Quaterniond AboutX(double degrees) {
    return Quaterniond(Eigen::AngleAxisd(Radians(degrees), Vector3d::UnitX()));
  }
  static Quaterniond AboutY(double degrees) {
    return Quaterniond(Eigen::AngleAxisd(Radians(degrees), Vector3d::UnitY()));
  }
  static Quaterniond AboutZ(double degrees) {
    return Quaterniond(Eigen::AngleAxisd(Radians(degrees), Vector3d::UnitZ()));
  }

  [[nodiscard]] Vector3d Joint(const std::string& side, const std::string& joint) const {
    return body_.joints.at(side + "_" + joint);
  }
  [[nodiscard]] Vector3d Bone(const std::string& side) const {
    return Joint(side, "elbow") - Joint(side, "shoulder");
  }
  [[nodiscard]] Quaterniond Between(const std::string& side, const std::string& from,
                                    const std::string& to, const Vector3d& wanted) const {
    return Quaterniond::FromTwoVectors(Joint(side, to) - Joint(side, from), wanted);
  }

  void FindCrotch() {
    const auto joint = body_.joints.find("crotch");
    if (joint == body_.joints.end()) return;
    const std::vector<Vector3d>& skin = body_.soup.positions;
    const auto nearest =
        std::min_element(skin.begin(), skin.end(), [&](const Vector3d& a, const Vector3d& b) {
          return (a - joint->second).squaredNorm() < (b - joint->second).squaredNorm();
        });
    crotch_ = static_cast<std::size_t>(nearest - skin.begin());
  }

  void FindNeighbours() {
    neighbours_.resize(body_.soup.positions.size());
    std::size_t at = 0;
    const bool are_triangles = body_.soup.face_sizes.empty();
    while (at < body_.soup.face_vertices.size()) {
      const std::size_t size = are_triangles ? 3 : body_.soup.face_sizes[faces_++];
      for (std::size_t k = 0; k < size; ++k) {
        const std::uint32_t a = body_.soup.face_vertices[at + k];
        const std::uint32_t b = body_.soup.face_vertices[at + (k + 1) % size];
        neighbours_[a].push_back(b);
        neighbours_[b].push_back(a);
      }
      at += size;
    }
  }

  // 1 on the three segments of the limb from `first` + `skip` on, fading across the boundary.
  [[nodiscard]] std::vector<double> HoldOf(Segment first, int skip) const {
    const int low = static_cast<int>(first) + skip;
    const int high = static_cast<int>(first) + 2;
    std::vector<double> hold(body_.labels.size());
    for (std::size_t v = 0; v < hold.size(); ++v) {
      hold[v] = body_.labels[v] >= low && body_.labels[v] <= high ? 1.0 : 0.0;
    }
    for (int round = 0; round < kFadeRounds; ++round) {
      std::vector<double> next = hold;
      for (std::size_t v = 0; v < hold.size(); ++v) {
        double sum = 0.0;
        for (const std::uint32_t n : neighbours_[v]) sum += hold[n];
        if (!neighbours_[v].empty()) {
          next[v] = 0.5 * hold[v] + 0.5 * sum / static_cast<double>(neighbours_[v].size());
        }
      }
      hold = std::move(next);
    }
    return hold;
  }

  void Turn(const std::string& side, const std::string& about,
            const std::vector<std::string>& moved, Segment first, int skip,
            const Quaterniond& turn) {
    const Vector3d center = Joint(side, about);
    const std::vector<double> hold = HoldOf(first, skip);
    for (std::size_t v = 0; v < hold.size(); ++v) {
      if (hold[v] <= 0.0) continue;
      Vector3d& p = body_.soup.positions[v];
      // Half-way turned rather than half-way there: skin keeps its thickness.
      p = center + Quaterniond::Identity().slerp(hold[v], turn) * (p - center);
    }
    for (const std::string& joint : moved) {
      Vector3d& p = body_.joints.at(side + "_" + joint);
      p = center + turn * (p - center);
    }
  }

  TrueBody body_;
  std::size_t faces_ = 0;
  std::optional<std::size_t> crotch_;  // vertex
  std::vector<std::vector<std::uint32_t>> neighbours_;
};

}  // namespace

std::vector<Pose> UnseenPoses() {
  return {{"t_pose", {90}, {90}},
          {"sides_20", {20}, {20}},
          {"sides_12", {12}, {12}},
          {"one_arm_up", {150}, {20}},
          {"both_arms_up", {160}, {160}},
          {"elbows_90", {25, 0, 90}, {25, 0, 90}},
          {"arms_forward", {8, 85, 5}, {8, 85, 5}},
          {"waving", {80, 0, 80}, {15, 10, 20}},
          {"hands_on_hips", {52, -10, 95, 80}, {52, -10, 95, 80}},
          {"arms_crossed", {10, 55, 95, 75}, {10, 35, 95, 75}},
          {"reaching_up", {30, 150, 20}, {20, 60, 60}},
          {"stride", {15, -25, 15, 0, 0, -20, 15}, {15, 25, 25, 0, 0, 28, 10}},
          {"long_stride", {20, 30, 40, 0, 0, -30, 30}, {20, -30, 20, 0, 0, 40, 20}},
          {"legs_apart", {60, 0, 0, 0, 15}, {60, 0, 0, 0, 15}},
          {"legs_wide", {80, 0, 0, 0, 32}, {80, 0, 0, 0, 32}},
          {"marching", {20, 30, 40, 0, 0, 60, 70}, {20, -20, 20}},
          {"knee_up", {30, 0, 20, 0, 5, 90, 90}, {30, 0, 20}},
          {"squat", {10, 80, 10, 0, 15, 60, 80}, {10, 80, 10, 0, 15, 60, 80}},
          {"sitting", {20, 25, 40, 0, 8, 85, 85}, {20, 25, 40, 0, 8, 85, 85}}};
}

TrueBody InPose(const TrueBody& rest, const Pose& pose) {
  Poser poser(rest);
  poser.PoseSide("left", 1.0, pose.left);
  poser.PoseSide("right", -1.0, pose.right);
  return std::move(poser).Take();
}

}  // namespace capfit::body
