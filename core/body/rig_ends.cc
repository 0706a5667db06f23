#include "core/body/rig_ends.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/body/snap.h"

namespace capfit::body {
namespace {

// In units of the square root of the surface's area (0.75 of the height).

// A wrist lies some 3 cm under the skin, a head's joint 8; wide sleeves and boots add as much.
constexpr double kNearEnd = 0.12;
// Ankle to head of somebody who squats; the skeleton of a toy in the body's belly is smaller.
constexpr double kLeastExtent = 0.5;
constexpr int kFewestEnds = 3;

std::optional<Eigen::Vector3d> Mean(const Rig& rig, LandmarkId left) {
  const auto a = rig.at(left);
  const auto b = rig.at(MirrorLandmark(left));
  if (!a || !b) return std::nullopt;
  return Eigen::Vector3d(0.5 * (*a + *b));
}

// The nearest vertex, unless it is far.
std::optional<std::uint32_t> VertexNear(const std::optional<Eigen::Vector3d>& joint,
                                        const WorkingCopy& copy) {
  if (!joint) return std::nullopt;
  const Eigen::Vector3d at = Snap(copy.FromMesh(*joint), kFineGrid);
  std::uint32_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t v = 0; v < copy.points.size(); ++v) {
    const double distance = (copy.points[v] - at).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    nearest = v;
  }
  return least <= kNearEnd * kNearEnd ? std::optional(nearest) : std::nullopt;
}

bool AreFarApart(const RigEnds& ends, const WorkingCopy& copy) {
  double farthest = 0.0;
  int count = 0;
  for (const auto& a : ends.vertex) {
    count += a ? 1 : 0;
    for (const auto& b : ends.vertex) {
      if (a && b) farthest = std::max(farthest, (copy.points[*a] - copy.points[*b]).norm());
    }
  }
  return count >= kFewestEnds && farthest >= kLeastExtent;
}

void FindAxes(const Rig& rig, const WorkingCopy& copy, RigEnds& ends) {
  const auto shoulders = Mean(rig, LandmarkId::kLeftShoulder);
  const auto hips = Mean(rig, LandmarkId::kLeftHip);
  if (!shoulders || !hips) return;
  const auto direction = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return Snap(copy.axes * (to - from) / copy.unit, kFineGrid).normalized();
  };
  const Eigen::Vector3d right_to_left = 0.5 * (*rig.at(LandmarkId::kLeftShoulder) +
                                               *rig.at(LandmarkId::kLeftHip) -
                                               *rig.at(LandmarkId::kRightShoulder) -
                                               *rig.at(LandmarkId::kRightHip));
  ends.up = direction(*hips, rig.at(LandmarkId::kNeck).value_or(*shoulders));
  ends.left = direction(Eigen::Vector3d::Zero(), right_to_left);
  ends.middle = Snap(copy.FromMesh(0.5 * (*shoulders + *hips)), kFineGrid);
  if (!ends.up->allFinite() || !ends.left->allFinite()) ends.up = ends.left = std::nullopt;
}

}  // namespace

std::optional<RigEnds> FindRigEnds(const Rig& rig, const WorkingCopy& copy) {
  RigEnds ends;
  const std::array<std::optional<Eigen::Vector3d>, kRigEndCount> joints = {
      rig.head ? rig.head : rig.at(LandmarkId::kNeck), rig.at(LandmarkId::kLeftWrist),
      rig.at(LandmarkId::kRightWrist), rig.at(LandmarkId::kLeftAnkle),
      rig.at(LandmarkId::kRightAnkle)};
  for (std::size_t i = 0; i < joints.size(); ++i) ends.vertex[i] = VertexNear(joints[i], copy);
  if (!AreFarApart(ends, copy)) return std::nullopt;
  FindAxes(rig, copy, ends);
  return ends;
}

}  // namespace capfit::body
