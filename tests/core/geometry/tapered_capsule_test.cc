#include "core/geometry/tapered_capsule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/random.h"

namespace capfit::geometry {
namespace {

Eigen::Vector3d RandomPoint(Random& random, double size) {
  return {random.NextIn(-size, size), random.NextIn(-size, size), random.NextIn(-size, size)};
}

Sphere RandomSphere(Random& random) { return {RandomPoint(random, 1.0), random.NextIn(0.01, 0.8)}; }

// The definition of the hull: the union of the spheres between the two ends.
double DistanceAt(const TaperedCapsule& capsule, const Eigen::Vector3d& point, double t) {
  const Eigen::Vector3d center = (1 - t) * capsule.a().center_m + t * capsule.b().center_m;
  return (point - center).norm() - (1 - t) * capsule.a().radius_m - t * capsule.b().radius_m;
}

// Golden-section search: the distance is convex in t.
double SmallestDistance(const TaperedCapsule& capsule, const Eigen::Vector3d& point) {
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 90; ++i) {
    const double first = high - (high - low) / std::numbers::phi;
    const double second = low + (high - low) / std::numbers::phi;
    if (DistanceAt(capsule, point, first) < DistanceAt(capsule, point, second)) {
      high = second;
    } else {
      low = first;
    }
  }
  return std::min({DistanceAt(capsule, point, 0.5 * (low + high)), DistanceAt(capsule, point, 0.0),
                   DistanceAt(capsule, point, 1.0)});
}

// Capsules of every kind: uniform, tapered, steep, swallowed, of length 0, with a radius of 0.
std::vector<TaperedCapsule> Zoo() {
  Random random(11);
  std::vector<TaperedCapsule> zoo;
  for (int i = 0; i < 200; ++i) zoo.emplace_back(RandomSphere(random), RandomSphere(random));
  const Sphere unit{{0.2, 0.1, -0.3}, 1.0};
  zoo.emplace_back(unit, Sphere{{0.2, 0.1, 0.7}, 1.0});
  zoo.emplace_back(unit, Sphere{{0.2, 0.1, 0.7}, 1e-9});                 // tip on the sphere
  zoo.emplace_back(unit, Sphere{{0.2, 0.1, 0.7 + 1e-9}, 0.0});           // tip just outside
  zoo.emplace_back(Sphere{{0.2, 0.4, -0.3}, 0.1}, unit);                 // swallowed by b
  zoo.emplace_back(unit, unit);                                          // no length
  zoo.emplace_back(Sphere{{0, 0, 0}, 0.0}, Sphere{{1.0, 0.0, 0}, 0.0});  // a segment
  return zoo;
}

TEST(TaperedCapsuleTest, DistanceIsTheLeastOverAllSpheresOfTheHull) {
  Random random(12);
  for (const TaperedCapsule& capsule : Zoo()) {
    for (int i = 0; i < 40; ++i) {
      const Eigen::Vector3d point = RandomPoint(random, 2.0);
      const double expected = SmallestDistance(capsule, point);
      EXPECT_NEAR(capsule.SignedDistance(point), expected, 1e-9);
      const CapsuleDistance located = capsule.Locate(point);
      EXPECT_NEAR(located.distance_m, expected, 1e-9);
      EXPECT_NEAR(DistanceAt(capsule, point, located.axis_parameter), expected, 1e-9);
    }
  }
}

TEST(TaperedCapsuleTest, PointsOnTheAxisAreExactToo) {
  for (const TaperedCapsule& capsule : Zoo()) {
    for (const double t : {-0.5, 0.0, 0.3, 0.5, 1.0, 1.5}) {
      const Eigen::Vector3d point = (1 - t) * capsule.a().center_m + t * capsule.b().center_m;
      EXPECT_NEAR(capsule.SignedDistance(point), SmallestDistance(capsule, point), 1e-9);
      EXPECT_NEAR(capsule.Locate(point).normal.norm(), 1.0, 1e-12);
    }
  }
}

TEST(TaperedCapsuleTest, NormalIsTheGradientOfTheDistance) {
  Random random(13);
  for (const TaperedCapsule& capsule : Zoo()) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d point = RandomPoint(random, 2.0);
      const CapsuleDistance located = capsule.Locate(point);
      const Eigen::Vector3d foot = (1 - located.axis_parameter) * capsule.a().center_m +
                                   located.axis_parameter * capsule.b().center_m;
      if ((point - foot).norm() < 1e-2) continue;  // strongly curved there
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(k);
        const double slope =
            (capsule.SignedDistance(point + step) - capsule.SignedDistance(point - step)) / 2e-6;
        EXPECT_NEAR(located.normal[k], slope, 2e-4);
      }
    }
  }
}

