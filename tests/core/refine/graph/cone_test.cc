#include "core/refine/graph/cone.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/geometry/tapered_capsule.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

TEST(ConeTest, DistanceAndNormalAreThoseOfTheExactCapsule) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    CapsuleGraph graph;
    graph.AddNode(RandomPoint(random), random.NextIn(0.01, 0.15), false);
    graph.AddNode(RandomPoint(random), random.NextIn(0.01, 0.15), false);
    const geometry::TaperedCapsule exact({graph.nodes[0].center_m, graph.nodes[0].radius_m},
                                         {graph.nodes[1].center_m, graph.nodes[1].radius_m});
    const Cone cone = MakeCone(graph, 0, 1);
    const Eigen::Vector3d p = RandomPoint(random);
    const Eigen::Vector3f f = p.cast<float>();
    EXPECT_NEAR(SignedDistance(cone, f.x(), f.y(), f.z()), exact.SignedDistance(p), 2e-6);
    EXPECT_NEAR((Locate(cone, p).normal - exact.Locate(p).normal).norm(), 0.0, 1e-3);
    EXPECT_EQ(cone.is_sphere, exact.IsSphere());
  }
}

TEST(ConeTest, ASwallowedEndLeavesTheLargerSphere) {
  CapsuleGraph graph;
  graph.AddNode({0.0, 0.0, 0.0}, 0.02, false);
  graph.AddNode({0.03, 0.0, 0.0}, 0.10, false);
  const Cone cone = MakeCone(graph, 0, 1);
  EXPECT_TRUE(cone.is_sphere);
  EXPECT_EQ(cone.node_a, 1);
  EXPECT_NEAR(SignedDistance(cone, 0.03f, 0.2f, 0.0f), 0.1f, 1e-6f);
}

TEST(ConeTest, SpheresWithoutACapsuleGetAConeOfTheirOwn) {
  CapsuleGraph graph = LeggedGraph(true);
  const int ball = graph.AddNode({0.3, 0.5, 0.0}, 0.05, false);
  const std::vector<Cone> cones = ConesOf(graph);
  ASSERT_EQ(cones.size(), graph.edges.size() + 2);
  EXPECT_EQ(cones[graph.edges.size()].node_a, ball);
}

}  // namespace
}  // namespace capfit::refine
