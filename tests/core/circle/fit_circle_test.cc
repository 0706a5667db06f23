#include "core/circle/fit_circle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

#include "core/circle/circle_outside_area.h"
#include "tests/core/circle/outlines.h"

namespace capfit::circle {
namespace {

double RadiusFor(const Eigen::Vector2d& center, std::span<const Eigen::Vector2d> points) {
  double radius = 0.0;
  for (const Eigen::Vector2d& p : points) radius = std::max(radius, (p - center).norm());
  return radius;
}

// Nelder and Mead 1965: needs no derivative, so it shares nothing with what it checks.
double DownhillSimplex(const std::function<double(const Eigen::Vector2d&)>& f,
                       const Eigen::Vector2d& start, double size) {
  std::array<Eigen::Vector2d, 3> p{start, start + Eigen::Vector2d(size, 0),
                                   start + Eigen::Vector2d(0, size)};
  std::array<double, 3> v{f(p[0]), f(p[1]), f(p[2])};
  for (int step = 0; step < 200; ++step) {
    std::array<std::size_t, 3> o{0, 1, 2};
    std::sort(o.begin(), o.end(), [&](std::size_t a, std::size_t b) { return v[a] < v[b]; });
    const Eigen::Vector2d middle = 0.5 * (p[o[0]] + p[o[1]]);
    const auto try_at = [&](double t) {
      const Eigen::Vector2d at = middle + t * (p[o[2]] - middle);
      const double value = f(at);
      if (value >= v[o[2]]) return false;
      p[o[2]] = at;
      v[o[2]] = value;
      return true;
    };
    if (f(middle - (p[o[2]] - middle)) < v[o[0]] ? try_at(-2.0) || try_at(-1.0)
                                                 : try_at(-1.0) || try_at(0.5)) {
      continue;
    }
    for (const std::size_t i : {o[1], o[2]}) {
      p[i] = 0.5 * (p[i] + p[o[0]]);
      v[i] = f(p[i]);
    }
  }
  return *std::min_element(v.begin(), v.end());
}

// Vertices of the outline within a random disc: what a partition hands to a fit.
std::vector<Eigen::Vector2d> RandomCluster(Random& random, const section::Polygon& outline) {
  const Eigen::Vector2d middle(random.NextIn(-0.15, 0.15), random.NextIn(-0.1, 0.1));
  const double reach = random.NextIn(0.06, 0.16);
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector2d& v : outline.vertices()) {
    if ((v - middle).norm() < reach) points.push_back(v);
  }
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  return points;
}

TEST(FitCircleTest, RandomClustersAreFittedAtLeastAsWellAsByDownhillSimplex) {
  Random random(41);
  int fits = 0;
  int better = 0;
  double sum = 0.0;
  double simplex_sum = 0.0;
  while (fits < 300) {
    const section::Polygon outline = MirroredTrunk(random, 96, 0.15);
    const std::vector<Eigen::Vector2d> points = RandomCluster(random, outline);
    if (points.size() < 3) continue;
    ++fits;
    const std::vector<Eigen::Vector2d> hull = ConvexHull(points);
    Eigen::Vector2d start = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& p : points) start += p / static_cast<double>(points.size());
    const auto area = [&](const Eigen::Vector2d& c) {
      return CircleOutsideArea({c, RadiusFor(c, points)}, outline);
    };
    const CircleFit fit = FitCircle(outline, hull, start, Place::kFree, 40);
    EXPECT_GE(fit.circle.radius_m, RadiusFor(fit.circle.center_m, points) - 1e-12);
    EXPECT_LE(fit.outside_area_m2, area(start));
    const double simplex = DownhillSimplex(area, start, 0.02);
    EXPECT_LE(fit.outside_area_m2, 1.02 * simplex + 2e-6) << "fit " << fits;  // other local minima
    better += fit.outside_area_m2 <= simplex * (1 + 1e-4) + 1e-9 ? 1 : 0;
    sum += fit.outside_area_m2;
    simplex_sum += simplex;
  }
  EXPECT_GE(better, 290);
  EXPECT_LE(sum, 1.0005 * simplex_sum);
}

TEST(FitCircleTest, CentredFitsStayOnTheAxis) {
  Random random(42);
  for (int scene = 0; scene < 50; ++scene) {
    const section::Polygon outline = MirroredTrunk(random, 96, 0.15);
    const std::vector<Eigen::Vector2d> points = RandomCluster(random, outline);
    if (points.empty()) continue;
    const CircleFit fit = FitCircle(outline, points, {0.02, 0.01}, Place::kCentred, 40);
    EXPECT_EQ(fit.circle.center_m.x(), 0.0);
    const auto area = [&](double y) {
      return CircleOutsideArea({{0, y}, RadiusFor({0, y}, points)}, outline);
    };
    EXPECT_LE(fit.outside_area_m2, area(0.01) + 1e-12);
    // No neighbour on the axis is better.
    EXPECT_LE(fit.outside_area_m2, area(fit.circle.center_m.y() + 1e-4) + 1e-7);
    EXPECT_LE(fit.outside_area_m2, area(fit.circle.center_m.y() - 1e-4) + 1e-7);
  }
}

TEST(FitCircleTest, FewPoints) {
  const section::Polygon outline = Square(1);
  const std::vector<Eigen::Vector2d> one{{0.5, 0.5}};
  const CircleFit single = FitCircle(outline, one, {0, 0}, Place::kFree, 10);
  EXPECT_EQ(single.circle.radius_m, 0.0);
  EXPECT_EQ(single.circle.center_m, one[0]);
  const std::vector<Eigen::Vector2d> two{{0, 0}, {0, 1}};
  const CircleFit pair = FitCircle(outline, two, {0.3, 0.4}, Place::kFree, 40);
  EXPECT_GE(pair.circle.radius_m, RadiusFor(pair.circle.center_m, two) - 1e-12);
  EXPECT_LE(pair.outside_area_m2, kPi / 8);  // the half circle over the edge is one answer
}

TEST(ConvexHullTest, KeepsCornersOnly) {
  const std::vector<Eigen::Vector2d> points{{0, 0}, {0, 1},   {0, 2}, {1, 0},
                                            {1, 1}, {1, 1.5}, {2, 0}, {2, 2}};
  EXPECT_EQ(ConvexHull(points).size(), 4u);
  EXPECT_EQ(ConvexHull(std::vector<Eigen::Vector2d>{{0, 0}, {1, 1}}).size(), 2u);
  EXPECT_EQ(ConvexHull(std::vector<Eigen::Vector2d>{{0, 0}, {1, 1}, {2, 2}}).size(), 2u);
}

}  // namespace
}  // namespace capfit::circle
