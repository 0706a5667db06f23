#include "core/refine/graph/graph_edit.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

TEST(GraphEditTest, SplittingChangesNoShape) {
  const capsule::MirroredSet before = LeggedGraph(true);
  for (int e = 0; e < before.capsule_count(); ++e) {
    const EditedGraph after = Apply(before, EditOf(EditKind::kSplit, e));
    ASSERT_TRUE(after.possible);
    Random random(5);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d p = RandomPoint(random);
      const float d = UnionDistance(before, p);
      if (d <= 0.0f) continue;
      EXPECT_NEAR(UnionDistance(after.graph, p), d, 2e-6);
    }
  }
}

TEST(GraphEditTest, AnySequenceOfEditsKeepsTheMirror) {
  Random random(11);
  capsule::MirroredSet graph = LeggedGraph(true);
  int applied = 0;
  for (int i = 0; i < 400; ++i) {
    const auto kind = static_cast<EditKind>(random.NextBelow(7));
    const bool of_edge = kind == EditKind::kSplit || kind == EditKind::kUnlink;
    const auto count = of_edge ? graph.capsules().size() : graph.spheres().size();
    if (count == 0) continue;
    Edit edit = EditOf(kind, static_cast<int>(random.NextBelow(count)),
                       static_cast<int>(random.NextBelow(graph.spheres().size())));
    edit.center_m = RandomPoint(random);
    edit.radius_m = random.NextIn(0.01, 0.1);
    const EditedGraph after = Apply(graph, edit);
    if (!after.possible || after.graph.primitive_count() > 60) continue;
    graph = after.graph;
    ++applied;
    ASSERT_TRUE(capsule::IsExactlyMirrored(graph)) << "after edit " << i;
    for (const int v : after.touched) ASSERT_LT(v, graph.sphere_count());
  }
  EXPECT_GT(applied, 50);
}

TEST(GraphEditTest, PartingTiesEachSideToItsOwn) {
  const EditedGraph after = Apply(LeggedGraph(true), EditOf(EditKind::kPart, 1, 0));
  ASSERT_TRUE(after.possible);
  EXPECT_EQ(after.graph.sphere_count(), 7);
  EXPECT_EQ(after.graph.capsule_count(), 6);  // chest twice, hips once each, two legs
  EXPECT_TRUE(capsule::IsExactlyMirrored(after.graph));
}

TEST(GraphEditTest, DissolvingTiesTheNeighbours) {
  const EditedGraph after = Apply(LeggedGraph(true), EditOf(EditKind::kDissolve, 2));
  ASSERT_TRUE(after.possible);
  EXPECT_EQ(after.graph.sphere_count(), 4);
  EXPECT_EQ(after.graph.capsule_count(), 3);
  EXPECT_FALSE(Apply(LeggedGraph(true), EditOf(EditKind::kDissolve, 1)).possible)
      << "the belly joins three capsules";
}

TEST(GraphEditTest, LeavesTouchTheSurfaceFromInside) {
  const capsule::MirroredSet graph = LeggedGraph(true);
  const Eigen::Vector3d p(0.18, 0.5, 0.05);
  const std::vector<Edit> leaves = LeavesAt(graph, p);
  ASSERT_EQ(leaves.size(), 2u);
  for (const Edit& leaf : leaves) {
    EXPECT_NEAR((leaf.center_m - p).norm(), leaf.radius_m, 1e-9);
  }
}

TEST(GraphEditTest, RemoveSwallowedDropsWhatDoesNothing) {
  capsule::MirroredSet graph = LeggedGraph(true);
  graph.AddSphere({{0.0, 1.2, 0.01}, 0.05}, true);  // inside the chest, alone
  const int inside = graph.AddSphere({{0.0, 1.22, 0.01}, 0.04}, true);
  graph.AddCapsule(0, inside);
  RemoveSwallowed(graph);
  EXPECT_EQ(graph.sphere_count(), 6);
  EXPECT_EQ(graph.capsule_count(), 5);
  EXPECT_TRUE(capsule::IsExactlyMirrored(graph));
}

