#include "core/export/sphere_chain.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"

namespace capfit::exports {
namespace {

using Vec3 = Eigen::Vector3d;

Vec3 RandomPoint(Random& random) {
  return {random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(-1, 1)};
}

TEST(SphereChain, HoldsTheHullAndStandsOutByNoMoreThanAllowed) {
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    const geometry::TaperedCapsule hull({0.3 * RandomPoint(random), random.NextIn(0.001, 0.2)},
                                        {0.3 * RandomPoint(random), random.NextIn(0.001, 0.2)});
    const double overshoot = random.NextIn(0.001, 0.02);
    const std::vector<geometry::Sphere> chain = SphereChain(hull, overshoot);
    for (const geometry::Sphere& sphere : chain) {
      EXPECT_LE(hull.SignedDistance(sphere.center_m) + sphere.radius_m, overshoot + 1e-12);
    }
    for (int k = 0; k < 500; ++k) {
      // A ball of the hull, and a point of its surface.
      const double t = random.NextUnit();
      const Vec3 center = (1 - t) * hull.a().center_m + t * hull.b().center_m;
      const double radius = (1 - t) * hull.a().radius_m + t * hull.b().radius_m;
      const Vec3 point = center + radius * RandomPoint(random).normalized();
      if (hull.IsSphere() && hull.SignedDistance(point) > 0.0) continue;
      const bool is_held = std::any_of(chain.begin(), chain.end(), [&](const auto& sphere) {
        return SignedDistance(sphere, point) <= 1e-12;
      });
      EXPECT_TRUE(is_held) << round;
    }
  }
}

TEST(SphereChain, OfAUniformCapsuleHasTheNumberOfTheClosedForm) {
  // Radius 60 mm, 5 mm allowed: neighbours up to 2 sqrt(65^2 - 60^2) = 50 mm apart.
  const auto count = [](double length) {
    return SphereChain({{Vec3(0, 0, 0), 0.06}, {Vec3(0, length, 0), 0.06}}, 0.005).size();
  };
  EXPECT_EQ(count(0.0499), 2);
  EXPECT_EQ(count(0.0501), 3);
  EXPECT_EQ(count(0.2999), 7);
  EXPECT_EQ(count(0.3001), 8);
  EXPECT_EQ(count(0.0), 1);
}

}  // namespace
}  // namespace capfit::exports