// Moving an end by d and growing it by e changes the distance by -(1-t)(n.d + e), which coverage
// builds its linear programmes on.
TEST(TaperedCapsuleTest, AxisParameterGivesTheDerivativeByTheEnds) {
  Random random(14);
  for (int i = 0; i < 500; ++i) {
    const Sphere a = RandomSphere(random);
    const Sphere b = RandomSphere(random);
    const TaperedCapsule capsule(a, b);
    if (capsule.IsSphere() || capsule.cos_half_angle() < 0.3) continue;
    const Eigen::Vector3d point = RandomPoint(random, 2.0);
    const CapsuleDistance located = capsule.Locate(point);
    if (std::abs(located.distance_m) < 0.02) continue;
    const Eigen::Vector3d shift = 1e-7 * RandomPoint(random, 1.0);
    const double growth = 1e-7 * random.NextIn(-1.0, 1.0);
    const TaperedCapsule moved({a.center_m + shift, a.radius_m + growth}, b);
    const double expected = -(1 - located.axis_parameter) * (located.normal.dot(shift) + growth);
    EXPECT_NEAR(moved.SignedDistance(point) - located.distance_m, expected, 1e-11);
  }
}

TEST(TaperedCapsuleTest, OneSphereWithinTheOtherIsTheLargerSphere) {
  const Sphere large{{0.1, 0.2, 0.3}, 0.5};
  const Sphere small{{0.3, 0.2, 0.3}, 0.3};  // touches the large one from inside
  Random random(15);
  for (const TaperedCapsule& capsule :
       {TaperedCapsule(large, small), TaperedCapsule(small, large)}) {
    EXPECT_TRUE(capsule.IsSphere());
    EXPECT_EQ(capsule.sin_half_angle(), 0.0);
    EXPECT_DOUBLE_EQ(capsule.Volume_m3(), 4.0 / 3.0 * std::numbers::pi * 0.125);
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d point = RandomPoint(random, 1.0);
      EXPECT_DOUBLE_EQ(capsule.SignedDistance(point), SignedDistance(large, point));
    }
    const double t = capsule.Locate({2, 2, 2}).axis_parameter;
    EXPECT_EQ(t, capsule.a().radius_m > capsule.b().radius_m ? 0.0 : 1.0);
  }
  EXPECT_FALSE(TaperedCapsule(large, {{0.300001, 0.2, 0.3}, 0.3}).IsSphere());
}

TEST(TaperedCapsuleTest, TurningAndMovingChangesNoDistance) {
  Random random(16);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d move(3, -2, 5);
  for (const TaperedCapsule& capsule : Zoo()) {
    const TaperedCapsule moved({turn * capsule.a().center_m + move, capsule.a().radius_m},
                               {turn * capsule.b().center_m + move, capsule.b().radius_m});
    const TaperedCapsule swapped(capsule.b(), capsule.a());
    if (moved.IsSphere() != capsule.IsSphere()) continue;  // exactly on the border
    const Eigen::Vector3d point = RandomPoint(random, 2.0);
    const double expected = capsule.SignedDistance(point);
    EXPECT_NEAR(moved.SignedDistance(turn * point + move), expected, 1e-9);
    EXPECT_NEAR(swapped.SignedDistance(point), expected, 1e-9);
  }
}

