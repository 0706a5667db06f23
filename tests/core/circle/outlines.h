// Outlines for the tests of core/circle.
#ifndef CAPFIT_TESTS_CORE_CIRCLE_OUTLINES_H_
#define CAPFIT_TESTS_CORE_CIRCLE_OUTLINES_H_

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/section/feature_polygon.h"
#include "core/section/polygon.h"

namespace capfit::circle {

inline constexpr double kPi = std::numbers::pi;

inline section::Polygon MakePolygon(std::vector<Eigen::Vector2d> vertices) {
  return section::Polygon::Create(std::move(vertices)).value();
}

// Corners (0, 0) and (side, side).
inline section::Polygon Square(double side) {
  return MakePolygon({{0, 0}, {side, 0}, {side, side}, {0, side}});
}

inline section::Polygon Ellipse(double half_width, double half_depth, int count) {
  std::vector<Eigen::Vector2d> vertices;
  for (int i = 0; i < count; ++i) {
    const double a = 2.0 * kPi * i / count;
    vertices.emplace_back(half_width * std::cos(a), half_depth * std::sin(a));
  }
  return MakePolygon(std::move(vertices));
}

// Simple and star-shaped about its middle, with bays as deep as `roughness` in [0, 1) allows.
inline section::Polygon RandomStar(Random& random, int count, double roughness) {
  const Eigen::Vector2d middle(random.NextIn(-0.2, 0.2), random.NextIn(-0.2, 0.2));
  std::vector<Eigen::Vector2d> vertices;
  for (int i = 0; i < count; ++i) {
    const double a = 2.0 * kPi * (i + random.NextIn(0.0, 0.8)) / count;
    const double r = random.NextIn(1.0 - roughness, 1.0);
    vertices.push_back(middle + r * Eigen::Vector2d(std::cos(a), std::sin(a)));
  }
  return MakePolygon(std::move(vertices));
}

// A smooth lumpy outline like a section of a trunk, 0.34 m by 0.22 m or so; `lumps` up to 0.2.
// Mirrors in x = 0 exactly, vertex by vertex, with a vertex on the axis in front and back.
inline section::Polygon MirroredTrunk(Random& random, int count, double lumps) {
  const double a2 = random.NextIn(-lumps, lumps);
  const double a3 = random.NextIn(-lumps, lumps);
  const double a5 = random.NextIn(-lumps, lumps) / 2;
  std::vector<Eigen::Vector2d> right;  // from the front (+y) over x > 0 to the back
  const int half = count / 2;
  for (int i = 0; i <= half; ++i) {
    const double t = kPi * i / half;
    const double scale = 1.0 + a2 * std::cos(2 * t) + a3 * std::cos(3 * t) + a5 * std::cos(5 * t);
    right.emplace_back(i == 0 || i == half ? 0.0 : 0.17 * scale * std::sin(t),
                       0.11 * scale * std::cos(t));
  }
  std::vector<Eigen::Vector2d> vertices(right);
  for (int i = half - 1; i > 0; --i) {
    const Eigen::Vector2d& p = right[i];
    vertices.emplace_back(-p.x(), p.y());
  }
  return MakePolygon(std::move(vertices));
}

inline section::FeaturePolygon AsFeature(section::Polygon outline) {
  return section::FeaturePolygon{body::Part::kTorso, "test", 0, 0.0, {},
                                 std::move(outline), {},     -1};
}

}  // namespace capfit::circle

#endif  // CAPFIT_TESTS_CORE_CIRCLE_OUTLINES_H_
