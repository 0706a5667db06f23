#include "core/refine/enclosing/thinned_points.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/geometry/sphere.h"

namespace capfit::refine {
namespace {

TEST(ThinnedPoints, PointsInsideAreThoseOfTheLargerSpheres) {
  const std::vector<geometry::Sphere> spheres = {
      {{0.0, 1.0, 0.0}, 0.1}, {{0.5, 1.0, 0.0}, 0.04}, {{0.2, 0.5, 0.0}, 0.06}};
  const std::vector<Eigen::Vector3d> points_m = PointsInside(spheres);
  EXPECT_EQ(points_m.size(), 14U);  // seven in each of the two
  for (const Eigen::Vector3d& point_m : points_m) {
    const bool in_first = (point_m - spheres[0].center_m).norm() <= 0.05 + 1e-12;
    const bool in_last = (point_m - spheres[2].center_m).norm() <= 0.03 + 1e-12;
    EXPECT_NE(in_first, in_last) << point_m.transpose();
  }
  EXPECT_TRUE(PointsInside({}).empty());
}

TEST(ThinnedPoints, PointsInsideAreFoldedAndHaveTheMeanArea) {
  ThinnedPoints thinned{{{0.1, 0.0, 0.0}, {0.2, 0.0, 0.0}}, {0.5, 1.5}, 1.0};
  const std::vector<Eigen::Vector3d> inside_m = {{-0.3, 0.1, 0.2}};
  ThinnedPoints folded = thinned;
  AddPointsInside(inside_m, /*symmetric=*/true, folded);
  ASSERT_EQ(folded.points_m.size(), 3U);
  EXPECT_EQ(folded.points_m[2], Eigen::Vector3d(0.3, 0.1, 0.2));
  EXPECT_EQ(folded.areas_m2[2], 1.0);
  AddPointsInside(inside_m, /*symmetric=*/false, thinned);
  EXPECT_EQ(thinned.points_m[2], inside_m[0]);
}

}  // namespace
}  // namespace capfit::refine
