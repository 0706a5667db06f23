#include "core/refine/best_fit/best_fit_settle.h"

#include <gtest/gtest.h>

#include "core/refine/best_fit/fill_error.h"
#include "tests/core/capsule/mirrored.h"
#include "tests/core/refine/ball_body.h"

namespace capfit::refine {
namespace {

const Eigen::Vector3d kSettleCenter(0.0, 0.3, 0.05);

// A pair in the ball, and a small sphere within one of them.
capsule::PrimitiveSet Set(bool with_swallowed) {
  capsule::MirroredSet set(true);
  set.AddSphere({kSettleCenter + Eigen::Vector3d(0.03, 0.0, 0.0), 0.12}, false,
                body::Part::kLeftLeg);
  if (with_swallowed) set.AddSphere({kSettleCenter, 0.01}, true, body::Part::kHead);
  return set.set();
}

TEST(SettleBestFitTest, KeepsOriginsAndSymmetryAndLowersTheError) {
  const OccupancyGrid grid = BestFitGrid(BallBody(kSettleCenter, 0.2), AllParts());
  const capsule::PrimitiveSet before = Set(false);
  const capsule::PrimitiveSet after = SettleBestFit(grid, 0.008, 1, NullObserver(), before);
  ASSERT_EQ(after.spheres.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after.origins[i].part, before.origins[i].part);
    EXPECT_EQ(after.origins[i].mirror, before.origins[i].mirror);
  }
  const capsule::MirroredSet mirrored(after, true);
  EXPECT_TRUE(capsule::IsExactlyMirrored(mirrored));
  EXPECT_LT(GridError(grid, mirrored, ThreadPool(1)),
            0.5 * GridError(grid, {before, true}, ThreadPool(1)));
}

TEST(SettleBestFitTest, WhatOthersSwallowGoes) {
  const OccupancyGrid grid = BestFitGrid(BallBody(kSettleCenter, 0.2), AllParts());
  const capsule::PrimitiveSet after = SettleBestFit(grid, 0.003, 1, NullObserver(), Set(true));
  EXPECT_EQ(after.spheres.size(), 2U);
  EXPECT_EQ(after.origins.size(), 2U);
}

TEST(SettleBestFitTest, NothingComesOfNothing) {
  const OccupancyGrid grid = BestFitGrid(BallBody(kSettleCenter, 0.2), AllParts());
  EXPECT_TRUE(SettleBestFit(grid, 0.008, 1, NullObserver(), {}).spheres.empty());
}

}  // namespace
}  // namespace capfit::refine
