#include "core/pipeline/motion_frames.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::pipeline {
namespace {

using formats::Placing;

constexpr double kLeastDeterminant = 1e-12;  // of a joint's axes, times their lengths

Eigen::Affine3d AffineOf(const Placing& placing) {
  Eigen::Affine3d affine;
  affine.matrix().topRows<3>() = placing;
  affine.makeAffine();
  return affine;
}

bool HasInverse(const Placing& placing) {
  const double lengths = placing.col(0).norm() * placing.col(1).norm() * placing.col(2).norm();
  return placing.allFinite() &&
         std::abs(placing.leftCols<3>().determinant()) > kLeastDeterminant * lengths;
}

// What joints make of a vertex that is stored: the mean of what each alone would, by its weights.
Placing Blend(const formats::JointInfluences& influences, const std::vector<Placing>& of_joint) {
  Placing blend = Placing::Zero();
  for (std::size_t k = 0; k < influences.joint.size(); ++k) {
    if (influences.weight[k] > 0.0F) {
      blend += static_cast<double>(influences.weight[k]) * of_joint[influences.joint[k]];
    }
  }
  return blend;
}

absl::Status CheckFrame(const std::vector<Eigen::Vector3f>& frame, std::size_t vertex_count,
                        const std::string& field) {
  if (frame.size() != vertex_count) {
    return InvalidField(ErrorReason::kCountMismatch, field,
                        absl::StrCat("has ", frame.size(), " vertices, must have ", vertex_count));
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (frame[v].allFinite()) continue;
    return InvalidField(ErrorReason::kNotFinite, absl::StrCat(field, "[", v, "]"),
                        "must be finite");
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status CheckMotion(const Motion& motion, const formats::PolygonSoup& soup) {
  if (motion.frames.empty()) return InvalidField(ErrorReason::kMissing, "motion", "has no frames");
  if (motion.frames.size() > kMostMotionFrames) {
    return TooLarge("motion", motion.frames.size(), "frames", kMostMotionFrames);
  }
  if (!motion.joints.empty() && motion.joints.size() != motion.frames.size()) {
    return InvalidField(ErrorReason::kCountMismatch, "motion",
                        absl::StrCat("has joints of ", motion.joints.size(), " frames, must have ",
                                     motion.frames.size()));
  }
  for (std::size_t f = 0; f < motion.frames.size(); ++f) {
    const std::string field = absl::StrCat("motion[", f, "]");
    CAPFIT_RETURN_IF_ERROR(CheckFrame(motion.frames[f], soup.positions.size(), field));
    if (motion.joints.empty() || motion.joints[f].size() == soup.joints.size()) continue;
    return InvalidField(
        ErrorReason::kCountMismatch, field,
        absl::StrCat("has ", motion.joints[f].size(), " joints, must have ", soup.joints.size()));
  }
  return absl::OkStatus();
}

std::vector<Eigen::Vector3f> PoseVertices(const formats::PolygonSoup& soup,
                                          const std::vector<Placing>& to_mesh) {
  std::vector<Placing> rest;
  std::vector<Placing> now;
  for (std::size_t j = 0; j < soup.joints.size(); ++j) {
    const formats::NamedJoint& joint = soup.joints[j];
    const bool moves = HasInverse(joint.bind) && to_mesh[j].allFinite();
    const Eigen::Affine3d from_stored =
        moves ? AffineOf(joint.bind).inverse() : Eigen::Affine3d::Identity();
    rest.push_back((AffineOf(joint.to_mesh) * from_stored).matrix().topRows<3>());
    now.push_back(
        (AffineOf(moves ? to_mesh[j] : joint.to_mesh) * from_stored).matrix().topRows<3>());
  }
  std::vector<Eigen::Vector3f> posed;
  posed.reserve(soup.positions.size());
  for (std::size_t v = 0; v < soup.positions.size(); ++v) {
    Eigen::Vector3d position = soup.positions[v];
    if (v < soup.influences.size()) {
      const Placing blend = Blend(soup.influences[v], rest);
      if (HasInverse(blend)) {
        const Eigen::Vector3d stored = AffineOf(blend).inverse() * position;
        position = Blend(soup.influences[v], now) * stored.homogeneous();
      }
    }
    posed.push_back(position.cast<float>());
  }
  return posed;
}

}  // namespace capfit::pipeline
