#include "core/skinning/linear_precision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/base/random.h"

namespace capfit::skinning {
namespace {

using Eigen::Vector3d;

double Sum(const std::vector<float>& row) { return std::accumulate(row.begin(), row.end(), 0.0); }

TEST(MendFloatSumTest, SumsToOneForRowsOfAnySize) {
  Random random(1);
  for (const std::size_t count : {1, 2, 3, 8, 100, 1000, 50'000}) {
    std::vector<double> exact(count);
    double sum = 0.0;
    for (double& w : exact) {
      w = random.NextUnit() - (count > 3 ? 0.02 : 0.0);
      sum += w;
    }
    std::vector<float> row(count);
    for (std::size_t i = 0; i < count; ++i) row[i] = static_cast<float>(exact[i] / sum);
    const std::vector<float> before = row;
    MendFloatSum(row);
    EXPECT_NEAR(Sum(row), 1.0, 1e-10) << count;
    for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR(row[i], before[i], 1.3e-7) << count;
  }
}

TEST(MendFloatSumTest, KeepsZeroes) {
  std::vector<float> row = {0.0f, 0.3f, 0.0f, 0.7000001f, 0.0f};
  MendFloatSum(row);
  EXPECT_EQ(row[0], 0.0f);
  EXPECT_EQ(row[2], 0.0f);
  EXPECT_EQ(row[4], 0.0f);
  EXPECT_EQ(Sum(row), 1.0);
}

TEST(MendFloatSumTest, LargeWeightsOfBothSignsCancelExactly) {
  std::vector<float> row = {9.7f, -8.1f, -0.6000003f};
  MendFloatSum(row);
  EXPECT_EQ(Sum(row), 1.0);
}

TEST(MakeLinearlyPreciseTest, MendsWrongWeightsAndChangesGoodOnesLittle) {
  Random random(2);
  std::vector<Vector3d> vertices;
  std::vector<Lanes> weights;
  std::array<Vector3d, kLanes> centers;
  for (Vector3d& c : centers) {
    c = {random.NextIn(-0.2, 0.2), random.NextIn(-0.2, 0.2), random.NextIn(-0.2, 0.2)};
  }
  for (int i = 0; i < 300; ++i) {
    vertices.emplace_back(random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(-1, 1));
    weights.push_back(Lanes::Constant(random.NextIn(-0.05, 1)));
  }
  weights[7] = Lanes::Zero();
  MakeLinearlyPrecise(vertices, centers, weights);
  for (int lane = 0; lane < kLanes; ++lane) {
    double sum = 0.0;
    Vector3d mean = Vector3d::Zero();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      sum += weights[i][lane];
      mean += weights[i][lane] * vertices[i];
    }
    EXPECT_NEAR(sum, 1.0, 1e-13);
    EXPECT_LE((mean - centers[lane]).norm(), 1e-13);
    EXPECT_EQ(weights[7][lane], 0.0);
  }
  const std::vector<Lanes> good = weights;
  MakeLinearlyPrecise(vertices, centers, weights);
  for (std::size_t i = 0; i < good.size(); ++i) {
    EXPECT_LE((weights[i] - good[i]).abs().maxCoeff(), 1e-14);
  }
}

TEST(MakeLinearlyPreciseTest, WeightsThatSumToNothingStillGiveAnAnswer) {
  const std::vector<Vector3d> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Lanes> weights = {Lanes::Constant(1), Lanes::Constant(-1), Lanes::Constant(1),
                                Lanes::Constant(-1)};
  std::array<Vector3d, kLanes> centers;
  centers.fill({0.1, 0.2, 0.3});
  MakeLinearlyPrecise(vertices, centers, weights);
  EXPECT_NEAR(weights[0][0], 0.4, 1e-12);
  EXPECT_NEAR(weights[3][0], 0.3, 1e-12);
}

}  // namespace
}  // namespace capfit::skinning
