#include "core/refine/enclosing/body_regions.h"

#include <cmath>
#include <limits>

namespace capfit::refine {
namespace {

Region RegionOf(BoneId bone, Side side) {
  if (bone == BoneId::kBelly || bone == BoneId::kPelvis) return Region::kBelly;
  switch (PartOf(bone, side)) {
    case body::Part::kTorso:
    case body::Part::kHead:
      return Region::kTrunk;
    case body::Part::kLeftArm:
    case body::Part::kLeftHand:
      return Region::kLeftArm;
    case body::Part::kRightArm:
    case body::Part::kRightHand:
      return Region::kRightArm;
    case body::Part::kLeftLeg:
    case body::Part::kLeftFoot:
      return Region::kLeftLeg;
    case body::Part::kRightLeg:
    case body::Part::kRightFoot:
      return Region::kRightLeg;
  }
  return Region::kTrunk;
}

}  // namespace

BodyRegions::BodyRegions(const body::Body& body)
    : skeleton_(body), is_symmetric_(body.is_symmetric) {}

Region BodyRegions::RegionAt(Eigen::Vector3d point_m) const {
  Region region = Region::kTrunk;
  if (!skeleton_) return region;
  if (is_symmetric_) point_m.x() = std::abs(point_m.x());
  double least = std::numeric_limits<double>::infinity();
  for (const Side side : {Side::kLeft, Side::kRight}) {
    if (is_symmetric_ && side == Side::kRight) continue;
    for (int i = 0; i < kBoneCount; ++i) {
      const auto bone = static_cast<BoneId>(i);
      const double distance = skeleton_->DistanceInRadii(bone, side, point_m);
      if (distance < least) least = distance, region = RegionOf(bone, side);
    }
  }
  return region;
}

}  // namespace capfit::refine
