#include "core/tighten/sparse_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/base/random.h"

namespace capfit::tighten {
namespace {

using Vec3 = Eigen::Vector3d;

std::vector<Vec3> PointsOnBall(double radius_m, int count) {
  Random random(5);
  std::vector<Vec3> points;
  while (static_cast<int>(points.size()) < count) {
    const Vec3 p(random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(-1, 1));
    if (p.norm() < 1.0 && p.norm() > 0.1) points.push_back(radius_m * p.normalized());
  }
  return points;
}

double SumOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(SparsePointsTest, AreFewerAndLieJustInsideOfABall) {
  const std::vector<Vec3> points = PointsOnBall(0.1, 20000);
  const std::vector<double> weights(points.size(), 0.5);
  const SparsePoints sparse = MakeSparse(points, weights, 0.02);
  ASSERT_EQ(sparse.points_m.size(), sparse.weights.size());
  EXPECT_LT(sparse.points_m.size(), 1500u);
  EXPECT_GT(sparse.points_m.size(), 300u);
  EXPECT_NEAR(SumOf(sparse.weights), 10000.0, 1e-6);
  for (const Vec3& p : sparse.points_m) {
    EXPECT_LE(p.norm(), 0.1 + 1e-12);
    EXPECT_GT(p.norm(), 0.098);
  }
}

// No choice is made on the way: points that move by a micrometre take the sparse ones along, and
// leave their number alone, even where they cross from one cell into the next.
TEST(SparsePointsTest, FollowTheirPointsSmoothly) {
  std::vector<Vec3> points = PointsOnBall(0.1, 20000);
  for (int i = 0; i < 200; ++i) {  // on the border of cells
    points[i].x() = 0.02 * (i % 5 - 2);
  }
  const std::vector<double> weights(points.size(), 1.0);
  const SparsePoints before = MakeSparse(points, weights, 0.02);
  constexpr double kMove = 1e-6;
  Random random(7);
  for (Vec3& p : points) p += kMove * Vec3(random.NextUnit(), random.NextUnit(), random.NextUnit());
  const SparsePoints after = MakeSparse(points, weights, 0.02);
  // A node that had no weight yet may appear, with next to none.
  EXPECT_LE(after.points_m.size() - before.points_m.size(), 60u);
  int followed = 0;
  for (std::size_t i = 0; i < after.points_m.size(); ++i) {
    if (after.weights[i] < 0.5) continue;
    double least = 1.0;
    for (const Vec3& p : before.points_m) least = std::min(least, (p - after.points_m[i]).norm());
    EXPECT_LT(least, 100 * kMove);
    ++followed;
  }
  EXPECT_GT(followed, 300);
}

TEST(SparsePointsTest, OfMirroredPointsAreMirrored) {
  const std::vector<Vec3> points = PointsOnBall(0.1, 500);
  std::vector<Vec3> images = points;
  for (Vec3& p : images) p.x() = -p.x();
  const std::vector<double> weights(points.size(), 1.0);
  const SparsePoints here = MakeSparse(points, weights, 0.03);
  const SparsePoints there = MakeSparse(images, weights, 0.03);
  ASSERT_EQ(here.points_m.size(), there.points_m.size());
  for (const Vec3& p : here.points_m) {
    const Vec3 image(-p.x(), p.y(), p.z());
    EXPECT_TRUE(std::any_of(there.points_m.begin(), there.points_m.end(),
                            [&](const Vec3& q) { return (q - image).norm() < 1e-12; }));
  }
}

TEST(SparsePointsTest, OfNothingAreNone) { EXPECT_TRUE(MakeSparse({}, {}, 0.01).points_m.empty()); }

}  // namespace
}  // namespace capfit::tighten
