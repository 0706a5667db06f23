#include "core/export/joint_frame.h"

#include <Eigen/SVD>

namespace capfit::exports {
namespace {

Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  // A mirrored joint: the least stretched direction is turned about.
  if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) *= -1.0;
  return u * svd.matrixV().transpose();
}

}  // namespace

Eigen::Isometry3d JointFrame(const ColliderSet& upright, std::int32_t index) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  if (index < 0) return frame;
  const formats::NamedJoint& joint = upright.joints[index];
  frame.linear() = NearestRotation(joint.to_mesh.leftCols<3>());
  frame.translation() = joint.to_mesh.col(3);
  return frame;
}

Eigen::Isometry3d JointFrameIn(const Frame& frame, const ColliderSet& upright, std::int32_t index) {
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() = frame.from_upright;
  return turn * JointFrame(upright, index);
}

std::vector<Eigen::Vector3d> CentersInJoints(const ColliderSet& upright) {
  std::vector<Eigen::Vector3d> centers;
  for (std::size_t i = 0; i < upright.sphere_count(); ++i) {
    const std::int32_t joint = upright.sphere_joints.empty() ? -1 : upright.sphere_joints[i];
    centers.emplace_back(JointFrame(upright, joint).inverse() *
                         upright.primitives.spheres[i].center_m);
  }
  return centers;
}

}  // namespace capfit::exports
