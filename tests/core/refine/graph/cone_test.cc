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
    capsule::MirroredSet graph;
    graph.AddSphere({RandomPoint(random), random.NextIn(0.01, 0.15)}, false);
    graph.AddSphere({RandomPoint(random), random.NextIn(0.01, 0.15)}, false);
    const geometry::TaperedCapsule exact({graph.sphere(0).center_m, graph.sphere(0).radius_m},
                                         {graph.sphere(1).center_m, graph.sphere(1).radius_m});
    const Cone cone = MakeCone(graph, 0, 1);
    const Eigen::Vector3d p = RandomPoint(random);
    const Eigen::Vector3f f = p.cast<float>();
    EXPECT_NEAR(cone.SignedDistance(f.x(), f.y(), f.z()), exact.SignedDistance(p), 5e-6);
    EXPECT_NEAR((Locate(cone, p).normal - exact.Locate(p).normal).norm(), 0.0, 1e-3);
    EXPECT_EQ(cone.is_sphere, exact.IsSphere());
  }
}

TEST(ConeTest, ASwallowedEndLeavesTheLargerSphere) {
  capsule::MirroredSet graph;
  graph.AddSphere({{0.0, 0.0, 0.0}, 0.02}, false);
  graph.AddSphere({{0.03, 0.0, 0.0}, 0.10}, false);
  const Cone cone = MakeCone(graph, 0, 1);
  EXPECT_TRUE(cone.is_sphere);
  EXPECT_EQ(cone.node_a, 1);
  EXPECT_NEAR(cone.SignedDistance(0.03f, 0.2f, 0.0f), 0.1f, 1e-6f);
}

TEST(ConeTest, SpheresWithoutACapsuleGetAConeOfTheirOwn) {
  capsule::MirroredSet graph = LeggedGraph(true);
  const int ball = graph.AddSphere({{0.3, 0.5, 0.0}, 0.05}, false);
  const std::vector<Cone> cones = ConesOf(graph);
  ASSERT_EQ(cones.size(), graph.capsules().size() + 2);
  EXPECT_EQ(cones[graph.capsules().size()].node_a, ball);
}

// Of capsules across and beside the mid-plane, and of balls on it and beside it.
TEST(ConeTest, ImagesOfConesAreTheConesOnTheOtherSide) {
  capsule::MirroredSet graph = LeggedGraph(true);
  graph.AddSphere({{0.3, 0.5, 0.0}, 0.05}, false);
  graph.AddSphere({{0.0, 1.8, 0.0}, 0.08}, true);
  const std::vector<Cone> cones = ConesOf(graph);
  const std::vector<int> images = ImagesOfCones(graph);
  ASSERT_EQ(images.size(), cones.size());
  int own = 0;
  for (std::size_t i = 0; i < cones.size(); ++i) {
    const Cone& image = cones[images[i]];
    own += images[i] == static_cast<int>(i) ? 1 : 0;
    EXPECT_EQ(images[images[i]], static_cast<int>(i));
    EXPECT_EQ(std::minmax(image.node_a, image.node_b),
              std::minmax(graph.ImageOf(cones[i].node_a), graph.ImageOf(cones[i].node_b)));
  }
  EXPECT_EQ(own, 2);  // from chest to belly, and the ball on the plane
}

}  // namespace
}  // namespace capfit::refine
