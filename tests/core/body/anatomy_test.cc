#include "core/body/anatomy.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/body/body.h"

namespace capfit::body {
namespace {

TEST(Anatomy, LandmarkNamesLeadBackAndMirrorTwiceIsNothing) {
  std::set<std::string_view> names;
  for (int i = 0; i < kLandmarkCount; ++i) {
    const LandmarkId id = static_cast<LandmarkId>(i);
    names.insert(LandmarkName(id));
    EXPECT_EQ(LandmarkFromName(LandmarkName(id)), id);
    EXPECT_EQ(MirrorLandmark(MirrorLandmark(id)), id);
    std::string mirrored(LandmarkName(id));
    if (mirrored.starts_with("left_")) {
      EXPECT_EQ(LandmarkName(MirrorLandmark(id)), "right_" + mirrored.substr(5));
    }
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kLandmarkCount));
  EXPECT_FALSE(LandmarkFromName("left_nose"));
}

TEST(Anatomy, PartsAmongSegmentsAreThoseOfEachSegment) {
  for (int s = 0; s < kSegmentCount; ++s) {
    const std::vector<Segment> segments(3, static_cast<Segment>(s));
    const std::array<bool, kPartCount> has_part = PartsAmong(segments);
    for (int p = 0; p < kPartCount; ++p) {
      EXPECT_EQ(has_part[p], static_cast<Part>(p) == PartOf(segments[0])) << s << ", " << p;
    }
  }
  EXPECT_EQ(PartsAmong({}), (std::array<bool, kPartCount>{}));
}

TEST(Anatomy, SelectionsLeaveOutPartsThatAreThere) {
  const std::vector<Segment> segments = {Segment::kTorso, Segment::kNeck, Segment::kLeftFoot};
  PartSelection parts = {false, false, false, false, false, false};
  EXPECT_FALSE(LeavesOutSome({}, parts));
  parts.torso = true;
  EXPECT_TRUE(LeavesOutSome(segments, parts));
  EXPECT_FALSE(LeavesOutSome(std::span(segments).first(2), parts));
  parts.feet = true;
  EXPECT_FALSE(LeavesOutSome(segments, parts));
}

TEST(Anatomy, PartsMirrorBySide) {
  for (int i = 0; i < kPartCount; ++i) {
    const Part part = static_cast<Part>(i);
    EXPECT_EQ(MirrorPart(MirrorPart(part)), part);
    const std::string name(PartName(part));
    if (name.starts_with("left_")) {
      EXPECT_EQ(PartName(MirrorPart(part)), "right_" + name.substr(5));
    }
  }
}

TEST(Anatomy, SegmentsBelongToTheirParts) {
  EXPECT_EQ(PartOf(Segment::kNeck), Part::kTorso);
  EXPECT_EQ(PartOf(Segment::kRightForearm), Part::kRightArm);
  EXPECT_EQ(PartOf(Segment::kLeftFoot), Part::kLeftFoot);
  EXPECT_EQ(SegmentName(Segment::kLeftCalf), "left_calf");
  EXPECT_EQ(SegmentName(Segment::kNeck), "neck");
}

TEST(Anatomy, ASelectionIncludesWhatItSwitchesOn) {
  PartSelection selection;
  EXPECT_TRUE(selection.Includes(Part::kRightLeg));
  EXPECT_FALSE(selection.Includes(Part::kRightHand));
  selection.hands = true;
  selection.arms = false;
  EXPECT_TRUE(selection.Includes(Part::kRightHand));
  EXPECT_FALSE(selection.Includes(Part::kLeftArm));
}

TEST(MedialCurve, WalksAnLAndFindsTheWayBack) {
  const MedialCurve curve = CurveThrough({{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, {2, 1, 0}});
  EXPECT_EQ(curve.points_m.size(), 3u);  // the double point is gone
  EXPECT_DOUBLE_EQ(curve.length_m(), 3.0);
  EXPECT_LT((curve.PointAt(0.5) - Eigen::Vector3d(0, 0.5, 0)).norm(), 1e-12);
  EXPECT_LT((curve.PointAt(2.5) - Eigen::Vector3d(1.5, 1, 0)).norm(), 1e-12);
  EXPECT_LT((curve.PointAt(99) - Eigen::Vector3d(2, 1, 0)).norm(), 1e-12);
  EXPECT_LT((curve.TangentAt(0.2) - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((curve.TangentAt(2.8) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_NEAR(curve.Project({1.5, 4, 0}), 2.5, 1e-12);
  EXPECT_NEAR(curve.Project({-1, 0.25, 0}), 0.25, 1e-12);
}

}  // namespace
}  // namespace capfit::body
