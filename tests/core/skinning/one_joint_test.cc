#include "core/skinning/one_joint.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "core/base/random.h"

namespace capfit::skinning {
namespace {

using Eigen::Vector3d;
using formats::Placing;

// A chain along x, joints a metre apart, and beside its second joint a branch along y.
std::vector<formats::NamedJoint> Chain() {
  std::vector<formats::NamedJoint> joints(5);
  for (int j = 0; j < 4; ++j) {
    joints[j].to_mesh.col(3) = Vector3d(j, 0, 0);
    joints[j].parent = j - 1;
  }
  joints[4].to_mesh.col(3) = Vector3d(1, 1, 0);
  joints[4].parent = 1;
  return joints;
}

// One sphere held by some joints at a place.
BoneWeights Held(const std::vector<std::pair<int, float>>& by, const Vector3d& at) {
  const std::vector<formats::NamedJoint> joints = Chain();
  BoneWeights weights;
  weights.joint_count = joints.size();
  for (const auto& [joint, weight] : by) {
    weights.joints.push_back(static_cast<std::uint16_t>(joint));
    weights.weights.push_back(weight);
    weights.offsets.push_back(at - joints[joint].to_mesh.col(3));
  }
  weights.row_ends.push_back(static_cast<std::uint32_t>(by.size()));
  return weights;
}

// By brute force: every joint turned by 30 degrees about many axes through it.
double DriftByTrying(int on, const BoneWeights& weights) {
  const std::vector<formats::NamedJoint> joints = Chain();
  const auto hangs = [&](int joint, int above) {
    for (; joint >= 0; joint = joints[joint].parent) {
      if (joint == above) return true;
    }
    return false;
  };
  Vector3d center = Vector3d::Zero();
  std::vector<Placing> rest;
  for (const formats::NamedJoint& joint : joints) rest.push_back(joint.to_mesh);
  center = Apply(weights, rest)[0];
  Random random(3);
  double worst = 0.0;
  for (int turned = 0; turned < 5; ++turned) {
    const Vector3d about = joints[turned].to_mesh.col(3);
    for (int trial = 0; trial < 3000; ++trial) {
      const Vector3d axis(random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(-1, 1));
      Eigen::Affine3d turn = Eigen::Affine3d::Identity();
      turn.translate(about)
          .rotate(Eigen::AngleAxisd(std::numbers::pi / 6, axis.normalized()))
          .translate(-about);
      std::vector<Placing> now = rest;
      for (int j = 0; j < 5; ++j) {
        Eigen::Affine3d frame = Eigen::Affine3d::Identity();
        frame.matrix().topRows<3>() = rest[j];
        if (hangs(j, turned)) now[j] = (turn * frame).matrix().topRows<3>();
      }
      const Vector3d carried = hangs(on, turned) ? Vector3d(turn * center) : center;
      worst = std::max(worst, (Apply(weights, now)[0] - carried).norm());
    }
  }
  return worst;
}

TEST(DriftOnTest, IsZeroWhereOneJointHoldsAll) {
  EXPECT_EQ(DriftOn(2, 0, Held({{2, 1.0F}}, {2.5, 0.1, 0}), Chain()), 0.0);
}

TEST(DriftOnTest, IsTheChordOfWhatIsHeldByOthers) {
  // On its parent half of a sphere half a metre beyond the joint stays behind: half of 2 sin 15
  // degrees times half a metre.
  const BoneWeights weights = Held({{1, 0.5F}, {2, 0.5F}}, {2.5, 0, 0});
  EXPECT_NEAR(DriftOn(1, 0, weights, Chain()), 0.5 * 0.5 * 0.5176380902, 1e-9);
  EXPECT_NEAR(DriftOn(2, 0, weights, Chain()), 0.5 * 0.5 * 0.5176380902, 1e-9);
}

TEST(DriftOnTest, MatchesTurningEveryJointAboutManyAxes) {
  const std::vector<BoneWeights> cases = {
      Held({{1, 0.7F}, {2, 0.3F}}, {1.8, 0.2, 0.1}), Held({{2, 0.5F}, {4, 0.5F}}, {1.2, 0.5, -0.1}),
      Held({{0, 0.2F}, {1, 0.5F}, {3, 0.4F}, {4, -0.1F}}, {1.5, 0.3, 0.2})};
  for (const BoneWeights& weights : cases) {
    for (int on = 0; on < 5; ++on) {
      const double tried = DriftByTrying(on, weights);
      const double drift = DriftOn(on, 0, weights, Chain());
      EXPECT_LE(tried, drift + 1e-9);
      EXPECT_GE(tried, 0.99 * drift);
    }
  }
}

TEST(ChooseJointsTest, TakesTheJointOfLeastDriftAndForACapsuleOfTheWorseEnd) {
  BoneWeights weights = Held({{1, 0.8F}, {2, 0.2F}}, {1.9, 0.2, 0});
  const BoneWeights other = Held({{1, 0.1F}, {2, 0.9F}}, {2.4, 0.1, 0});
  weights.joints.insert(weights.joints.end(), other.joints.begin(), other.joints.end());
  weights.weights.insert(weights.weights.end(), other.weights.begin(), other.weights.end());
  weights.offsets.insert(weights.offsets.end(), other.offsets.begin(), other.offsets.end());
  weights.row_ends.push_back(4);
  const std::vector<std::array<int, 2>> capsules = {{0, 1}};
  const OneJoint chosen = ChooseJoints(weights, Chain(), capsules);
  ASSERT_EQ(chosen.of_sphere.size(), 2u);
  for (std::size_t s = 0; s < 2; ++s) {
    for (const std::int32_t joint : {1, 2}) {
      EXPECT_LE(chosen.sphere_drift[s], DriftOn(joint, s, weights, Chain()) * (1 + 1e-6));
    }
    EXPECT_EQ(chosen.sphere_drift[s], DriftOn(chosen.of_sphere[s], s, weights, Chain()));
  }
  EXPECT_EQ(chosen.of_sphere[0], 1);
  EXPECT_EQ(chosen.of_sphere[1], 2);
  const auto worse = [&](std::int32_t joint) {
    return std::max(DriftOn(joint, 0, weights, Chain()), DriftOn(joint, 1, weights, Chain()));
  };
  EXPECT_EQ(chosen.of_capsule[0], worse(1) < worse(2) ? 1 : 2);
}

TEST(OnOneJointTest, HoldsAtRestAndMovesAsTheJointDoes) {
  std::vector<formats::NamedJoint> joints = Chain();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  joints[2].to_mesh.leftCols<3>() = 0.01 * turn;  // a bone in centimetres, in axes of its own
  const std::vector<Vector3d> centers = {{2.5, 0.1, 0}, {0.2, -0.3, 4}, {2, 1, 1}};
  const std::vector<std::int32_t> of_center = {2, 0, 2};
  const BoneWeights weights = OnOneJoint(centers, of_center, joints);
  std::vector<Placing> now;
  for (const formats::NamedJoint& joint : joints) now.push_back(joint.to_mesh);
  const std::vector<Vector3d> rest = Apply(weights, now);
  Eigen::Affine3d moves(Eigen::Translation3d(3, -1, 2) *
                        Eigen::AngleAxisd(-0.7, Vector3d(0, 1, 1).normalized()));
  now[2].leftCols<3>() = moves.linear() * now[2].leftCols<3>();
  now[2].col(3) = moves * joints[2].to_mesh.col(3);
  const std::vector<Vector3d> moved = Apply(weights, now);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    EXPECT_LE((rest[i] - centers[i]).norm(), 1e-12) << i;
    const Vector3d wanted = of_center[i] == 2 ? Vector3d(moves * centers[i]) : centers[i];
    EXPECT_LE((moved[i] - wanted).norm(), 1e-12) << i;
  }
}

TEST(OnOneJointTest, AJointWithoutVolumeKeepsItsCentresAtItself) {
  std::vector<formats::NamedJoint> joints = Chain();
  joints[1].to_mesh.col(0).setZero();
  const std::vector<Vector3d> centers = {{1.5, 0.1, 0}};
  const std::vector<std::int32_t> of_center = {1};
  EXPECT_EQ(OnOneJoint(centers, of_center, joints).offsets[0], Vector3d::Zero());
}

}  // namespace
}  // namespace capfit::skinning
