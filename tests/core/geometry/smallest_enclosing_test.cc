#include "core/geometry/smallest_enclosing.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/random.h"

namespace capfit::geometry {
namespace {

double RadiusAround(const Eigen::Vector2d& center, const std::vector<Eigen::Vector2d>& points) {
  double radius = 0.0;
  for (const Eigen::Vector2d& p : points) radius = std::max(radius, (p - center).norm());
  return radius;
}

double RadiusAround(const Eigen::Vector3d& center, const std::vector<Eigen::Vector3d>& points) {
  double radius = 0.0;
  for (const Eigen::Vector3d& p : points) radius = std::max(radius, (p - center).norm());
  return radius;
}

// The answer is the circle on some pair or through some triple.
double BruteForceCircle(const std::vector<Eigen::Vector2d>& points) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      best = std::min(best, RadiusAround(0.5 * (points[i] + points[j]), points));
      for (std::size_t k = 0; k < j; ++k) {
        Eigen::Matrix2d rows;
        rows << (points[j] - points[i]).transpose(), (points[k] - points[i]).transpose();
        if (std::abs(rows.determinant()) < 1e-12) continue;
        const Eigen::Vector2d rhs(0.5 * (points[j] - points[i]).squaredNorm(),
                                  0.5 * (points[k] - points[i]).squaredNorm());
        best = std::min(best, RadiusAround(points[i] + rows.inverse() * rhs, points));
      }
    }
  }
  return best;
}

// Around a minimal ball's centre no direction leads away from all the points that hold it: the
// radius grows whichever way the centre moves.
template <typename Point>
void ExpectNoBetterCentreNearby(const Point& center, double radius,
                                const std::vector<Point>& points, Random& random) {
  for (int i = 0; i < 60; ++i) {
    Point step;
    for (Eigen::Index k = 0; k < step.size(); ++k) step[k] = random.NextIn(-1.0, 1.0);
    const Point other = center + 1e-4 * radius * step;
    EXPECT_GE(RadiusAround(other, points), radius * (1 - 1e-12));
  }
}

TEST(SmallestEnclosingCircleTest, MatchesAllPairsAndTriples) {
  Random random(21);
  for (int round = 0; round < 200; ++round) {
    std::vector<Eigen::Vector2d> points(2 + random.NextBelow(12));
    for (auto& p : points) p = {random.NextIn(-1, 1), random.NextIn(-1, 1)};
    const Circle circle = SmallestEnclosingCircle(points);
    EXPECT_NEAR(circle.radius_m, BruteForceCircle(points), 1e-12);
    for (const auto& p : points) EXPECT_LE((p - circle.center_m).norm(), circle.radius_m);
  }
}

TEST(SmallestEnclosingCircleTest, NoPointsOnePointAndRepeatedPoints) {
  EXPECT_EQ(SmallestEnclosingCircle({}).radius_m, 0.0);
  const std::vector<Eigen::Vector2d> one = {{3, 4}};
  EXPECT_EQ(SmallestEnclosingCircle(one).radius_m, 0.0);
  EXPECT_EQ(SmallestEnclosingCircle(one).center_m, one[0]);
  const std::vector<Eigen::Vector2d> same(9, Eigen::Vector2d(3, 4));
  EXPECT_EQ(SmallestEnclosingCircle(same).radius_m, 0.0);
  const std::vector<Eigen::Vector2d> two = {{0, 0}, {0, 0}, {2, 0}, {2, 0}, {0, 0}};
  EXPECT_NEAR(SmallestEnclosingCircle(two).radius_m, 1.0, 1e-15);
}

