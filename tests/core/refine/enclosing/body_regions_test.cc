#include "core/refine/enclosing/body_regions.h"

#include <gtest/gtest.h>

#include "core/base/enum_index.h"
#include "tests/core/refine/mannequin_body.h"

namespace capfit::refine {
namespace {

using body::LandmarkId;
using Vec3 = Eigen::Vector3d;

Vec3 Between(LandmarkId a, LandmarkId b) {
  return 0.5 * (MannequinBody().landmark(a)->position_m + MannequinBody().landmark(b)->position_m);
}

TEST(BodyRegionsTest, LimbsAndTrunkAreWhereTheirJointsAre) {
  const BodyRegions regions(MannequinBody());
  const auto at = [&](LandmarkId a, LandmarkId b) { return regions.RegionAt(Between(a, b)); };
  EXPECT_EQ(at(LandmarkId::kLeftShoulder, LandmarkId::kLeftElbow), Region::kLeftArm);
  EXPECT_EQ(at(LandmarkId::kLeftElbow, LandmarkId::kLeftWrist), Region::kLeftArm);
  EXPECT_EQ(at(LandmarkId::kLeftWrist, LandmarkId::kLeftFingertip), Region::kLeftArm);
  EXPECT_EQ(at(LandmarkId::kLeftHip, LandmarkId::kLeftKnee), Region::kLeftLeg);
  EXPECT_EQ(at(LandmarkId::kLeftAnkle, LandmarkId::kLeftToe), Region::kLeftLeg);
  EXPECT_EQ(at(LandmarkId::kBust, LandmarkId::kNeck), Region::kTrunk);
  EXPECT_EQ(at(LandmarkId::kNeck, LandmarkId::kHeadTop), Region::kTrunk);
  EXPECT_EQ(at(LandmarkId::kWaist, LandmarkId::kHip), Region::kBelly);
}

// So images are in the same region, and come from the same donor.
TEST(BodyRegionsTest, BothSidesOfASymmetricBodyAreOne) {
  ASSERT_TRUE(MannequinBody().is_symmetric);
  const BodyRegions regions(MannequinBody());
  for (const Vec3& vertex : MannequinBody().mesh.vertices()) {
    EXPECT_EQ(regions.RegionAt(vertex), regions.RegionAt({-vertex.x(), vertex.y(), vertex.z()}));
  }
}

TEST(BodyRegionsTest, TheSidesOfOtherBodiesAreApart) {
  body::Body body = MannequinBody();
  body.is_symmetric = false;
  const BodyRegions regions(body);
  const auto at = [&](LandmarkId a, LandmarkId b) { return regions.RegionAt(Between(a, b)); };
  EXPECT_EQ(at(LandmarkId::kLeftElbow, LandmarkId::kLeftWrist), Region::kLeftArm);
  EXPECT_EQ(at(LandmarkId::kRightElbow, LandmarkId::kRightWrist), Region::kRightArm);
  EXPECT_EQ(at(LandmarkId::kRightHip, LandmarkId::kRightKnee), Region::kRightLeg);
}

TEST(BodyRegionsTest, WithoutABodyAllIsTrunk) {
  EXPECT_EQ(BodyRegions().RegionAt({0.3, -1.0, 2.0}), Region::kTrunk);
}

// A group is named by one of its own, and the body is divided in each.
TEST(BodyRegionsTest, DivisionsNameTheirGroups) {
  for (const RegionGroups& groups : kDivisions) {
    for (const Region group : groups) EXPECT_EQ(groups[Index(group)], group);
    EXPECT_NE(groups[Index(Region::kLeftArm)], groups[Index(Region::kTrunk)]);
    EXPECT_NE(groups[Index(Region::kLeftLeg)], groups[Index(Region::kTrunk)]);
  }
}

}  // namespace
}  // namespace capfit::refine
