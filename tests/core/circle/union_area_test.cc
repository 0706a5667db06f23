#include "core/circle/union_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/circle/circle_outside_area.h"
#include "tests/core/circle/outlines.h"

namespace capfit::circle {
namespace {

TEST(UnionAreaTest, ClosedForms) {
  const double lens = 2.0 * kPi / 3.0 - std::sqrt(3.0) / 2.0;  // unit circles one radius apart
  EXPECT_NEAR(UnionArea(std::vector<Circle>{{{3, 4}, 2.0}}), 4 * kPi, 1e-12);
  EXPECT_NEAR(UnionArea(std::vector<Circle>{{{0, 0}, 1}, {{5, 0}, 1}}), 2 * kPi, 1e-12);
  EXPECT_NEAR(UnionArea(std::vector<Circle>{{{0, 0}, 1}, {{1, 0}, 1}}), 2 * kPi - lens, 1e-12);
  EXPECT_NEAR(UnionArea(std::vector<Circle>{{{0, 0}, 3}, {{1, 0}, 1}}), 9 * kPi, 1e-12);
  EXPECT_NEAR(UnionArea(std::vector<Circle>{{{0, 1}, 1}, {{0, 1}, 1}, {{0, 1}, 1}}), kPi, 1e-12);
  EXPECT_EQ(UnionArea({}), 0.0);
}

TEST(UnionAreaTest, OverlapRatios) {
  const double lens = 2.0 * kPi / 3.0 - std::sqrt(3.0) / 2.0;
  const std::vector<double> ratios =
      OverlapRatios(std::vector<Circle>{{{0, 0}, 1}, {{1, 0}, 1}, {{9, 0}, 2}, {{9, 1}, 0.5}});
  EXPECT_NEAR(ratios[0], lens / kPi, 1e-12);
  EXPECT_NEAR(ratios[1], lens / kPi, 1e-12);
  EXPECT_NEAR(ratios[2], 1.0 / 16.0, 1e-12);
  EXPECT_NEAR(ratios[3], 1.0, 1e-12);
}

TEST(UnionOutsideAreaTest, OneCircleIsTheCircleOutsideArea) {
  Random random(21);
  for (int scene = 0; scene < 100; ++scene) {
    const section::Polygon outline = RandomStar(random, 3 + scene % 20, 0.8);
    const std::vector<Circle> circle{
        {{random.NextIn(-1, 1), random.NextIn(-1, 1)}, random.NextIn(0.05, 1.5)}};
    EXPECT_NEAR(UnionOutsideArea(circle, outline), CircleOutsideArea(circle[0], outline), 1e-10);
  }
}

TEST(UnionOutsideAreaTest, AgreesWithCountingCells) {
  Random random(22);
  for (int scene = 0; scene < 20; ++scene) {
    const section::Polygon outline = RandomStar(random, 12, 0.7);
    std::vector<Circle> circles;
    for (int i = 0; i < 2 + scene % 5; ++i) {
      circles.push_back(
          {{random.NextIn(-0.9, 0.9), random.NextIn(-0.9, 0.9)}, random.NextIn(0.1, 0.9)});
    }
    const int cells = 500;
    const double h = 4.0 / cells;
    int count = 0;
    for (int k = 0; k < cells * cells; ++k) {
      const Eigen::Vector2d p((k % cells + 0.5) * h - 2.0, (k / cells + 0.5) * h - 2.0);
      bool inside = false;
      for (const Circle& c : circles) inside = inside || (p - c.center_m).norm() < c.radius_m;
      if (inside && !outline.Contains(p)) ++count;
    }
    EXPECT_NEAR(UnionOutsideArea(circles, outline), count * h * h, 0.02) << "scene " << scene;
  }
}

TEST(UnionOutsideAreaTest, CirclesThatCoverWasteTheirAreaMinusTheOutlines) {
  const std::vector<Circle> circles{{{0.5, 1}, 1.2}, {{1.5, 1}, 1.2}};
  EXPECT_NEAR(UnionOutsideArea(circles, Square(2)), UnionArea(circles) - 4.0, 1e-12);
}

}  // namespace
}  // namespace capfit::circle
