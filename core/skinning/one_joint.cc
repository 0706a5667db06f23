#include "core/skinning/one_joint.h"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <limits>
#include <set>

#include "core/base/ties.h"

namespace capfit::skinning {
namespace {

using formats::NamedJoint;

// 2 sin(15 degrees): how far a point at distance 1 from the axis moves in a turn of 30 degrees.
constexpr double kChordOf30Degrees = 0.51763809020504152;

// Whether `joint` is `above` or hangs below it.
bool HangsOn(std::int32_t joint, std::int32_t above, std::span<const NamedJoint> joints) {
  for (std::size_t step = 0; joint >= 0 && step <= joints.size(); ++step) {
    if (joint == above) return true;
    joint = joints[joint].parent;
  }
  return false;
}

Eigen::Vector3d PlaceOf(const BoneWeights& weights, std::size_t entry,
                        std::span<const NamedJoint> joints) {
  const formats::Placing& to_mesh = joints[weights.joints[entry]].to_mesh;
  return to_mesh.leftCols<3>() * weights.offsets[entry] + to_mesh.col(3);
}

// The joints that hold the sphere, and all above them.
std::set<std::int32_t> Turning(std::size_t sphere, const BoneWeights& weights,
                               std::span<const NamedJoint> joints) {
  std::set<std::int32_t> turning;
  for (std::size_t i = weights.RowBegin(sphere); i < weights.row_ends[sphere]; ++i) {
    std::int32_t joint = weights.joints[i];
    while (joint >= 0 && turning.insert(joint).second) {
      joint = joints[joint].parent;
    }
  }
  return turning;
}

}  // namespace

double DriftOn(std::int32_t joint, std::size_t sphere, const BoneWeights& weights,
               std::span<const NamedJoint> joints) {
  std::set<std::int32_t> turning = Turning(sphere, weights, joints);
  for (std::int32_t above = joint; above >= 0 && turning.insert(above).second;) {
    above = joints[above].parent;
  }
  double drift = 0.0;
  for (const std::int32_t turned : turning) {
    // A turn R about x moves the centre by (R - 1) of the sum of weight * (place - x) over what
    // turns, and the joint's own idea of it by (R - 1) (centre - x) if the joint turns too.
    const Eigen::Vector3d& about = joints[turned].to_mesh.col(3);
    const bool is_carried = HangsOn(joint, turned, joints);
    Eigen::Vector3d apart = Eigen::Vector3d::Zero();
    for (std::size_t i = weights.RowBegin(sphere); i < weights.row_ends[sphere]; ++i) {
      if (HangsOn(weights.joints[i], turned, joints) == is_carried) continue;
      apart += static_cast<double>(weights.weights[i]) * (PlaceOf(weights, i, joints) - about);
    }
    drift = std::max(drift, kChordOf30Degrees * apart.norm());
  }
  return drift;
}

OneJoint ChooseJoints(const BoneWeights& weights, std::span<const NamedJoint> joints,
                      std::span<const std::array<int, 2>> capsules) {
  const auto holders = [&](std::size_t sphere, std::set<std::int32_t>& all) {
    for (std::size_t i = weights.RowBegin(sphere); i < weights.row_ends[sphere]; ++i) {
      all.insert(weights.joints[i]);
    }
  };
  OneJoint result;
  for (std::size_t s = 0; s < weights.sphere_count(); ++s) {
    std::set<std::int32_t> candidates;
    holders(s, candidates);
    std::int32_t best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t joint : candidates) {
      const double drift = DriftOn(joint, s, weights, joints);
      if (best >= 0 && !ClearlyLess(drift, least)) continue;
      best = joint;
      least = drift;
    }
    result.of_sphere.push_back(best);
    result.sphere_drift.push_back(least);
  }
  for (const std::array<int, 2>& ends : capsules) {
    std::set<std::int32_t> candidates;
    for (const int end : ends) holders(end, candidates);
    std::int32_t best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t joint : candidates) {
      const double drift = std::max(DriftOn(joint, ends[0], weights, joints),
                                    DriftOn(joint, ends[1], weights, joints));
      if (best >= 0 && !ClearlyLess(drift, least)) continue;
      best = joint;
      least = drift;
    }
    result.of_capsule.push_back(best);
  }
  return result;
}

BoneWeights OnOneJoint(std::span<const Eigen::Vector3d> centers,
                       std::span<const std::int32_t> of_center,
                       std::span<const NamedJoint> joints) {
  assert(centers.size() == of_center.size());
  BoneWeights result;
  result.joint_count = joints.size();
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const formats::Placing& to_mesh = joints[of_center[i]].to_mesh;
    Eigen::Matrix3d from_mesh;
    bool has_inverse = false;
    to_mesh.leftCols<3>().computeInverseWithCheck(from_mesh, has_inverse, 0.0);
    if (!has_inverse) from_mesh.setZero();
    result.joints.push_back(static_cast<std::uint16_t>(of_center[i]));
    result.weights.push_back(1.0F);
    result.offsets.emplace_back(from_mesh * (centers[i] - to_mesh.col(3)));
    result.row_ends.push_back(static_cast<std::uint32_t>(i + 1));
  }
  return result;
}

}  // namespace capfit::skinning
