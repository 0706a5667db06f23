#include "core/refine/best_fit/respend.h"

#include <gtest/gtest.h>

#include "core/base/fit_observer.h"
#include "core/refine/refine.h"
#include "tests/core/refine/ball_body.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

constexpr double kPieceCost = 0.45;
const Eigen::Vector3d kRespendMiddle(0.0, 0.3, 0.05);

const body::Body& BallToRespend() {
  static const body::Body body = BallBody(kRespendMiddle, 0.2);
  return body;
}

const BestFitObjective& OfBall() {
  static const BestFitObjective objective(
      MakeOccupancyGrid(BallToRespend(), AllParts(), 0.01, /*folded=*/true, ThreadPool(1)),
      {tighten::PointGrid(BallToRespend().mesh.vertices(), tighten::PointGrid::Fold::kToPositiveX)},
      /*seed=*/1);
  return objective;
}

// A short capsule on the plane, and with `wasted` a pair of capsules within it.
capsule::MirroredSet Wasteful(bool wasted) {
  capsule::MirroredSet set(true);
  const int low = set.AddSphere({kRespendMiddle - Eigen::Vector3d(0, 0.06, 0), 0.12}, true);
  const int high = set.AddSphere({kRespendMiddle + Eigen::Vector3d(0, 0.06, 0), 0.12}, true);
  set.AddCapsule(low, high);
  if (wasted) {
    const int inner =
        set.AddSphere({kRespendMiddle + Eigen::Vector3d(0.02, -0.03, 0), 0.05}, false);
    const int end = set.AddSphere({kRespendMiddle + Eigen::Vector3d(0.02, 0.03, 0), 0.05}, false);
    set.AddCapsule(inner, end);
  }
  return set;
}

capsule::MirroredSet Respent(int primitives, int threads, capsule::MirroredSet set,
                             Effort effort = Effort::kRound) {
  NullObserver observer;
  WorkMeter meter(observer);
  RespendOptions options;
  options.piece_cost = kPieceCost;
  options.effort = effort;
  options.until = 0.5;
  Respend(OfBall(), {primitives, capsule::kNoLimit, capsule::kNoLimit}, options,
          ThreadPool(threads), meter, set);
  EXPECT_LE(meter.until(), 0.5);
  return set;
}

TEST(RespendTest, KeepsToTheBudgetStaysMirroredAndNeverLoses) {
  const double before = OfBall().Value(Wasteful(true), ThreadPool(1));
  for (const Effort effort : {Effort::kRound, Effort::kFinish}) {
    for (const int primitives : {9, 11, 20}) {
      const capsule::MirroredSet set = Respent(primitives, 1, Wasteful(true), effort);
      EXPECT_LE(set.primitive_count(), primitives);
      EXPECT_TRUE(capsule::IsExactlyMirrored(set));
      EXPECT_LT(OfBall().Value(set, ThreadPool(1)), before);
    }
  }
}

// What does nothing pays for cuts: with a budget that is spent already the set still gets better
// than its only useful capsule can be.
TEST(RespendTest, WhatFillsNothingIsSpentAnew) {
  capsule::MirroredSet alone = Wasteful(false);
  OfBall().Settle(Effort::kFinish, ThreadPool(1), NullObserver(), alone);
  const capsule::MirroredSet set = Respent(9, 1, Wasteful(true));
  EXPECT_LT(OfBall().Value(set, ThreadPool(1)), OfBall().Value(alone, ThreadPool(1)));
}

TEST(RespendTest, SameBitsForAnyNumberOfThreads) {
  const capsule::MirroredSet one = Respent(15, 1, Wasteful(true));
  const capsule::MirroredSet three = Respent(15, 3, Wasteful(true));
  ASSERT_EQ(one.capsules(), three.capsules());
  for (int v = 0; v < one.sphere_count(); ++v) {
    EXPECT_EQ(one.sphere(v).center_m, three.sphere(v).center_m);
    EXPECT_EQ(one.sphere(v).radius_m, three.sphere(v).radius_m);
  }
}

RefineOptions BestOf(int primitives) {
  RefineOptions options;
  options.enclose = false;
  options.parts = AllParts();
  options.budget.max_primitives = primitives;
  options.seed = 1;
  return options;
}

TEST(SettleSetTest, KeepsOriginsAndSymmetryAndLowersTheError) {
  capsule::MirroredSet start(true);
  start.AddSphere({kRespendMiddle + Eigen::Vector3d(0.03, 0.0, 0.0), 0.12}, false,
                  body::Part::kLeftLeg);
  const capsule::PrimitiveSet before = start.set();
  NullObserver observer;
  const capsule::PrimitiveSet after =
      SettleSet(BallToRespend(), BestOf(2), ThreadPool(1), observer, before);
  ASSERT_EQ(after.spheres.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after.origins[i].part, before.origins[i].part);
    EXPECT_EQ(after.origins[i].mirror, before.origins[i].mirror);
  }
  const capsule::MirroredSet mirrored(after, true);
  EXPECT_TRUE(capsule::IsExactlyMirrored(mirrored));
  EXPECT_LT(OfBall().Value(mirrored, ThreadPool(1)), 0.5 * OfBall().Value(start, ThreadPool(1)));
}

TEST(SettleSetTest, NothingComesOfNothing) {
  NullObserver observer;
  EXPECT_TRUE(SettleSet(BallToRespend(), BestOf(9), ThreadPool(1), observer, {}).spheres.empty());
}

}  // namespace
}  // namespace capfit::refine
