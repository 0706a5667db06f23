#include "core/circle/cover_outline.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/circle/outlines.h"

namespace capfit::circle {
namespace {

TEST(FindGapsTest, OneCircleThatCoversLeavesNone) {
  EXPECT_TRUE(FindGaps(std::vector<Circle>{{{1, 1}, 1.5}}, Square(2), 1e-9).empty());
}

TEST(FindGapsTest, NamesTheUncoveredStretchOfEachEdge) {
  const std::vector<Circle> circles{{{0, 1}, 1.1}, {{2, 1}, 1.1}};
  const std::vector<Gap> gaps = FindGaps(circles, Square(2), 1e-12);
  // Half a circle's reach along the bottom and top edges is sqrt(1.1^2 - 1).
  const double reach = std::sqrt(0.21);
  ASSERT_EQ(gaps.size(), 2u);
  EXPECT_NEAR(gaps[0].begin_m.x(), reach, 1e-9);
  EXPECT_NEAR(gaps[0].end_m.x(), 2 - reach, 1e-9);
  EXPECT_NEAR(gaps[0].begin_m.y(), 0.0, 1e-15);
  EXPECT_EQ(gaps[1].begin_m.y(), 2.0);
}

TEST(FindGapsTest, FindsAHoleThatNoEdgeTells) {
  std::vector<Circle> ring;
  for (int i = 0; i < 6; ++i) {
    const double a = kPi * i / 3;
    ring.push_back({{std::cos(a), std::sin(a)}, 0.8});
  }
  const section::Polygon outline = Ellipse(1.1, 1.1, 60);
  EXPECT_EQ(FindGaps(ring, outline, 1e-9).size(), 6u);  // the hole's corners
  ring.push_back({{0, 0}, 0.5});
  EXPECT_TRUE(FindGaps(ring, outline, 1e-9).empty());
}

Cluster Free(const Circle& circle) {
  Cluster cluster;
  cluster.circle = circle;
  cluster.hull = {circle.center_m + Eigen::Vector2d(circle.radius_m, 0),
                  circle.center_m - Eigen::Vector2d(circle.radius_m, 0),
                  circle.center_m + Eigen::Vector2d(0, circle.radius_m)};
  return cluster;
}

TEST(CloseGapsTest, ClosesWhatRandomCirclesLeaveOpen) {
  Random random(61);
  for (int scene = 0; scene < 40; ++scene) {
    const section::Polygon outline = RandomStar(random, 30, 0.5);
    std::vector<Cluster> clusters;
    for (int i = 0; i < 2 + scene % 6; ++i) {
      clusters.push_back(
          Free({{random.NextIn(-0.7, 0.7), random.NextIn(-0.7, 0.7)}, random.NextIn(0.2, 0.7)}));
    }
    for (const int fitting_rounds : {0, 6}) {
      std::vector<Cluster> closed = clusters;
      CloseGaps(outline, false, fitting_rounds, 1e-9, closed);
      EXPECT_TRUE(FindGaps(AllCircles(closed), outline, 1e-9).empty())
          << "scene " << scene << ", fitting rounds " << fitting_rounds;
    }
  }
}

TEST(CloseGapsTest, TinyGapsCostTinyGrowth) {
  // Two circles that cover all but 0.1 mm of the top and bottom edges.
  const double r = std::hypot(0.5 - 5e-5, 0.5);
  std::vector<Cluster> clusters{Free({{0.0, 0.5}, 1.0}), Free({{1.0, 0.5}, 1.0})};
  for (Cluster& c : clusters) c.circle.radius_m = r;
  clusters[0].hull = {{0, 0}, {0, 1}};
  clusters[1].hull = {{1, 0}, {1, 1}};
  const section::Polygon outline = Square(1);
  ASSERT_EQ(FindGaps(AllCircles(clusters), outline, 1e-9).size(), 2u);
  CloseGaps(outline, false, 6, 1e-9, clusters);
  for (const Cluster& c : clusters) EXPECT_LT(c.circle.radius_m, r + 2e-4);
}

}  // namespace
}  // namespace capfit::circle
