#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/capsule/build_primitives.h"

namespace capfit::capsule {
namespace {

using geometry::Sphere;
using testing::Contains;
using testing::Not;

PrimitiveSet SetOf(std::vector<Sphere> spheres, std::vector<CapsuleEnds> capsules) {
  PrimitiveSet set;
  set.spheres = std::move(spheres);
  set.origins.resize(set.spheres.size());
  set.capsules = std::move(capsules);
  return set;
}

double Distance(const PrimitiveSet& set, const Eigen::Vector3d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::TaperedCapsule& solid : Solids(set)) {
    least = std::min(least, solid.SignedDistance(point));
  }
  return least;
}

TEST(RemoveCoveredCapsulesTest, OneThatAnotherContainsGoesWithItsSpheres) {
  PrimitiveSet set =
      SetOf({{{0, 0, 0}, 0.3}, {{0, 1, 0}, 0.3}, {{0, 0.2, 0}, 0.1}, {{0, 0.8, 0}, 0.1}},
            {{0, 1}, {2, 3}});
  RemoveCoveredCapsules(set);
  EXPECT_EQ(set.capsules, (std::vector<CapsuleEnds>{{0, 1}}));
  EXPECT_EQ(set.spheres.size(), 2u);
}

TEST(RemoveCoveredCapsulesTest, OneThatSticksOutStays) {
  PrimitiveSet set =
      SetOf({{{0, 0, 0}, 0.3}, {{0, 1, 0}, 0.3}, {{0, 0.2, 0}, 0.1}, {{0.3, 0.8, 0}, 0.1}},
            {{0, 1}, {2, 3}});
  const PrimitiveSet before = set;
  RemoveCoveredCapsules(set);
  EXPECT_EQ(set.capsules, before.capsules);
  EXPECT_EQ(set.spheres.size(), 4u);
}

TEST(RemoveCoveredCapsulesTest, OneThatAnEndSwallowsGoes) {
  PrimitiveSet set =
      SetOf({{{0, 0, 0}, 0.5}, {{0, 0.2, 0}, 0.1}, {{0, 1, 0}, 0.2}}, {{0, 1}, {0, 2}});
  RemoveCoveredCapsules(set);
  EXPECT_EQ(set.capsules, (std::vector<CapsuleEnds>{{0, 1}}));  // the kept one, renumbered
  EXPECT_EQ(set.spheres.size(), 2u);
  EXPECT_EQ(set.spheres[1].center_m.y(), 1.0);
}

// A thin bar along x inside a thick cross-piece of two that meet in its middle: neither covers it
// alone, both do together.
PrimitiveSet BarUnderTwo(double reach) {
  return SetOf({{{-1, 0, 0}, 0.1},
                {{1, 0, 0}, 0.1},
                {{-1.2, 0, 0}, 0.3},
                {{reach, 0, 0}, 0.3},
                {{-reach, 0, 0}, 0.3},
                {{1.2, 0, 0}, 0.3}},
               {{0, 1}, {2, 3}, {4, 5}});
}

TEST(RemoveCoveredCapsulesTest, OneThatTwoTogetherCoverGoes) {
  PrimitiveSet set = BarUnderTwo(0.2);
  RemoveCoveredCapsules(set);
  EXPECT_EQ(set.capsules.size(), 2u);
  EXPECT_EQ(set.spheres.size(), 4u);
}

TEST(RemoveCoveredCapsulesTest, NotWhenTheyLeaveAGap) {
  // The two round ends, at -0.29 and 0.29 with radius 0.3, meet within 8 cm of the axis only.
  PrimitiveSet set = BarUnderTwo(-0.29);
  RemoveCoveredCapsules(set);
  EXPECT_EQ(set.capsules.size(), 3u);
  // At 0.28 they meet at 10.8 cm: just enough for a radius of 10 cm.
  set = BarUnderTwo(-0.28);
  RemoveCoveredCapsules(set);
  EXPECT_EQ(set.capsules.size(), 2u);
}

TEST(RemoveCoveredCapsulesTest, TheToleranceCountsAsCovered) {
  PrimitiveSet strict = BarUnderTwo(-0.283);  // they meet at 9.96 cm
  PrimitiveSet lenient = strict;
  RemoveCoveredCapsules(strict, 1e-4);
  EXPECT_EQ(strict.capsules.size(), 3u);
  RemoveCoveredCapsules(lenient, 1e-3);
  EXPECT_EQ(lenient.capsules.size(), 2u);
}

TEST(RemoveCoveredCapsulesTest, MirroredOnesGoTogetherOrStayTogether) {
  PrimitiveSet set = SetOf({{{0.4, 0, 0}, 0.2},
                            {{-0.4, 0, 0}, 0.2},
                            {{0.4, 1, 0}, 0.2},
                            {{-0.4, 1, 0}, 0.2},
                            {{0.4, 0.3, 0}, 0.05},
                            {{-0.4, 0.3, 0}, 0.05},
                            {{0.4, 0.7, 0}, 0.05},
                            {{-0.4, 0.7, 0}, 0.05}},
                           {{0, 2}, {1, 3}, {4, 6}, {5, 7}});
  for (std::size_t i = 0; i < 8; ++i) set.origins[i].mirror = static_cast<int>(i ^ 1u);
  RemoveCoveredCapsules(set);
  EXPECT_EQ(set.capsules, (std::vector<CapsuleEnds>{{0, 2}, {1, 3}}));
  ASSERT_EQ(set.spheres.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(set.origins[i].mirror, static_cast<int>(i ^ 1u));
}

TEST(RemoveCoveredCapsulesTest, TwoThatCoverEachOtherDoNotBothGo) {
  PrimitiveSet set = SetOf({{{0, 0, 0}, 0.2}, {{0, 1, 0}, 0.2}, {{0, 0, 0}, 0.2}, {{0, 1, 0}, 0.2}},
                           {{0, 1}, {2, 3}});
  RemoveCoveredCapsules(set);
  EXPECT_EQ(set.capsules.size(), 1u);
}

TEST(RemoveCoveredCapsulesTest, ACapsuleWhoseInsideNobodyElseFillsStays) {
  // A thick one whose slant is hidden by a ring of thin ones that leave its core empty. Its ends
  // are apart, so that the end spheres do not fill it either.
  std::vector<Sphere> spheres = {{{0, -0.45, 0}, 0.5}, {{0, 0.45, 0}, 0.5}};
  std::vector<CapsuleEnds> capsules = {{0, 1}};
  for (int i = 0; i < 24; ++i) {
    const double angle = 2 * EIGEN_PI * i / 24;
    const Eigen::Vector3d side(0.45 * std::cos(angle), 0, 0.45 * std::sin(angle));
    const int first = static_cast<int>(spheres.size());
    spheres.push_back({side - Eigen::Vector3d(0, 0.9, 0), 0.12});
    spheres.push_back({side + Eigen::Vector3d(0, 0.9, 0), 0.12});
    capsules.push_back({first, first + 1});
  }
  PrimitiveSet set = SetOf(spheres, capsules);
  RemoveCoveredCapsules(set);
  EXPECT_THAT(set.capsules, Contains(CapsuleEnds{0, 1}));
  // With a core that is larger than it (the smaller of two is asked first), it is not needed.
  const int first = static_cast<int>(spheres.size());
  spheres.push_back({{0, -3.0, 0}, 0.4});
  spheres.push_back({{0, 3.0, 0}, 0.4});
  capsules.push_back({first, first + 1});
  set = SetOf(spheres, capsules);
  RemoveCoveredCapsules(set);
  EXPECT_THAT(set.capsules, Not(Contains(CapsuleEnds{0, 1})));
}

TEST(RemoveCoveredCapsulesProperty, WhatIsGoneWasCoveredToTheTolerance) {
  Random random(71);
  int removed = 0;
  for (int round = 0; round < 40; ++round) {
    PrimitiveSet set;
    for (int i = 0; i < 12; ++i) {
      set.spheres.push_back({{random.NextIn(-0.2, 0.2), 0.25 * (i / 4), random.NextIn(-0.1, 0.1)},
                             random.NextIn(0.08, 0.16)});
      set.origins.emplace_back();
    }
    for (int layer = 0; layer < 2; ++layer) {
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) set.capsules.push_back({4 * layer + i, 4 * layer + 4 + j});
      }
    }
    const PrimitiveSet before = set;
    RemoveCoveredCapsules(set, 2e-4);
    removed += static_cast<int>(before.capsules.size() - set.capsules.size());
    for (int i = 0; i < 4000; ++i) {
      const Eigen::Vector3d p(random.NextIn(-0.4, 0.4), random.NextIn(-0.2, 0.7),
                              random.NextIn(-0.3, 0.3));
      if (Distance(before, p) <= 0.0) {
        EXPECT_LE(Distance(set, p), 2e-4);
      }
    }
  }
  EXPECT_GT(removed, 40);
}

}  // namespace
}  // namespace capfit::capsule
