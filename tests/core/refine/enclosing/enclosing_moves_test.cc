#include "core/refine/enclosing/enclosing_moves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/refine/enclosing/tube.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

// Two large triangles whose corners are in small balls.
TEST(EnclosingMovesTest, WhatSticksOutBetweenFarVerticesCounts) {
  tighten::CoverTarget square;
  square.points_m.own() = {{0, 0, 0}, {0.4, 0, 0}, {0.4, 0.4, 0}, {0, 0.4, 0}};
  square.triangles.own() = {{0, 1, 2}, {0, 2, 3}};
  const EnclosingTask task(square, /*symmetric=*/false, 0.0, /*spacing=*/0.1);
  const ThreadPool pool(1);
  capsule::MirroredSet corners;
  for (const Eigen::Vector3d& point : square.points_m) corners.AddSphere({point, 0.06}, false);
  const std::vector<Eigen::Vector3d> worst = task.WorstPoints(corners, 100, pool);
  ASSERT_GE(worst.size(), 10u);
  EXPECT_LT((worst[0] - Eigen::Vector3d(0.2, 0.2, 0)).norm(), 0.05);
  capsule::MirroredSet ball;
  ball.AddSphere({{0.2, 0.2, 0}, 0.285}, false);
  EXPECT_TRUE(task.WorstPoints(ball, 100, pool).empty());
}

TEST(EnclosingMovesTest, WhatTakesInWhatSticksOutWins) {
  const ThreadPool pool(1);
  const capsule::MirroredSet beads = Beads(3);
  const std::vector<Edit> ties = {EditOf(EditKind::kLink, 0, 1), EditOf(EditKind::kLink, 0, 2)};
  const std::vector<double> gains = TubeTask().GainsOf(beads, ties, pool);
  EXPECT_GT(gains[0], 0.0);
  EXPECT_GT(gains[1], 1.5 * gains[0]);  // twice as long
  EXPECT_EQ(gains, TubeTask().GainsOf(beads, ties, ThreadPool(3)));
  capsule::MirroredSet full = beads;
  full.AddCapsule(0, 2);
  EXPECT_LE(TubeTask().GainsOf(full, ties, pool)[0], 0.0);  // all is inside
  EXPECT_TRUE(TubeTask().WorstPoints(full, 5, pool).empty());
}

TEST(EnclosingMovesTest, WorstPointsAreFurthestFromAllSpheres) {
  const std::vector<Eigen::Vector3d> worst = TubeTask().WorstPoints(Beads(2), 3, ThreadPool(1));
  ASSERT_EQ(worst.size(), 3u);
  EXPECT_NEAR(worst[0].y(), 0.5 * kLength, 0.03);
  EXPECT_GT((worst[0] - worst[1]).norm(), 0.01);
}

TEST(EnclosingMovesTest, AdditionsAreRankedByWhatTheyWinForAPrimitive) {
  const ThreadPool pool(1);
  // Far from each other: only leaves are left.
  const std::vector<Edit> far = RankedAdditions(TubeTask(), Beads(2), pool);
  ASSERT_FALSE(far.empty());
  for (const Edit& edit : far) EXPECT_EQ(edit.kind, EditKind::kLeaf);
  // Near: a tie costs half of a leaf and wins more.
  const std::vector<Edit> near = RankedAdditions(TubeTask(), Beads(5), pool);
  ASSERT_FALSE(near.empty());
  EXPECT_EQ(near[0].kind, EditKind::kLink);
}

TEST(EnclosingMovesTest, CountsWhatAnAdditionBringsWithItsImage) {
  for (const bool symmetric : {false, true}) {
    const capsule::MirroredSet graph = LeggedGraph(symmetric);
    // Chest and belly are on the mid-plane, hip 2 and foot are not.
    Edit leaf = EditOf(EditKind::kLeaf, 2);
    leaf.center_m = {0.3, 0.8, 0.0};
    leaf.radius_m = 0.02;
    for (const Edit& edit : {EditOf(EditKind::kLink, 0, 2), leaf}) {
      const EditedGraph edited = Apply(graph, edit);
      ASSERT_TRUE(edited.possible);
      const capsule::PrimitiveCount count = CountWith(graph, edit);
      EXPECT_EQ(count.spheres, edited.graph.sphere_count());
      EXPECT_EQ(count.capsules, edited.graph.capsule_count());
    }
  }
}

