#include "core/refine/best_fit/growth.h"

#include <gtest/gtest.h>

#include "core/base/fit_observer.h"
#include "tests/core/refine/ball_body.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

const Eigen::Vector3d kBallCenter(0.0, 0.3, 0.05);

const body::Body& Ball() {
  static const body::Body body = BallBody(kBallCenter, 0.2);
  return body;
}

const BestFitObjective& Objective() {
  static const BestFitObjective objective = [] {
    const std::span<const Eigen::Vector3d> vertices = Ball().mesh.vertices();
    return BestFitObjective(
        MakeOccupancyGrid(Ball(), AllParts(), 0.01, /*folded=*/true, ThreadPool(1)),
        {tighten::PointGrid(vertices, tighten::PointGrid::Fold::kToPositiveX)},
        /*seed=*/1);
  }();
  return objective;
}

// Two spheres on the plane, far too small for the ball.
capsule::MirroredSet Small() {
  capsule::MirroredSet graph(true);
  const int low = graph.AddSphere({kBallCenter - Eigen::Vector3d(0, 0.1, 0), 0.05}, true);
  const int high = graph.AddSphere({kBallCenter + Eigen::Vector3d(0, 0.1, 0), 0.05}, true);
  graph.AddCapsule(low, high);
  return graph;
}

capsule::MirroredSet Grown(int primitives, int threads) {
  const ThreadPool pool(threads);
  NullObserver observer;
  WorkMeter meter(observer);
  capsule::MirroredSet graph = Small();
  GrowthOptions options;
  options.exchanges = 1;
  Grow(Objective(), {primitives, capsule::kNoLimit, capsule::kNoLimit}, options, pool, meter,
       graph);
  return graph;
}

// A round against the objective itself: what a trial says an edit gains is what it does gain, where
// nothing is left out so far that it counts beside E_r.
TEST(BestFitRoundTest, TheGainIsTheFallOfTheObjective) {
  capsule::MirroredSet graph = Small();
  graph.sphere(0).radius_m = graph.sphere(1).radius_m = 0.14;
  const BestFitRound round = Objective().StartRound(graph, ThreadPool(1));
  const Edit ball{EditKind::kBall, -1, -1, kBallCenter + Eigen::Vector3d(0.1, 0, 0), 0.06};
  for (const Edit& edit : {ball, EditOf(EditKind::kSplit, 0), EditOf(EditKind::kUnlink, 0)}) {
    for (const Trial trial : {Trial::kGlance, Trial::kThorough}) {
      EditedGraph edited = Apply(graph, edit);
      ASSERT_TRUE(edited.possible);
      const double gain = round.Try(trial, edited);
      EXPECT_TRUE(capsule::IsExactlyMirrored(edited.graph));
      EXPECT_NEAR(
          gain,
          Objective().Value(graph, ThreadPool(1)) - Objective().Value(edited.graph, ThreadPool(1)),
          0.02);
    }
  }
}

TEST(BestFitObjectiveTest, SettlingLowersTheValueAndWorstPointsAreOutsideAndApart) {
  capsule::MirroredSet graph = Small();
  const std::vector<Eigen::Vector3d> worst = Objective().WorstPoints(graph, 8, ThreadPool(1));
  ASSERT_EQ(worst.size(), 8U);
  for (std::size_t i = 0; i < worst.size(); ++i) {
    EXPECT_GE(worst[i].x(), 0.0);
    EXPECT_GT(UnionDistance(graph, worst[i]), 0.0f);
    const std::size_t before_i = i > 0 ? i - 1 : 0;
    EXPECT_LE(UnionDistance(graph, worst[i]), UnionDistance(graph, worst[before_i]) + 1e-5f);
    for (std::size_t k = 0; k < i; ++k) EXPECT_GE((worst[i] - worst[k]).norm(), 0.04);
  }
  const double before = Objective().Value(graph, ThreadPool(1));
  Objective().Settle(Effort::kRough, ThreadPool(1), NullObserver(), graph);
  EXPECT_LT(Objective().Value(graph, ThreadPool(1)), 0.2 * before);
}

TEST(GrowthTest, KeepsToTheBudgetStaysMirroredAndDoesNotLose) {
  capsule::MirroredSet settled = Small();
  Objective().Settle(Effort::kTighten, ThreadPool(1), NullObserver(), settled);
  for (const int primitives : {5, 9}) {
    const capsule::MirroredSet graph = Grown(primitives, 1);
    EXPECT_LE(graph.primitive_count(), primitives);
    EXPECT_TRUE(capsule::IsExactlyMirrored(graph));
    EXPECT_LT(Objective().Value(graph, ThreadPool(1)), Objective().Value(Small(), ThreadPool(1)));
    EXPECT_LT(Objective().Value(graph, ThreadPool(1)),
              Objective().Value(settled, ThreadPool(1)) + 0.01);
  }
}

TEST(GrowthTest, SameBitsForAnyNumberOfThreads) {
  const capsule::MirroredSet one = Grown(8, 1);
  const capsule::MirroredSet three = Grown(8, 3);
  ASSERT_EQ(one.capsules(), three.capsules());
  for (int v = 0; v < one.sphere_count(); ++v) {
    EXPECT_EQ(one.sphere(v).center_m, three.sphere(v).center_m);
    EXPECT_EQ(one.sphere(v).radius_m, three.sphere(v).radius_m);
  }
}

TEST(GrowthTest, SparingEndsWithinTheBudget) {
  const ThreadPool pool(2);
  NullObserver observer;
  WorkMeter meter(observer);
  for (const int primitives : {11, 8, 4}) {
    capsule::MirroredSet graph(true);
    for (int i = 0; i < 4; ++i) {
      graph.AddSphere({kBallCenter + Eigen::Vector3d(0.05 * i, 0.03 * i - 0.05, 0.02), 0.1},
                      i == 0);
      if (i > 0) graph.AddCapsule(2 * i - 1, std::max(0, 2 * i - 3));
    }
    Spare(Objective(), {primitives, capsule::kNoLimit, capsule::kNoLimit}, {}, pool, meter, graph);
    EXPECT_LE(graph.primitive_count(), primitives);
    EXPECT_GT(graph.primitive_count(), 0);
    EXPECT_TRUE(capsule::IsExactlyMirrored(graph));
  }
}

}  // namespace
}  // namespace capfit::refine