TEST(TaperedCapsuleTest, RayRunsInsideExactlyBetweenTheIntervalsEnds) {
  Random random(17);
  int hits = 0;
  for (const TaperedCapsule& capsule : Zoo()) {
    for (int i = 0; i < 30; ++i) {
      const Eigen::Vector3d origin = RandomPoint(random, 3.0);
      const Eigen::Vector3d direction = 0.3 * RandomPoint(random, 1.5) - 0.3 * origin;
      const std::optional<Interval> inside = capsule.Intersect(origin, direction);
      const auto distance = [&](double t) {
        return capsule.SignedDistance(origin + t * direction);
      };
      if (!inside) {
        for (int k = -400; k <= 400; ++k) EXPECT_GT(distance(0.05 * k), -1e-9);
        continue;
      }
      ++hits;
      EXPECT_NEAR(distance(inside->begin), 0.0, 1e-7);
      EXPECT_NEAR(distance(inside->end), 0.0, 1e-7);
      EXPECT_LE(distance(0.5 * (inside->begin + inside->end)), 1e-9);
      EXPECT_GE(distance(inside->begin - 1e-3), 0.0);
      EXPECT_GE(distance(inside->end + 1e-3), 0.0);
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(TaperedCapsuleTest, RaysAlongTheAxisAndAlongTheSlantHit) {
  const TaperedCapsule uniform({{0, 0, 0}, 0.5}, {{0, 0, 2}, 0.5});
  const std::optional<Interval> along = uniform.Intersect({0.1, 0, -5}, {0, 0, 1});
  ASSERT_TRUE(along);
  EXPECT_NEAR(along->begin, 5 - std::sqrt(0.24), 1e-12);
  EXPECT_NEAR(along->end, 7 + std::sqrt(0.24), 1e-12);
  const std::optional<Interval> across = uniform.Intersect({-3, 0, 1}, {2, 0, 0});
  ASSERT_TRUE(across);
  EXPECT_NEAR(across->begin, 1.25, 1e-12);
  EXPECT_NEAR(across->end, 1.75, 1e-12);
  // Parallel to the slant, just below it: the quadratic loses its leading coefficient.
  const TaperedCapsule cone({{0, 0, 0}, 1.0}, {{0, 0, 2}, 0.0});
  const Eigen::Vector3d normal(cone.cos_half_angle(), 0, cone.sin_half_angle());
  const Eigen::Vector3d slope(-normal.z(), 0, normal.x());
  const std::optional<Interval> grazing = cone.Intersect(0.9 * normal - 4 * slope, slope);
  ASSERT_TRUE(grazing);
  EXPECT_GT(grazing->end - grazing->begin, 1.0);
  EXPECT_FALSE(cone.Intersect(1.1 * normal - 4 * slope, slope));
}

struct VolumeCase {
  std::string name;
  Sphere a;
  Sphere b;
  double expected_m3;
};
void PrintTo(const VolumeCase& c, std::ostream* os) { *os << c.name; }

class TaperedCapsuleVolumeTest : public testing::TestWithParam<VolumeCase> {};

TEST_P(TaperedCapsuleVolumeTest, MatchesClosedForm) {
  const VolumeCase& c = GetParam();
  EXPECT_NEAR(TaperedCapsule(c.a, c.b).Volume_m3(), c.expected_m3, 1e-12);
  EXPECT_NEAR(TaperedCapsule(c.b, c.a).Volume_m3(), c.expected_m3, 1e-12);
}

constexpr double kPi = std::numbers::pi;
INSTANTIATE_TEST_SUITE_P(
    ClosedForm, TaperedCapsuleVolumeTest,
    testing::Values(VolumeCase{"Ball", {{1, 2, 3}, 0.5}, {{1, 2, 3}, 0.5}, kPi / 6},
                    VolumeCase{"Uniform", {{0, 0, 0}, 1}, {{0, 3, 0}, 1}, kPi*(3 + 4.0 / 3)},
                    VolumeCase{"Segment", {{0, 0, 0}, 0}, {{0, 3, 0}, 0}, 0},
                    // A unit ball with a tip at distance 2: a cone of slant sqrt 3 over a ring of
                    // radius sqrt 3 / 2 and height 3/2, on the ball's part below height 1/2.
                    VolumeCase{"Drop", {{0, 0, 0}, 1}, {{0, 0, 2}, 0}, kPi*(3.0 / 8 + 9.0 / 8)}),
    [](const auto& test) { return test.param.name; });

TEST(TaperedCapsuleTest, VolumeMatchesColumnsOfRays) {
  Random random(18);
  for (int i = 0; i < 8; ++i) {
    const TaperedCapsule capsule(RandomSphere(random), RandomSphere(random));
    double sum = 0.0;
    const int n = 400;
    const double step = 4.0 / n;
    for (int x = 0; x < n; ++x) {
      for (int y = 0; y < n; ++y) {
        const Eigen::Vector3d origin(-2 + (x + 0.5) * step, -2 + (y + 0.5) * step, 0);
        const std::optional<Interval> inside = capsule.Intersect(origin, {0, 0, 1});
        if (inside) sum += (inside->end - inside->begin) * step * step;
      }
    }
    EXPECT_NEAR(capsule.Volume_m3(), sum, 2e-3 * sum + 1e-5);
  }
}

TEST(TaperedCapsuleTest, ContainsABallOnlyWhenAllOfItIsInside) {
  const TaperedCapsule capsule({{0, 0, 0}, 0.5}, {{0, 0, 2}, 0.25});
  EXPECT_TRUE(capsule.Contains(capsule.a(), 1e-12));
  EXPECT_TRUE(capsule.Contains(capsule.b(), 1e-12));
  EXPECT_TRUE(capsule.Contains({{0, 0, 1}, 0.37}));
  EXPECT_FALSE(capsule.Contains({{0, 0, 1}, 0.38}));
  EXPECT_TRUE(capsule.Contains({{0, 0, 1}, 0.38}, 0.01));
  EXPECT_FALSE(capsule.Contains({{3, 0, 1}, 0.1}));
}

TEST(SphereTest, RayIntervalInClosedForm) {
  const Sphere sphere{{1, 0, 0}, 0.5};
  const std::optional<Interval> through = Intersect(sphere, {-1, 0, 0}, {2, 0, 0});
  ASSERT_TRUE(through);
  EXPECT_NEAR(through->begin, 0.75, 1e-14);
  EXPECT_NEAR(through->end, 1.25, 1e-14);
  EXPECT_FALSE(Intersect(sphere, {-1, 0.51, 0}, {1, 0, 0}));
  EXPECT_TRUE(Intersect(sphere, {-1, 0.49, 0}, {1, 0, 0}));
  EXPECT_FALSE(Intersect(sphere, {1, 0, 0}, {0, 0, 0}));  // no direction, no ray
}

}  // namespace
}  // namespace capfit::geometry