TEST(SmallestEnclosingCircleTest, PointsOnALineAndOnACircle) {
  std::vector<Eigen::Vector2d> line;
  for (int i = 0; i <= 100; ++i) line.emplace_back(0.01 * i, 0.03 * i);
  EXPECT_NEAR(SmallestEnclosingCircle(line).radius_m, 0.5 * std::sqrt(10.0), 1e-12);
  std::vector<Eigen::Vector2d> ring;
  for (int i = 0; i < 360; ++i) {
    const double angle = i * EIGEN_PI / 180;
    ring.emplace_back(5 + 2 * std::cos(angle), 7 + 2 * std::sin(angle));
  }
  const Circle circle = SmallestEnclosingCircle(ring);
  EXPECT_NEAR(circle.radius_m, 2.0, 1e-12);
  EXPECT_NEAR((circle.center_m - Eigen::Vector2d(5, 7)).norm(), 0.0, 1e-12);
}

TEST(SmallestEnclosingCircleTest, FarFromTheOriginAndNearlyOnALine) {
  Random random(22);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 500; ++i) {
    points.emplace_back(1e3 + random.NextUnit(), 1e3 + 1e-9 * random.NextUnit());
  }
  const Circle circle = SmallestEnclosingCircle(points);
  EXPECT_LT(circle.radius_m, 0.5);
  EXPECT_GT(circle.radius_m, 0.49);
  for (const auto& p : points) EXPECT_LE((p - circle.center_m).norm(), circle.radius_m);
}

TEST(SmallestEnclosingBallTest, TetrahedronBoxAndSphere) {
  const std::vector<Eigen::Vector3d> tetrahedron = {
      {1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  EXPECT_NEAR(SmallestEnclosingBall(tetrahedron).radius_m, std::sqrt(3.0), 1e-12);
  std::vector<Eigen::Vector3d> box;
  for (int i = 0; i < 8; ++i) box.emplace_back(i & 1 ? 1 : -1, i & 2 ? 2 : -2, i & 4 ? 3 : -3);
  EXPECT_NEAR(SmallestEnclosingBall(box).radius_m, std::sqrt(14.0), 1e-12);
  Random random(23);
  std::vector<Eigen::Vector3d> sphere;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d p(random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(-1, 1));
    sphere.push_back(Eigen::Vector3d(2, 3, 4) + 0.7 * p.normalized());
  }
  const Sphere ball = SmallestEnclosingBall(sphere);
  EXPECT_NEAR(ball.radius_m, 0.7, 1e-4);
  ExpectNoBetterCentreNearby(ball.center_m, ball.radius_m, sphere, random);
}

TEST(SmallestEnclosingBallTest, NoCentreNearbyNeedsASmallerRadius) {
  Random random(24);
  for (int round = 0; round < 100; ++round) {
    std::vector<Eigen::Vector3d> points(1 + random.NextBelow(60));
    for (auto& p : points) {
      p = {random.NextIn(-1, 1), random.NextIn(-0.3, 0.3), random.NextIn(-2, 2)};
    }
    const Sphere ball = SmallestEnclosingBall(points);
    for (const auto& p : points) EXPECT_LE((p - ball.center_m).norm(), ball.radius_m);
    ExpectNoBetterCentreNearby(ball.center_m, ball.radius_m, points, random);
  }
}

TEST(SmallestEnclosingBallTest, FlatAndStraightSetsAreBallsOfTheirPlaneAndLine) {
  std::vector<Eigen::Vector3d> flat;
  Random random(25);
  for (int i = 0; i < 40; ++i) flat.emplace_back(random.NextIn(-1, 1), 0.25, random.NextIn(-1, 1));
  const Sphere ball = SmallestEnclosingBall(flat);
  EXPECT_NEAR(ball.center_m.y(), 0.25, 1e-12);
  std::vector<Eigen::Vector2d> projected;
  for (const auto& p : flat) projected.emplace_back(p.x(), p.z());
  EXPECT_NEAR(ball.radius_m, SmallestEnclosingCircle(projected).radius_m, 1e-12);
  const std::vector<Eigen::Vector3d> straight = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {2, 2, 2}};
  EXPECT_NEAR(SmallestEnclosingBall(straight).radius_m, 1.5 * std::sqrt(3.0), 1e-12);
}

}  // namespace
}  // namespace capfit::geometry
