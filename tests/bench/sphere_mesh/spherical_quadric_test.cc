#include "tests/bench/sphere_mesh/spherical_quadric.h"

#include <gtest/gtest.h>

#include <cmath>

namespace capfit::bench {
namespace {

using Eigen::Vector3d;
using geometry::Sphere;

// Tangent planes all over a sphere.
SphericalQuadric TangentPlanesOf(const Sphere& sphere) {
  SphericalQuadric quadric;
  for (int i = 0; i < 40; ++i) {
    const double z = -1.0 + (i + 0.5) / 20.0, around = 2.4 * i, ring = std::sqrt(1.0 - z * z);
    const Vector3d normal(ring * std::cos(around), ring * std::sin(around), z);
    quadric.AddPlane(sphere.center_m + sphere.radius_m * normal, normal, 0.1 + 0.01 * i);
  }
  return quadric;
}

TEST(SphericalQuadric, IsZeroForASpheresOwnSurface) {
  const Sphere sphere{{0.3, 1.2, -0.4}, 0.17};
  const SphericalQuadric quadric = TangentPlanesOf(sphere);
  EXPECT_NEAR(quadric.Error(sphere), 0.0, 1e-14);
  const auto found = quadric.Minimise(1.0);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR((found->center_m - sphere.center_m).norm(), 0.0, 1e-10);
  EXPECT_NEAR(found->radius_m, sphere.radius_m, 1e-10);
}

TEST(SphericalQuadric, IsTheWeightedSumOfSquaredDistances) {
  SphericalQuadric quadric;
  quadric.AddPlane({0, 0, 2}, {0, 0, 1}, 3.0);   // the sphere ends at z = 1.5: off by 0.5
  quadric.AddPlane({1, 7, 9}, {1, 0, 0}, 0.25);  // and at x = 0.5: off by 0.5
  EXPECT_DOUBLE_EQ(quadric.Error({{0, 0, 1}, 0.5}), 3.25 * 0.25);
  SphericalQuadric twice = quadric;
  twice += quadric;
  EXPECT_DOUBLE_EQ(twice.Error({{0, 0, 1}, 0.5}), 3.25 * 0.5);
}

TEST(SphericalQuadric, BetweenParallelPlanesTheSphereTouchesBoth) {
  SphericalQuadric quadric;
  quadric.AddPlane({0, 0, 0.4}, {0, 0, 1}, 1.0);
  quadric.AddPlane({0, 0, -0.2}, {0, 0, -1}, 1.0);
  EXPECT_FALSE(quadric.Minimise(1.0).has_value()) << "it may slide along the planes";
  const Sphere found = quadric.MinimiseOnSegment({0, 0, 0.4}, {0, 0, -0.2}, 1.0);
  EXPECT_NEAR(found.center_m.z(), 0.1, 1e-12);
  EXPECT_NEAR(found.radius_m, 0.3, 1e-12);
  EXPECT_NEAR(quadric.Error(found), 0.0, 1e-14);
}

// A bound of 0.2 on the radius leaves 0.1 on either side of the same planes: 2 * 0.1^2.
TEST(SphericalQuadric, HoldsTheBoundOnTheRadius) {
  SphericalQuadric quadric;
  quadric.AddPlane({0, 0, 0.4}, {0, 0, 1}, 1.0);
  quadric.AddPlane({0, 0, -0.2}, {0, 0, -1}, 1.0);
  const Sphere found = quadric.MinimiseOnSegment({0, 0, 0.4}, {0, 0, -0.2}, 0.2);
  EXPECT_DOUBLE_EQ(found.radius_m, 0.2);
  EXPECT_NEAR(quadric.Error(found), 0.02, 1e-12);

  const Sphere sphere{{0.3, 1.2, -0.4}, 0.17};
  const auto bounded = TangentPlanesOf(sphere).Minimise(0.1);
  ASSERT_TRUE(bounded.has_value());
  EXPECT_DOUBLE_EQ(bounded->radius_m, 0.1);
}

// Inward planes ask for a negative radius.
TEST(SphericalQuadric, TheRadiusIsNeverNegative) {
  SphericalQuadric quadric;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      quadric.AddPlane(-0.1 * side * Vector3d::Unit(axis), side * Vector3d::Unit(axis), 1.0);
    }
  }
  const auto found = quadric.Minimise(1.0);
  ASSERT_TRUE(found.has_value());
  EXPECT_DOUBLE_EQ(found->radius_m, 0.0);
  EXPECT_NEAR(found->center_m.norm(), 0.0, 1e-12);
}

// Nothing on the segment is better than what is found, on a grid.
TEST(SphericalQuadric, TheSegmentsBestIsTheBestOfAll) {
  SphericalQuadric quadric;
  quadric.AddPlane({0.3, 0.1, 0.2}, Vector3d(1, 2, 2) / 3, 0.7);
  quadric.AddPlane({-0.2, 0.1, -0.1}, Vector3d(-2, 1, 2) / 3, 0.4);
  quadric.AddPlane({0.1, -0.3, 0.4}, Vector3d(2, -2, 1) / 3, 1.1);
  const Vector3d a(-0.3, 0.2, 0.1), b(0.4, -0.1, 0.3);
  const double error = quadric.Error(quadric.MinimiseOnSegment(a, b, 0.25));
  for (int i = 0; i <= 100; ++i) {
    for (int j = 0; j <= 100; ++j) {
      EXPECT_LE(error, quadric.Error({a + i / 100.0 * (b - a), j / 400.0}) + 1e-12);
    }
  }
}

}  // namespace
}  // namespace capfit::bench
