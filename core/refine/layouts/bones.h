// The bones between landmarks: what layouts are hung on.
#ifndef CAPFIT_CORE_REFINE_LAYOUTS_BONES_H_
#define CAPFIT_CORE_REFINE_LAYOUTS_BONES_H_

#include <Eigen/Core>
#include <array>
#include <optional>

#include "core/body/anatomy.h"
#include "core/body/body.h"

namespace capfit::refine {

enum class BoneId {
  kBelly,     // hip centre to waist
  kRibs,      // waist to bust
  kChest,     // bust to neck
  kHead,      // neck to the top of the head
  kClavicle,  // between bust and neck, to the shoulder; this one and the following: of one side
  kUpperArm,  // shoulder to elbow
  kForearm,   // elbow to wrist
  kHand,      // wrist to fingertip
  kPelvis,    // hip centre to hip joint
  kThigh,     // hip joint to knee
  kShin,      // knee to ankle
  kFoot,      // ankle to toe
  kHeel       // ankle to heel
};
inline constexpr int kBoneCount = 13;
inline constexpr int kMidBoneCount = 4;  // the first four have no side

enum class Side { kLeft, kRight };

// The part of the body that a bone lies in.
[[nodiscard]] body::Part PartOf(BoneId bone, Side side);

struct Bone {
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;  // mean distance to the skin along it; >= 0.15 lengths
};

// Where something sits on a bone: `along` in bone lengths from the first end (beyond the ends, in
// bone radii), `aside` and `ahead` in bone radii. Of a standing body with arms stretched out
// sideways, aside and ahead are: outward and forward for trunk, neck and leg; up and forward for
// clavicle, arm, hand and pelvis; outward and up for the foot. A bone that points elsewhere
// takes them along by the smallest turn.
struct BonePlace {
  double along = 0.0;
  double aside = 0.0;
  double ahead = 0.0;
};

// A body's bones, as far as its landmarks reach.
class Skeleton {
 public:
  explicit Skeleton(const body::Body& body);

  [[nodiscard]] const std::optional<Bone>& bone(BoneId id, Side side) const;
  // In the body frame, metres; nothing where the bone is missing.
  [[nodiscard]] std::optional<Eigen::Vector3d> Position(BoneId id, Side side,
                                                        const BonePlace& place) const;
  // The inverse of Position, for makers of layouts.
  [[nodiscard]] std::optional<BonePlace> PlaceOf(BoneId id, Side side,
                                                 const Eigen::Vector3d& point_m) const;
  // How far the point is from the stretch between the bone's ends, in bone radii; infinite where
  // the bone is missing.
  [[nodiscard]] double DistanceInRadii(BoneId id, Side side, const Eigen::Vector3d& point_m) const;

 private:
  std::array<std::array<std::optional<Bone>, kBoneCount>, 2> bones_;
};

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_LAYOUTS_BONES_H_
