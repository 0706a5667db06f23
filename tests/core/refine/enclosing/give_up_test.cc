#include "core/refine/enclosing/give_up.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/refine/enclosing/tube.h"

namespace capfit::refine {
namespace {

TEST(GiveUpTest, NoMoreThanSoManyAreLeft) {
  const int all = Chain(9).primitive_count();
  for (const int primitives : {3, 8, all - 1, all, all + 5}) {
    capsule::MirroredSet graph = Chain(9);
    EXPECT_TRUE(GiveUpTo(TubeTask(), primitives, graph));
    EXPECT_LE(graph.primitive_count(), primitives);
    EXPECT_GE(graph.primitive_count(), std::min(primitives - 2, all));  // a sphere with its capsule
  }
}

// Of a straight chain inner spheres are missed by nobody, ends by all beside them.
TEST(GiveUpTest, WhatIsLeastMissedGoes) {
  capsule::MirroredSet graph = Chain(9);
  EXPECT_TRUE(GiveUpTo(TubeTask(), 3, graph));
  ASSERT_EQ(graph.sphere_count(), 2);
  EXPECT_DOUBLE_EQ(graph.sphere(0).center_m.y(), 0.0);
  EXPECT_DOUBLE_EQ(graph.sphere(1).center_m.y(), kLength);
  EXPECT_EQ(graph.capsule_count(), 1);
}

TEST(GiveUpTest, EveryLimitIsKept) {
  constexpr int kNo = capsule::kNoLimit;
  for (const capsule::Budget& budget :
       {capsule::Budget{7, kNo, kNo}, capsule::Budget{kNo, 4, kNo}, capsule::Budget{kNo, kNo, 2}}) {
    for (const int left : {0, 3}) {
      capsule::MirroredSet graph = Chain(9);
      EXPECT_TRUE(GiveUpExcess(TubeTask(), budget, left, graph));
      EXPECT_LE(budget.Excess(graph.count()), left);
    }
  }
}

}  // namespace
}  // namespace capfit::refine
