#include "core/capsule/point_clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/random.h"

namespace capfit::capsule {
namespace {

using Vec3 = Eigen::Vector3d;
using Points = std::vector<Vec3>;

const Vec3 kNoPlane = Vec3::Zero();

Points PointsIn(const Vec3& low, const Vec3& high, int count, std::uint64_t seed) {
  Random random(seed);
  Points points;
  for (int i = 0; i < count; ++i) {
    const Vec3 share(random.NextUnit(), random.NextUnit(), random.NextUnit());
    points.push_back(low + share.cwiseProduct(high - low));
  }
  return points;
}

// A palm, four fingers side by side and a thumb aside, in metres.
Points Hand() {
  Points points = PointsIn({0.0, 0.0, 0.0}, {0.08, 0.08, 0.02}, 400, 1);
  for (int finger = 0; finger < 4; ++finger) {
    const double x = 0.02 * finger;
    const Points more = PointsIn({x, 0.08, 0.0}, {x + 0.015, 0.16, 0.015}, 200, 2 + finger);
    points.insert(points.end(), more.begin(), more.end());
  }
  const Points thumb = PointsIn({-0.06, 0.03, 0.0}, {0.0, 0.045, 0.015}, 200, 9);
  points.insert(points.end(), thumb.begin(), thumb.end());
  return points;
}

double LargestRadius(const std::vector<PointCluster>& clusters) {
  double radius = 0.0;
  for (const PointCluster& cluster : clusters) radius = std::max(radius, cluster.ball.radius_m);
  return radius;
}

bool IsLess(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

TEST(ClustersOfTest, EveryPointIsInOne) {
  Points hand = Hand();
  for (const int count : {1, 2, 5, 8}) {
    const std::vector<PointCluster> clusters = ClustersOf(hand, count, kNoPlane);
    EXPECT_EQ(static_cast<int>(clusters.size()), count);
    Points all;
    for (const auto& [points, ball] : clusters) {
      all.insert(all.end(), points.begin(), points.end());
      for (const Vec3& p : points) EXPECT_LE((p - ball.center_m).norm(), ball.radius_m + 1e-12);
    }
    std::sort(all.begin(), all.end(), IsLess);
    std::sort(hand.begin(), hand.end(), IsLess);
    EXPECT_EQ(all, hand);
  }
}

// Eight slices along the hand would each have balls as wide as its four fingers.
TEST(ClustersOfTest, FingersLieBesideEachOther) {
  const std::vector<PointCluster> clusters = ClustersOf(Hand(), 8, kNoPlane);
  EXPECT_LT(LargestRadius(clusters), 0.036);
  int thumbs = 0;
  for (const auto& [points, ball] : clusters) {
    thumbs += std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.x() < 0; });
  }
  EXPECT_GE(thumbs, 1);
}

// A mean would be drawn to the many points at one end.
TEST(ClustersOfTest, PointsCloseTogetherDrawNoCentreToThem) {
  Points points = PointsIn({0.0, 0.0, 0.0}, {1.0, 0.1, 0.1}, 500, 3);
  const Points dense = PointsIn({0.0, 0.0, 0.0}, {0.05, 0.1, 0.1}, 2000, 4);
  points.insert(points.end(), dense.begin(), dense.end());
  const std::vector<PointCluster> clusters = ClustersOf(points, 2, kNoPlane);
  ASSERT_EQ(clusters.size(), 2u);
  std::vector<double> centers = {clusters[0].ball.center_m.x(), clusters[1].ball.center_m.x()};
  std::sort(centers.begin(), centers.end());
  EXPECT_NEAR(centers[0], 0.25, 0.02);
  EXPECT_NEAR(centers[1], 0.75, 0.02);
}

TEST(ClustersOfTest, InAPlaneNothingIsPartedAcrossIt) {
  const Points wide = PointsIn({-1.0, 0.0, 0.0}, {1.0, 0.5, 0.1}, 500, 3);
  for (const auto& [points, ball] : ClustersOf(wide, 2, Vec3::UnitX())) {
    EXPECT_EQ(ball.center_m.x(), 0.0);
    const auto [left, right] = std::minmax_element(
        points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
    EXPECT_LT(left->x(), -0.9);
    EXPECT_GT(right->x(), 0.9);
  }
}

TEST(ClustersOfTest, FewDistinctPointsGiveFewClusters) {
  EXPECT_TRUE(ClustersOf({}, 3, kNoPlane).empty());
  const Points twice = {Vec3::Zero(), Vec3::Zero(), Vec3::UnitY(), Vec3::UnitY()};
  const std::vector<PointCluster> clusters = ClustersOf(twice, 5, kNoPlane);
  ASSERT_EQ(clusters.size(), 2u);
  EXPECT_EQ(clusters[0].points_m.size(), 2u);
}

}  // namespace
}  // namespace capfit::capsule
