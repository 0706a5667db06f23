#include "core/body/rig_ends.h"

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/enum_index.h"
#include "core/body/cross_section.h"
#include "core/body/inside.h"
#include "core/geometry/snap.h"

namespace capfit::body {
namespace {

// In units of the square root of the surface's area (0.75 of the height; of somebody in a wide
// skirt, with hair and a backpack down to 0.5).

// A wrist lies some 3 cm under the skin, a head's joint 8; wide sleeves and boots add as much.
constexpr double kNearEnd = 0.12;
// From the neck over the middle of the hips, knee and ankle: 0.95 to 1.1 of bare bodies.
constexpr double kShortestWay = 0.65;
constexpr double kLongestWay = 1.35;
// Of an upper body, whose area is a third to two thirds of the whole one's, 1.2 to 1.9.
constexpr double kLongestWayOfUpperBody = 2.1;
// Joints are set by eye (3 cm), and this share of the bones may run outside.
constexpr double kNearBone = 0.025;
constexpr int kPlacesOnEach = 5;
constexpr double kMostBonesOutside = 0.2;

// The joints in the working copy's coordinates.
class RigInCopy {
 public:
  RigInCopy(const Rig& rig, const WorkingCopy& copy) {
    for (const auto& [id, position] : rig.landmarks) at_[id] = InCopy(position, copy);
    if (rig.head) head_ = InCopy(*rig.head, copy);
  }

  [[nodiscard]] bool IsWhole() const {
    return at_.size() == kJoints;  // the neck and six of each side
  }
  [[nodiscard]] const Eigen::Vector3d& at(LandmarkId id) const { return at_.at(id); }
  [[nodiscard]] Eigen::Vector3d Middle(LandmarkId left) const {
    return 0.5 * (at(left) + at(MirrorLandmark(left)));
  }
  [[nodiscard]] const std::optional<Eigen::Vector3d>& head() const { return head_; }

  // From joint to joint.
  [[nodiscard]] std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> Bones(
      bool with_legs) const {
    std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> bones = {
        {at(LandmarkId::kNeck), Middle(LandmarkId::kLeftHip)}};
    for (const LandmarkId left : {LandmarkId::kLeftShoulder, LandmarkId::kLeftElbow,
                                  LandmarkId::kLeftHip, LandmarkId::kLeftKnee}) {
      if (!with_legs && left >= LandmarkId::kLeftHip) break;
      for (const LandmarkId id : {left, MirrorLandmark(left)}) {
        // Landmarks of a side follow each other by two.
        bones.emplace_back(at(id), at(static_cast<LandmarkId>(static_cast<int>(id) + 2)));
      }
    }
    return bones;
  }

  [[nodiscard]] double NeckToAnkle() const {
    const Eigen::Vector3d hips = Middle(LandmarkId::kLeftHip);
    double legs = 0.0;
    for (const LandmarkId hip : {LandmarkId::kLeftHip, LandmarkId::kRightHip}) {
      const auto knee = static_cast<LandmarkId>(static_cast<int>(hip) + 2);
      const auto ankle = static_cast<LandmarkId>(static_cast<int>(hip) + 4);
      legs += (at(knee) - at(hip)).norm() + (at(ankle) - at(knee)).norm();
    }
    return (at(LandmarkId::kNeck) - hips).norm() + 0.5 * legs;
  }

 private:
  static constexpr std::size_t kJoints = 13;

  static Eigen::Vector3d InCopy(const Eigen::Vector3d& p, const WorkingCopy& copy) {
    return geometry::Snap(copy.frame.FromMesh(p), geometry::kFineGrid);
  }

  std::map<LandmarkId, Eigen::Vector3d> at_;
  std::optional<Eigen::Vector3d> head_;
};

// The nearest node, unless it is far.
std::optional<std::uint32_t> NodeNear(const Eigen::Vector3d& at, const CoarseSurface& coarse) {
  std::uint32_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t n = 0; n < coarse.points.size(); ++n) {
    const double distance = (coarse.points[n] - at).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    nearest = n;
  }
  return least <= kNearEnd * kNearEnd ? std::optional(nearest) : std::nullopt;
}

bool RunsInside(const RigInCopy& rig, bool with_legs, const CoarseSurface& coarse,
                const ThreadPool& pool) {
  const CutSurface surface(coarse.points, coarse.triangles, pool);
  const auto bones = rig.Bones(with_legs);
  int outside = 0;
  for (const auto& [from, to] : bones) {
    outside += PlacesOutside(surface, from, to, kNearBone, kPlacesOnEach);
  }
  return outside <= kMostBonesOutside * kPlacesOnEach * static_cast<double>(bones.size());
}

}  // namespace

std::optional<RigEnds> FindRigEnds(const Rig& rig, const WorkingCopy& copy,
                                   const CoarseSurface& coarse, const ThreadPool& pool) {
  const RigInCopy in_copy(rig, copy);
  if (!in_copy.IsWhole()) return std::nullopt;
  // Of an upper body both ankles are far from everything, and so are the knees.
  const auto is_far = [&](LandmarkId id) { return !NodeNear(in_copy.at(id), coarse); };
  const bool has_legs = !(is_far(LandmarkId::kLeftAnkle) && is_far(LandmarkId::kRightAnkle) &&
                          is_far(LandmarkId::kLeftKnee) && is_far(LandmarkId::kRightKnee));
  const double way = in_copy.NeckToAnkle();
  const double longest = has_legs ? kLongestWay : kLongestWayOfUpperBody;
  if (!(way > kShortestWay && way < longest)) return std::nullopt;
  RigEnds ends;
  const std::array<std::optional<Eigen::Vector3d>, kRigEndCount> joints = {
      in_copy.head(), in_copy.at(LandmarkId::kLeftWrist), in_copy.at(LandmarkId::kRightWrist),
      in_copy.at(LandmarkId::kLeftAnkle), in_copy.at(LandmarkId::kRightAnkle)};
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const bool is_foot = i >= Index(RigEnd::kLeftFoot);
    if (!joints[i] || (is_foot && !has_legs)) continue;
    ends.vertex[i] = NodeNear(*joints[i], coarse);
    if (!ends.vertex[i]) return std::nullopt;
  }
  const Eigen::Vector3d up = in_copy.at(LandmarkId::kNeck) - in_copy.Middle(LandmarkId::kLeftHip);
  const Eigen::Vector3d left = in_copy.at(LandmarkId::kLeftShoulder) -
                               in_copy.at(LandmarkId::kRightShoulder) +
                               in_copy.at(LandmarkId::kLeftHip) - in_copy.at(LandmarkId::kRightHip);
  if (!(up.norm() > 0.0 && left.norm() > 0.0)) return std::nullopt;
  if (!RunsInside(in_copy, has_legs, coarse, pool)) return std::nullopt;
  ends.up = up.normalized();
  ends.left = left.normalized();
  ends.middle =
      0.5 * (in_copy.Middle(LandmarkId::kLeftShoulder) + in_copy.Middle(LandmarkId::kLeftHip));
  return ends;
}

}  // namespace capfit::body
