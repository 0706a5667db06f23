#include "core/section/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace capfit::section {
namespace {

TEST(PolygonTest, MeasuresARectangle) {
  const Polygon p = Polygon::Create({{1, 1}, {4, 1}, {4, 3}, {1, 3}}).value();
  EXPECT_DOUBLE_EQ(p.area_m2(), 6.0);
  EXPECT_NEAR((p.Centroid() - Eigen::Vector2d(2.5, 2)).norm(), 0.0, 1e-15);
}

TEST(PolygonTest, TurnsClockwiseInputRound) {
  const Polygon p = Polygon::Create({{0, 1}, {1, 1}, {1, 0}, {0, 0}}).value();
  EXPECT_DOUBLE_EQ(p.area_m2(), 1.0);
  const auto v = p.vertices();
  EXPECT_GT((v[1] - v[0]).x() * (v[2] - v[1]).y() - (v[1] - v[0]).y() * (v[2] - v[1]).x(), 0.0);
}

TEST(PolygonTest, KeepsDigitsFarFromTheOrigin) {
  const double far = 1e6;
  const Polygon p =
      Polygon::Create({{far, far}, {far + 1, far}, {far + 1, far + 1}, {far, far + 1}}).value();
  EXPECT_NEAR(p.area_m2(), 1.0, 1e-12);
  EXPECT_NEAR(p.Centroid().x(), far + 0.5, 1e-9);
}

TEST(PolygonTest, ContainsByWinding) {
  const Polygon bay = Polygon::Create({{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}}).value();
  EXPECT_TRUE(bay.Contains({0.5, 1.0}));
  EXPECT_TRUE(bay.Contains({2.0, 0.9}));
  EXPECT_FALSE(bay.Contains({2.0, 1.1}));
  EXPECT_FALSE(bay.Contains({-0.1, 0.5}));
  EXPECT_FALSE(bay.Contains({5.0, 0.0}));
}

TEST(PolygonTest, RefusesWhatIsNoPolygonAndSaysWhy) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](std::vector<Eigen::Vector2d> v) {
    const auto result = Polygon::Create(std::move(v));
    EXPECT_EQ(result.status().code(), absl::StatusCode::kInvalidArgument);
    return std::string(result.status().message());
  };
  EXPECT_NE(message({{0, 0}, {1, 0}}).find("has 2 vertices, needs at least 3"), std::string::npos);
  EXPECT_NE(message({{0, 0}, {1, nan}, {1, 1}}).find("polygon[1]"), std::string::npos);
  EXPECT_NE(message({{0, 0}, {1, 1}, {2, 2}}).find("no area"), std::string::npos);
}

}  // namespace
}  // namespace capfit::section
