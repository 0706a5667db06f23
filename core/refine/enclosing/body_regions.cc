#include "core/refine/enclosing/body_regions.h"

#include <cmath>
#include <limits>

namespace capfit::refine {
namespace {

Region RegionOf(BoneId bone, Side side) {
  switch (bone) {
    case BoneId::kRibs:
    case BoneId::kChest:
    case BoneId::kHead:
    case BoneId::kClavicle:
      return Region::kTrunk;
    case BoneId::kBelly:
    case BoneId::kPelvis:
      return Region::kBelly;
    case BoneId::kUpperArm:
    case BoneId::kForearm:
    case BoneId::kHand:
      return side == Side::kLeft ? Region::kLeftArm : Region::kRightArm;
    case BoneId::kThigh:
    case BoneId::kShin:
    case BoneId::kFoot:
    case BoneId::kHeel:
      return side == Side::kLeft ? Region::kLeftLeg : Region::kRightLeg;
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
