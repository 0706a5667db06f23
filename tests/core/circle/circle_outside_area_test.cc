#include "core/circle/circle_outside_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/core/circle/outlines.h"

namespace capfit::circle {
namespace {

struct Case {
  std::string name;
  Circle circle;
  double expected_m2;
  friend void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }
};
class CircleOutsideAreaTest : public testing::TestWithParam<Case> {};

TEST_P(CircleOutsideAreaTest, MatchesClosedFormOnTwoMetreSquare) {
  EXPECT_NEAR(CircleOutsideArea(GetParam().circle, Square(2)), GetParam().expected_m2, 1e-12);
}

// Part of the unit circle beyond a chord at distance d from its centre.
double Segment(double d) { return std::acos(d) - d * std::sqrt(1.0 - d * d); }

INSTANTIATE_TEST_SUITE_P(
    ClosedForm, CircleOutsideAreaTest,
    testing::Values(Case{"WhollyInside", {{1, 1}, 0.5}, 0.0},
                    Case{"TouchesFromInside", {{1, 1}, 1.0}, 0.0},
                    Case{"CentredOnEdge", {{1, 0}, 0.5}, kPi / 8},
                    Case{"CentredOnCorner", {{0, 0}, 1.0}, 0.75 * kPi},
                    Case{"CoversSquare", {{1, 1}, 2.0}, 4 * kPi - 4},
                    Case{"WhollyOutside", {{4, 1}, 1.0}, kPi},
                    Case{"OutsideCentre", {{2.5, 1}, 1.0}, kPi - Segment(0.5)},
                    Case{"InsideCentre", {{1.5, 1}, 1.0}, Segment(0.5)},
                    Case{"OutsideButCovers", {{-1, 1}, 9.0}, 81 * kPi - 4},
                    Case{"BulgesOverAllEdges", {{1, 1}, 1.25}, 4 * 1.5625 * Segment(0.8)},
                    Case{"Point", {{0, 0}, 0.0}, 0.0}),
    [](const auto& scene) { return scene.param.name; });

double ByGrid(const Circle& circle, const section::Polygon& outline, int cells) {
  const double h = 2.0 * circle.radius_m / cells;
  int outside = 0;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const Eigen::Vector2d offset((i + 0.5) * h - circle.radius_m,
                                   (j + 0.5) * h - circle.radius_m);
      if (offset.norm() < circle.radius_m && !outline.Contains(circle.center_m + offset)) ++outside;
    }
  }
  return outside * h * h;
}

TEST(CircleOutsideAreaProperty, AgreesWithCountingCells) {
  Random random(11);
  for (int scene = 0; scene < 60; ++scene) {
    const section::Polygon outline = RandomStar(random, 3 + scene % 17, 0.9);
    const Circle circle{{random.NextIn(-1.2, 1.2), random.NextIn(-1.2, 1.2)},
                        random.NextIn(0.05, 1.5)};
    const double expected = ByGrid(circle, outline, 400);
    // A cell counts wrongly only where a boundary passes: about 12 r cells' widths of it.
    const double tolerance = 0.02 * circle.radius_m * (circle.radius_m + 1.0);
    EXPECT_NEAR(CircleOutsideArea(circle, outline), expected, tolerance) << "scene " << scene;
  }
}

TEST(CircleOutsideAreaProperty, GradientMatchesDifferences) {
  Random random(12);
  const double h = 1e-5;
  for (int scene = 0; scene < 300; ++scene) {
    const section::Polygon outline = RandomStar(random, 5 + scene % 40, 0.7);
    const Circle c{{random.NextIn(-1.2, 1.2), random.NextIn(-1.2, 1.2)}, random.NextIn(0.1, 1.4)};
    const OutsideArea area = CircleOutsideAreaWithGradient(c, outline);
    const auto at = [&](double dx, double dy, double dr) {
      return CircleOutsideArea({c.center_m + Eigen::Vector2d(dx, dy), c.radius_m + dr}, outline);
    };
    EXPECT_NEAR(area.by_center_m.x(), (at(h, 0, 0) - at(-h, 0, 0)) / (2 * h), 1e-6) << scene;
    EXPECT_NEAR(area.by_center_m.y(), (at(0, h, 0) - at(0, -h, 0)) / (2 * h), 1e-6) << scene;
    EXPECT_NEAR(area.by_radius_m, (at(0, 0, h) - at(0, 0, -h)) / (2 * h), 1e-6) << scene;
  }
}

TEST(CircleOutsideAreaProperty, MovingTurningMirroringAndScalingTheSceneScalesTheArea) {
  Random random(13);
  for (int scene = 0; scene < 200; ++scene) {
    const section::Polygon outline = RandomStar(random, 4 + scene % 30, 0.6);
    const Circle c{{random.NextIn(-1, 1), random.NextIn(-1, 1)}, random.NextIn(0.1, 1.4)};
    const double angle = random.NextIn(-kPi, kPi);
    const double scale = random.NextIn(0.01, 100.0);
    const double flip = scene % 2 == 0 ? 1.0 : -1.0;
    const Eigen::Vector2d shift(random.NextIn(-5, 5), random.NextIn(-5, 5));
    const auto move = [&](const Eigen::Vector2d& p) -> Eigen::Vector2d {
      return scale *
             (shift + Eigen::Vector2d(flip * (std::cos(angle) * p.x() - std::sin(angle) * p.y()),
                                      std::sin(angle) * p.x() + std::cos(angle) * p.y()));
    };
    std::vector<Eigen::Vector2d> moved;
    for (const Eigen::Vector2d& v : outline.vertices()) moved.push_back(move(v));
    const double expected = scale * scale * CircleOutsideArea(c, outline);
    EXPECT_NEAR(CircleOutsideArea({move(c.center_m), scale * c.radius_m}, MakePolygon(moved)),
                expected, 1e-11 * scale * scale);
  }
}

TEST(CircleOutsideAreaProperty, RisesWithTheRadiusAndStaysInRange) {
  Random random(14);
  for (int scene = 0; scene < 50; ++scene) {
    const section::Polygon outline = RandomStar(random, 24, 0.8);
    const Eigen::Vector2d center(random.NextIn(-1, 1), random.NextIn(-1, 1));
    double before = 0.0;
    for (double r = 0.01; r < 2.0; r += 0.01) {
      const double area = CircleOutsideArea({center, r}, outline);
      EXPECT_GE(area, before - 1e-14);
      EXPECT_LE(area, kPi * r * r + 1e-14);
      EXPECT_GE(area, kPi * r * r - outline.area_m2() - 1e-12);
      before = area;
    }
  }
}

// Vertices exactly on the circle, edges through the centre, an edge along the negative x axis:
// where arc tangents and clipping are most easily wrong.
TEST(CircleOutsideAreaProperty, SpecialPositionsAgreeWithTheirNeighbours) {
  const section::Polygon diamond = MakePolygon({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
  const section::Polygon wedge = MakePolygon({{0, 0}, {-2, 0}, {-2, -2}, {1, -1}});
  for (const section::Polygon* outline : {&diamond, &wedge}) {
    for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      for (const double r : {0.5, 1.0, 2.0}) {
        const double exact = CircleOutsideArea({{x, 0.0}, r}, *outline);
        EXPECT_NEAR(CircleOutsideArea({{x + 1e-9, 1e-9}, r}, *outline), exact, 1e-7);
        EXPECT_NEAR(CircleOutsideArea({{x - 1e-9, -1e-9}, r - 1e-9}, *outline), exact, 1e-7);
      }
    }
  }
}

}  // namespace
}  // namespace capfit::circle
