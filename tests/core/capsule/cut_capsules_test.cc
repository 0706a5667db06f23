#include "core/capsule/cut_capsules.h"

#include <gtest/gtest.h>

#include "tests/core/capsule/mirrored.h"

namespace capfit::capsule {
namespace {

// A chain of spheres on the plane, whose capsules are 1, 2, 3 ... long.
MirroredSet Chain(int capsules, bool is_mirrored) {
  MirroredSet set(is_mirrored);
  double y = 0.0;
  for (int i = 0; i <= capsules; ++i) {
    set.AddSphere({{0.0, y += i, 0.0}, 0.1}, true);
    if (i > 0) set.AddCapsule(i - 1, i);
  }
  return set;
}

TEST(CutWorthiestTest, TakesWhatIsWorthMostUntilTheBudgetIsSpent) {
  MirroredSet set = Chain(3, true);
  CutWorthiest({9, kNoLimit, kNoLimit}, OutlineAreas(set), QuarterOfWhole, set);
  EXPECT_EQ(set.primitive_count(), 9) << "one cut fits: a sphere and a capsule";
  EXPECT_EQ(set.sphere(4).center_m.y(), 4.5) << "the longest, from 3 to 6";
}

TEST(CutWorthiestTest, HalvesAreWorthWhatTheCallerSays) {
  for (const double share : {0.25, 0.9}) {
    MirroredSet set = Chain(2, false);
    const WorthOfHalf half = [&](const MirroredSet&, int, double whole) { return share * whole; };
    CutWorthiest({kNoLimit, 5, kNoLimit}, OutlineAreas(set), half, set);
    ASSERT_EQ(set.sphere_count(), 5);
    // The second cut goes into the half of the long one, or into the short one.
    EXPECT_EQ(set.sphere(4).center_m.y() > 1.0, share > 0.5);
  }
}

TEST(CutWorthiestTest, AMirroredPairCostsTwiceAndIsSkippedWhereItDoesNotFit) {
  MirroredSet set(true);
  const int middle = set.AddSphere({{0, 0, 0}, 0.1}, true);
  const int top = set.AddSphere({{0, 1, 0}, 0.1}, true);
  const int hand = set.AddSphere({{2, 0, 0}, 0.1}, false);
  set.AddCapsule(middle, top);
  set.AddCapsule(middle, hand);
  MirroredSet one = set;
  CutWorthiest({kNoLimit, 5, kNoLimit}, OutlineAreas(one), QuarterOfWhole, one);
  EXPECT_TRUE(one.IsOnPlane(4)) << "room for one sphere: the capsule on the plane";
  MirroredSet two = set;
  CutWorthiest({kNoLimit, 6, kNoLimit}, OutlineAreas(two), QuarterOfWhole, two);
  EXPECT_EQ(two.ImageOf(4), 5) << "room for two: the longer pair";
  EXPECT_TRUE(IsExactlyMirrored(one) && IsExactlyMirrored(two));
}

TEST(CutWorthiestTest, WhatIsWorthNothingIsNotCut) {
  MirroredSet set = Chain(3, false);
  CutWorthiest({}, std::vector<double>(3, 0.0), QuarterOfWhole, set);
  EXPECT_EQ(set.sphere_count(), 4);
}

}  // namespace
}  // namespace capfit::capsule
