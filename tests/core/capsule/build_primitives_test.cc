#include "core/capsule/build_primitives.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace capfit::capsule {
namespace {

using body::Part;
using circle::Circle;
using circle::PolygonApproximation;
using section::FeaturePolygon;

// A horizontal polygon at height `y`; the outline does not matter here.
FeaturePolygon PolygonAt(Part chain, int order, double x, double y, int mirror) {
  auto square = section::Polygon::Create({{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}});
  geometry::PlaneFrame frame;
  frame.origin_m = {x, y, 0};
  frame.x_axis = {1, 0, 0};
  frame.y_axis = {0, 0, -1};
  return {chain, "polygon", order, 0.1 * order, frame, *square, std::nullopt, mirror};
}

PolygonApproximation Circles(std::vector<Circle> circles) { return {std::move(circles), 0.0}; }

// Two trunk polygons of two and three circles, and two polygons on each arm.
struct Scene {
  std::vector<FeaturePolygon> polygons = {
      PolygonAt(Part::kTorso, 0, 0, 1.0, 0),       PolygonAt(Part::kTorso, 1, 0, 1.3, 1),
      PolygonAt(Part::kLeftArm, 0, 0.2, 1.3, 4),   PolygonAt(Part::kLeftArm, 1, 0.5, 1.3, 5),
      PolygonAt(Part::kRightArm, 0, -0.2, 1.3, 2), PolygonAt(Part::kRightArm, 1, -0.5, 1.3, 3)};
  std::vector<PolygonApproximation> approximations = {
      Circles({{{-0.05, 0.01}, 0.1}, {{0.05, 0.01}, 0.1}}),
      Circles({{{-0.1, 0}, 0.08}, {{1e-9, 0}, 0.1}, {{0.1, 1e-9}, 0.08}}),
      Circles({{{0.01, 0.02}, 0.05}}),
      Circles({{{0.01, 0.02}, 0.03}}),
      Circles({{{-0.01, 0.021}, 0.051}}),  // nearly the image of polygon 2's
      Circles({{{-0.01, 0.02}, 0.03}})};
};

int CountCapsulesBetween(const PrimitiveSet& set, int polygon_a, int polygon_b) {
  int count = 0;
  for (const CapsuleEnds& ends : set.capsules) {
    const std::pair<int, int> polygons(set.origins[ends[0]].polygon, set.origins[ends[1]].polygon);
    count +=
        polygons == std::pair(polygon_a, polygon_b) || polygons == std::pair(polygon_b, polygon_a);
  }
  return count;
}

TEST(BuildPrimitivesTest, ASphereForEachCircleInItsPlane) {
  const Scene scene;
  const PrimitiveSet set = BuildPrimitives(scene.polygons, scene.approximations, false);
  ASSERT_EQ(set.spheres.size(), 9u);
  ASSERT_EQ(set.origins.size(), 9u);
  EXPECT_EQ(set.spheres[0].center_m, Eigen::Vector3d(-0.05, 1.0, -0.01));
  EXPECT_EQ(set.spheres[0].radius_m, 0.1);
  EXPECT_EQ(set.origins[5].part, Part::kLeftArm);
  EXPECT_EQ(set.origins[5].polygon, 2);
}

TEST(BuildPrimitivesTest, CapsulesBetweenAllCirclesOfNeighboursOfAChain) {
  const Scene scene;
  const PrimitiveSet set = BuildPrimitives(scene.polygons, scene.approximations, false);
  EXPECT_EQ(set.capsules.size(), 2u * 3u + 1u + 1u);
  EXPECT_EQ(CountCapsulesBetween(set, 0, 1), 6);
  EXPECT_EQ(CountCapsulesBetween(set, 2, 3), 1);
  EXPECT_EQ(CountCapsulesBetween(set, 4, 5), 1);
  EXPECT_EQ(set.primitive_count(), 17);
  std::set<CapsuleEnds> distinct(set.capsules.begin(), set.capsules.end());
  EXPECT_EQ(distinct.size(), set.capsules.size());
  for (const CapsuleEnds& ends : set.capsules) EXPECT_LT(ends[0], ends[1]);
}

TEST(BuildPrimitivesTest, ImagesAreExact) {
  const Scene scene;
  const PrimitiveSet set = BuildPrimitives(scene.polygons, scene.approximations, false);
  for (std::size_t i = 0; i < set.spheres.size(); ++i) {
    ASSERT_GE(set.origins[i].mirror, 0);
    const auto mirror = static_cast<std::size_t>(set.origins[i].mirror);
    EXPECT_EQ(set.origins[mirror].mirror, static_cast<int>(i));
    EXPECT_EQ(set.spheres[mirror].center_m.x(), -set.spheres[i].center_m.x());
    EXPECT_EQ(set.spheres[mirror].center_m.tail<2>(), set.spheres[i].center_m.tail<2>());
    EXPECT_EQ(set.spheres[mirror].radius_m, set.spheres[i].radius_m);
  }
  EXPECT_EQ(set.origins[3].mirror, 3);  // the middle one of three
  EXPECT_EQ(set.spheres[3].center_m.x(), 0.0);
}

TEST(BuildPrimitivesTest, CirclesThatDoNotMirrorStayAsTheyAre) {
  Scene scene;
  scene.approximations[0] = Circles({{{-0.05, 0.01}, 0.1}, {{0.07, 0.01}, 0.1}});
  scene.polygons[2].mirror = scene.polygons[4].mirror = -1;
  const PrimitiveSet set = BuildPrimitives(scene.polygons, scene.approximations, false);
  EXPECT_EQ(set.origins[0].mirror, -1);
  EXPECT_EQ(set.origins[1].mirror, -1);
  EXPECT_EQ(set.origins[5].mirror, -1);
  EXPECT_EQ(set.spheres[7].radius_m, 0.051);  // polygon 4's own circle
}

TEST(BuildPrimitivesTest, PolygonsMayComeInAnyOrder) {
  Scene scene;
  scene.polygons[0].order = 1;
  scene.polygons[1].order = 2;
  scene.polygons.push_back(PolygonAt(Part::kTorso, 0, 0, 0.8, 6));
  scene.approximations.push_back(Circles({{{0, 0}, 0.1}}));
  const PrimitiveSet set = BuildPrimitives(scene.polygons, scene.approximations, false);
  EXPECT_EQ(CountCapsulesBetween(set, 6, 0), 2);
  EXPECT_EQ(CountCapsulesBetween(set, 6, 1), 0);
}

TEST(BuildPrimitivesTest, LinksGoToTheNearestTorsoSphereOnBothSides) {
  const Scene scene;
  const PrimitiveSet set = BuildPrimitives(scene.polygons, scene.approximations, true);
  EXPECT_EQ(set.capsules.size(), 8u + 2u);
  EXPECT_THAT(set.capsules, testing::Contains(CapsuleEnds{4, 5}));  // chest at +x, left arm
  EXPECT_THAT(set.capsules, testing::Contains(CapsuleEnds{2, 7}));  // their images
}

TEST(BuildPrimitivesTest, NothingFromNothing) {
  const PrimitiveSet set = BuildPrimitives({}, {}, true);
  EXPECT_EQ(set.primitive_count(), 0);
}

TEST(SolidsTest, EveryCapsuleAndEveryLoneSphere) {
  PrimitiveSet set;
  set.spheres = {{{0, 0, 0}, 0.1}, {{1, 0, 0}, 0.2}, {{2, 0, 0}, 0.3}};
  set.origins.resize(3);
  set.capsules = {{0, 1}};
  const std::vector<geometry::TaperedCapsule> solids = Solids(set);
  ASSERT_EQ(solids.size(), 2u);
  EXPECT_FALSE(solids[0].IsSphere());
  EXPECT_TRUE(solids[1].IsSphere());
  EXPECT_NEAR(solids[1].SignedDistance({2, 0, 0}), -0.3, 1e-15);
}

}  // namespace
}  // namespace capfit::capsule
