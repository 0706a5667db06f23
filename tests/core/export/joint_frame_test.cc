#include "core/export/joint_frame.h"

#include <gtest/gtest.h>

namespace capfit::exports {
namespace {

using Vec3 = Eigen::Vector3d;

ColliderSet WithJoint(const Eigen::Matrix3d& linear) {
  ColliderSet set;
  set.joints.resize(1);
  set.joints[0].to_mesh << linear, Vec3(1, 2, 3);
  return set;
}

const Eigen::Matrix3d& Turn() {
  static const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2.0, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  return turn;
}

TEST(JointFrame, IsTheIdentityWithoutAJoint) {
  EXPECT_TRUE(JointFrame({}, -1).isApprox(Eigen::Isometry3d::Identity()));
}

TEST(JointFrame, LeavesScaleOut) {
  for (const double scale : {1.0, 0.01, 100.0}) {
    const Eigen::Isometry3d frame = JointFrame(WithJoint(scale * Turn()), 0);
    EXPECT_TRUE(frame.linear().isApprox(Turn(), 1e-12));
    EXPECT_TRUE(frame.translation().isApprox(Vec3(1, 2, 3)));
  }
}

TEST(JointFrame, IsARotationWhateverTheMatrix) {
  Eigen::Matrix3d shear = Turn();
  shear.col(1) += 0.7 * shear.col(0);
  const Eigen::Matrix3d mirrored = Turn() * Vec3(1, -1, 1).asDiagonal();
  const Eigen::Matrix3d flat = Turn() * Vec3(1, 0, 1).asDiagonal();
  const std::vector<Eigen::Matrix3d> matrices = {shear, mirrored, flat, Eigen::Matrix3d::Zero()};
  for (const Eigen::Matrix3d& matrix : matrices) {
    const Eigen::Matrix3d turn = JointFrame(WithJoint(matrix), 0).linear();
    EXPECT_TRUE((turn * turn.transpose()).isApprox(Eigen::Matrix3d::Identity(), 1e-12));
    EXPECT_NEAR(turn.determinant(), 1.0, 1e-12);
  }
}

TEST(JointFrame, StandsInOtherFramesWithTheSameAxes) {
  const ColliderSet set = WithJoint(Turn());
  const Vec3 in_joint(0.1, 0.2, 0.3);
  EXPECT_TRUE((JointFrameIn(ZUpFrame(), set, 0) * in_joint)
                  .isApprox(ZUpFrame().Point(JointFrame(set, 0) * in_joint), 1e-12));
}

}  // namespace
}  // namespace capfit::exports