TEST(GraphEditTest, PairsThatMeetOnThePlaneBecomeOneSphere) {
  capsule::MirroredSet graph = LeggedGraph(true);
  const int nodes = graph.sphere_count();
  JoinNearPairs(graph);
  EXPECT_EQ(graph.sphere_count(), nodes) << "none is near";
  const int pair = graph.AddSphere({{0.004, 1.5, 0.0}, 0.1}, false);
  graph.AddCapsule(0, pair);
  JoinNearPairs(graph);
  EXPECT_EQ(graph.sphere_count(), nodes + 1);
  EXPECT_TRUE(graph.IsOnPlane(pair));
  EXPECT_NEAR(graph.sphere(pair).radius_m, 0.104, 1e-12) << "holds both";
  EXPECT_TRUE(graph.HasCapsule(0, pair));
  EXPECT_TRUE(capsule::IsExactlyMirrored(graph));

  capsule::MirroredSet lopsided = LeggedGraph(false);
  const int before = lopsided.sphere_count();
  JoinNearPairs(lopsided);
  EXPECT_EQ(lopsided.sphere_count(), before);
}

TEST(GraphEditTest, PiecesAreCountedByCapsules) {
  capsule::MirroredSet graph = LeggedGraph(true);
  EXPECT_EQ(ComponentCount(graph), 1);
  graph.AddSphere({{0.0, 1.2, 0.02}, 0.1}, true);  // inside another, but tied to nothing
  EXPECT_EQ(ComponentCount(graph), 2);
  graph.AddSphere({{0.3, 1.2, 0.0}, 0.1}, false);
  EXPECT_EQ(ComponentCount(graph), 4);
}

TEST(GraphEditTest, NothingFallsOffWhereAnEndIsSwallowed) {
  for (const bool symmetric : {true, false}) {
    capsule::MirroredSet graph = LeggedGraph(symmetric);
    graph.sphere(2).radius_m = 0.01;  // the hip
    graph.sphere(2).center_m = {0.03, 0.98, 0.02};
    graph.CopyToImages();
    capsule::MirroredSet cut = graph;
    RemoveSwallowed(cut);
    EXPECT_GT(ComponentCount(cut), 1);
    const int nodes = graph.sphere_count();
    MergeSwallowed(graph);
    RemoveSwallowed(graph);
    EXPECT_EQ(ComponentCount(graph), 1);
    EXPECT_EQ(graph.sphere_count(), symmetric ? nodes - 2 : nodes - 1);
    EXPECT_TRUE(!symmetric || capsule::IsExactlyMirrored(graph));
  }
}

TEST(GraphEditTest, RemovedSpheresAreTold) {
  capsule::MirroredSet graph = LeggedGraph(true);
  graph.AddSphere({{0.1, 0.84, 0.0}, 0.02}, false);  // inside the hips
  const std::vector<int> index = RemoveSwallowed(graph);
  EXPECT_EQ(index, (std::vector<int>{0, 1, 2, 3, 4, 5, -1, -1}));
  EXPECT_EQ(graph.sphere_count(), 6);
}

TEST(GraphEditTest, ALocalGraphIsTheSameWithinItsBox) {
  for (const bool symmetric : {true, false}) {
    const capsule::MirroredSet graph = LeggedGraph(symmetric);
    const Eigen::AlignedBox3d box(Eigen::Vector3d(0.05, 0.1, -0.1), Eigen::Vector3d(0.2, 0.5, 0.1));
    const LocalGraph local = LocalGraphIn(graph, box);
    EXPECT_LT(local.graph.sphere_count(), graph.sphere_count());
    EXPECT_EQ(local.graph.is_mirrored(), symmetric);
    EXPECT_TRUE(!symmetric || capsule::IsExactlyMirrored(local.graph));
    for (std::size_t v = 0; v < local.nodes.size(); ++v) {
      EXPECT_EQ(local.graph.spheres()[v].center_m, graph.sphere(local.nodes[v]).center_m);
    }
    Random random(7);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d p(random.NextIn(0.05, 0.2), random.NextIn(0.1, 0.5),
                              random.NextIn(-0.1, 0.1));
      const float d = UnionDistance(graph, p);
      const float local_d = UnionDistance(local.graph, p);
      EXPECT_TRUE(d <= 0.0f ? local_d == d : local_d > 0.0f) << d << " " << local_d;
    }
  }
}

}  // namespace
}  // namespace capfit::refine
