#include "core/refine/graph/capsule_graph.h"

#include <gtest/gtest.h>

#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

TEST(CapsuleGraphTest, ASymmetricGraphMirrorsWhatIsAdded) {
  const CapsuleGraph graph = LeggedGraph(true);
  EXPECT_EQ(graph.sphere_count(), 6);
  EXPECT_EQ(graph.capsule_count(), 5);
  EXPECT_EQ(graph.primitive_count(), 11);
  EXPECT_TRUE(IsExactlyMirrored(graph));
}

TEST(CapsuleGraphTest, WithoutSymmetryNothingIsMirrored) {
  const CapsuleGraph graph = LeggedGraph(false);
  EXPECT_EQ(graph.sphere_count(), 4);
  EXPECT_EQ(graph.capsule_count(), 3);
  for (int v = 0; v < 4; ++v) EXPECT_TRUE(graph.IsNodeRepresentative(v));
}

TEST(CapsuleGraphTest, ATieAcrossThePlaneIsItsOwnImage) {
  CapsuleGraph graph = LeggedGraph(true);
  graph.AddEdge(2, 3);  // hip to hip
  EXPECT_EQ(graph.capsule_count(), 6);
  EXPECT_EQ(graph.edges.back().mirror, 5);
  graph.AddEdge(3, 2);
  EXPECT_EQ(graph.capsule_count(), 6) << "a tie that is there is not added again";
}

TEST(CapsuleGraphTest, RemovingAnEdgeRemovesItsImage) {
  CapsuleGraph graph = LeggedGraph(true);
  graph.RemoveEdge(1);
  EXPECT_EQ(graph.capsule_count(), 3);
  EXPECT_TRUE(IsExactlyMirrored(graph));
}

TEST(CapsuleGraphTest, RemovingANodeRemovesItsImageAndTheirEdges) {
  CapsuleGraph graph = LeggedGraph(true);
  std::vector<char> removed(6, 0);
  removed[4] = 1;  // the left foot
  const std::vector<int> index = graph.RemoveNodes(removed);
  EXPECT_EQ(graph.sphere_count(), 4);
  EXPECT_EQ(graph.capsule_count(), 3);
  EXPECT_EQ(index, (std::vector<int>{0, 1, 2, 3, -1, -1}));
  EXPECT_TRUE(IsExactlyMirrored(graph));
}

TEST(CapsuleGraphTest, CopyToImagesMakesItExact) {
  CapsuleGraph graph = LeggedGraph(true);
  graph.nodes[2].center_m += Eigen::Vector3d(0.01, 0.02, 0.03);
  graph.nodes[0].center_m.x() = 0.5;
  EXPECT_FALSE(IsExactlyMirrored(graph));
  graph.CopyToImages();
  EXPECT_TRUE(IsExactlyMirrored(graph));
}

}  // namespace
}  // namespace capfit::refine