TEST(EnclosingMovesTest, WhatOthersCoverIsLeastMissed) {
  capsule::MirroredSet graph = Beads(3);
  graph.AddCapsule(0, 1);
  graph.AddCapsule(1, 2);
  graph.AddSphere({{0.0, 0.25, 0.0}, 0.5 * kRadius}, false);
  graph.AddCapsule(0, 3);  // inside the first capsule
  const std::vector<Removal> removals = RemovalsOf(graph, TubeTask().Weigh(graph));
  ASSERT_FALSE(removals.empty());
  EXPECT_EQ(removals[0].loss_per_primitive, 0.0);
  EXPECT_TRUE(removals[0].edit.kind == EditKind::kDissolve ? removals[0].edit.first == 3
                                                           : removals[0].edit.first == 2);
  EXPECT_GT(removals.back().loss_per_primitive, 1e-4);
}

TEST(EnclosingMovesTest, NothingGoesBesideWhatHasJustGone) {
  capsule::MirroredSet graph = Beads(6);
  for (int v = 0; v + 1 < 6; ++v) graph.AddCapsule(v, v + 1);
  SparedGraph rest(graph);
  rest.Remove(EditOf(EditKind::kDissolve, 1));
  EXPECT_EQ(rest.graph().sphere_count(), 5);
  rest.Remove(EditOf(EditKind::kDissolve, 2));
  rest.Remove(EditOf(EditKind::kUnlink, graph.IndexOfCapsule(2, 3)));
  EXPECT_EQ(rest.graph().sphere_count(), 5);
  EXPECT_EQ(rest.graph().capsule_count(), 4);
  // Named by what they were in the graph before.
  rest.Remove(EditOf(EditKind::kUnlink, graph.IndexOfCapsule(4, 5)));
  EXPECT_EQ(rest.graph().capsules(), (std::vector<capsule::CapsuleEnds>{{1, 2}, {2, 3}, {0, 1}}));
  EXPECT_EQ(rest.graph().sphere(3).center_m, graph.sphere(4).center_m);
}

TEST(EnclosingMovesTest, WhatGoesTakesItsImageAlong) {
  const capsule::MirroredSet graph = LeggedGraph(true);
  for (const Removal& removal : RemovalsOf(graph, TubeTask().Weigh(graph))) {
    SparedGraph rest(graph);
    for (const Removal& other : {removal, RemovalsOf(graph, TubeTask().Weigh(graph)).back()}) {
      rest.Remove(other.edit);
      EXPECT_TRUE(capsule::IsExactlyMirrored(rest.graph()));
    }
  }
}

TEST(EnclosingMovesTest, CuttingChangesNoShapeAndKeepsToTheBudget) {
  capsule::MirroredSet graph = LeggedGraph(true);
  const capsule::MirroredSet before = graph;
  const std::vector<double> gaps = {1.0, 2.0, 4.0, 5.0, 4.0, 5.0};
  CutLoosest({17, 9, 1000}, 1000, {gaps.begin(), gaps.begin() + graph.capsule_count()}, graph);
  EXPECT_GT(graph.primitive_count(), before.primitive_count());
  EXPECT_LE(graph.primitive_count(), 17);
  EXPECT_LE(graph.sphere_count(), 9);
  EXPECT_TRUE(capsule::IsExactlyMirrored(graph));
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p = RandomPoint(random);
    const float d = UnionDistance(before, p);
    if (d > 0.0f) {
      EXPECT_NEAR(UnionDistance(graph, p), d, 2e-6);
    }
  }
}

}  // namespace
}  // namespace capfit::refine
