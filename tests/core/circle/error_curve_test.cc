#include "core/circle/error_curve.h"

#include <gtest/gtest.h>

#include "tests/core/circle/outlines.h"

namespace capfit::circle {
namespace {

const NullObserver kSilent;

// A trunk polygon that is its own image, and two limbs that are each other's.
std::vector<section::FeaturePolygon> ThreePolygons() {
  Random random(91);
  std::vector<section::FeaturePolygon> polygons;
  polygons.push_back(AsFeature(MirroredTrunk(random, 64, 0.1)));
  polygons.push_back(AsFeature(RandomStar(random, 40, 0.3)));
  std::vector<Eigen::Vector2d> image;
  for (const Eigen::Vector2d& v : polygons[1].outline.vertices()) image.emplace_back(-v.x(), v.y());
  polygons.push_back(AsFeature(MakePolygon(image)));
  polygons[0].mirror = 0;
  polygons[1].mirror = 2;
  polygons[2].mirror = 1;
  return polygons;
}

TEST(ErrorCurvesTest, BestAreaNeverRises) {
  const auto polygons = ThreePolygons();
  const ThreadPool pool(1);
  const ErrorCurves curves(polygons, 6, {}, pool, kSilent);
  for (int p = 0; p < 3; ++p) {
    for (int c = 1; c < 6; ++c) EXPECT_LE(curves.BestAreaM2(p, c + 1), curves.BestAreaM2(p, c));
    EXPECT_LT(curves.BestAreaM2(p, 6), 0.8 * curves.BestAreaM2(p, 1));
  }
}

TEST(ErrorCurvesTest, ImagesMirrorToTheBit) {
  const auto polygons = ThreePolygons();
  const ThreadPool pool(2);
  const ErrorCurves curves(polygons, 4, {}, pool, kSilent);
  for (int c = 1; c <= 4; ++c) {
    const PolygonApproximation& left = curves.Approximation(1, c);
    const PolygonApproximation& right = curves.Approximation(2, c);
    ASSERT_EQ(left.circles.size(), right.circles.size());
    for (std::size_t i = 0; i < left.circles.size(); ++i) {
      const Circle& other = right.circles[right.circles.size() - 1 - i];
      EXPECT_EQ(left.circles[i].center_m.x(), -other.center_m.x());
      EXPECT_EQ(left.circles[i].center_m.y(), other.center_m.y());
      EXPECT_EQ(left.circles[i].radius_m, other.radius_m);
    }
  }
}

TEST(ErrorCurvesTest, SameBitsForAnyThreadsAndOrder) {
  const auto polygons = ThreePolygons();
  const ThreadPool one(1);
  const ErrorCurves alone(polygons, 5, {}, one, kSilent);
  for (const int threads : {1, 2, 7}) {
    const ThreadPool pool(threads);
    const ErrorCurves curves(polygons, 5, {}, pool, kSilent);
    curves.Prepare(5);
    for (int p = 2; p >= 0; --p) {
      for (int c = 5; c >= 1; --c) {
        const PolygonApproximation& a = alone.Approximation(p, c);
        const PolygonApproximation& b = curves.Approximation(p, c);
        ASSERT_EQ(a.circles.size(), b.circles.size());
        for (std::size_t i = 0; i < a.circles.size(); ++i) {
          EXPECT_EQ(a.circles[i].center_m, b.circles[i].center_m);
          EXPECT_EQ(a.circles[i].radius_m, b.circles[i].radius_m);
        }
      }
    }
  }
}

TEST(ErrorCurvesTest, PreparedCountsAreWhatIsAskedForLater) {
  const auto polygons = ThreePolygons();
  const ThreadPool pool(2);
  const ErrorCurves alone(polygons, 5, {}, pool, kSilent);
  const ErrorCurves prepared(polygons, 5, {}, pool, kSilent);
  const std::vector<int> counts = {4, 2, 2};
  prepared.Prepare(counts);
  for (int p = 0; p < 3; ++p) {
    EXPECT_EQ(prepared.Approximation(p, counts[p]).outside_area_m2,
              alone.Approximation(p, counts[p]).outside_area_m2);
  }
}

}  // namespace
}  // namespace capfit::circle
