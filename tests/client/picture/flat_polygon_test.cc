#include "client/picture/flat_polygon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace capfit::client {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// An ellipse with half axes 0.2 along `a` and 0.1 along `b`, with a circle towards `b`.
ResultPolygon Ellipse(const std::string& part, const Vector3d& middle, const Vector3d& a,
                      const Vector3d& b) {
  ResultPolygon polygon;
  polygon.name = part;
  polygon.part = part;
  polygon.outside_area_ratio = 0.25;
  for (int i = 0; i < 40; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 40;
    polygon.outline.emplace_back(middle + 0.2 * std::cos(t) * a + 0.1 * std::sin(t) * b);
  }
  polygon.circles.push_back({middle + 0.05 * b, 0.08});
  return polygon;
}

const Vector3d kLeft = Vector3d::UnitX();
const Vector3d kUp = Vector3d::UnitY();
const Vector3d kFront = Vector3d::UnitZ();

// Where a direction of the body points on the sheet.
Vector2d OnSheet(const FlatPolygon& polygon, const Vector3d& direction) {
  return {direction.dot(polygon.frame.x_axis), direction.dot(polygon.frame.y_axis)};
}

TEST(FlattenTest, TorsoIsSeenFromAboveFrontDownLeftToTheRight) {
  // Either order of the outline's points.
  for (const Vector3d& b : {kFront, Vector3d(-kFront)}) {
    const auto flat =
        Flatten({Ellipse("torso", {0, 1, 0}, kLeft, b), Ellipse("torso", {0, 1.2, 0}, kLeft, b)},
                Matrix3d::Identity());
    ASSERT_EQ(flat.size(), 2u);
    for (const FlatPolygon& polygon : flat) {
      EXPECT_TRUE(OnSheet(polygon, kLeft).isApprox(Vector2d(1, 0), 1e-9));
      EXPECT_TRUE(OnSheet(polygon, kFront).isApprox(Vector2d(0, -1), 1e-9));
    }
  }
}

TEST(FlattenTest, LevelArmsAreSeenAsIfTheyHungAndMirrorEachOther) {
  const auto arm = [](const std::string& part, double side) {
    return std::vector<ResultPolygon>{Ellipse(part, {0.3 * side, 1.4, 0}, kUp, kFront),
                                      Ellipse(part, {0.6 * side, 1.4, 0}, kUp, kFront)};
  };
  const auto left = Flatten(arm("left_arm", 1.0), Matrix3d::Identity());
  const auto right = Flatten(arm("right_arm", -1.0), Matrix3d::Identity());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(OnSheet(left[i], kFront).isApprox(Vector2d(0, -1), 1e-9));
    EXPECT_TRUE(OnSheet(right[i], kFront).isApprox(Vector2d(0, -1), 1e-9));
    // What is on top of a level arm is on its outer side when it hangs.
    EXPECT_TRUE(OnSheet(left[i], kUp).isApprox(Vector2d(1, 0), 1e-9));
    EXPECT_TRUE(OnSheet(right[i], kUp).isApprox(Vector2d(-1, 0), 1e-9));
  }
  // A single cut tells its upper side by its side of the body.
  EXPECT_TRUE(OnSheet(Flatten({arm("left_arm", 1.0)[0]}, Matrix3d::Identity())[0], kUp)
                  .isApprox(Vector2d(1, 0), 1e-9));
}

TEST(FlattenTest, LengthsStayAndAllAxesAreTurnedUpright) {
  const Matrix3d from_body = Eigen::AngleAxisd(2.1, Vector3d(1, 2, -1).normalized()).matrix();
  std::vector<ResultPolygon> cuts = {Ellipse("left_leg", {0.1, 0.9, 0}, kLeft, kFront),
                                     Ellipse("left_leg", {0.15, 0.5, 0.05}, kLeft, kFront)};
  const auto upright = Flatten(cuts, Matrix3d::Identity());
  for (ResultPolygon& cut : cuts) {
    for (Vector3d& p : cut.outline) p = from_body * p;
    for (geometry::Sphere& circle : cut.circles) circle.center_m = from_body * circle.center_m;
  }
  const auto turned = Flatten(cuts, from_body.transpose());
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    EXPECT_EQ(turned[i].circles[0].radius, 0.08);
    EXPECT_TRUE(turned[i].circles[0].center.isApprox(Vector2d(0, -0.05), 1e-9));
    for (std::size_t k = 0; k < turned[i].outline.size(); ++k) {
      ASSERT_LT((turned[i].outline[k] - upright[i].outline[k]).norm(), 1e-9);
      ASSERT_NEAR((turned[i].outline[k] - turned[i].outline[0]).norm(),
                  (cuts[i].outline[k] - cuts[i].outline[0]).norm(), 1e-9);
    }
  }
}

TEST(CurvesTest, LieWhereTheResultHasThem) {
  const ResultPolygon cut = Ellipse("torso", {0.02, 1.1, 0.03}, kLeft, kFront);
  const auto curves = CurvesOf(Flatten({cut}, Matrix3d::Identity()));
  ASSERT_EQ(curves.size(), 2u);
  EXPECT_FALSE(curves[0].is_outline);
  EXPECT_EQ(curves[0].color, PartColor("torso", 0.5));
  for (const Vector3d& p : curves[0].points) {
    EXPECT_NEAR((p - cut.circles[0].center_m).norm(), 0.08, 1e-9);
    EXPECT_NEAR(p.y(), 1.1, 1e-9);
  }
  EXPECT_TRUE(curves[1].is_outline);
  for (std::size_t i = 0; i < cut.outline.size(); ++i) {
    EXPECT_LT((curves[1].points[i] - cut.outline[i]).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace capfit::client
