#include "core/refine/interior_point.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"

namespace capfit::refine {
namespace {

StepProblem RandomProblem(int blocks, int rows, std::uint64_t seed) {
  Random random(seed);
  StepProblem p;
  const auto fill = [&](Eigen::VectorXd& v, Eigen::Index n, double low, double high) {
    v.resize(n);
    for (double& x : v) x = random.NextIn(low, high);
  };
  fill(p.gradient, 4 * blocks, -1.0, 2.0);
  fill(p.curvature, 4 * blocks, 0.1, 2.0);
  fill(p.low, 4 * blocks, -0.5, -0.2);
  fill(p.high, 4 * blocks, 0.2, 0.5);
  fill(p.offsets, rows, -0.3, 0.3);
  p.coefficients.resize(rows, 8);
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < 8; ++k) p.coefficients(i, k) = random.NextIn(-1.0, 0.3);
  }
  for (int begin = 0; begin < rows; begin += 5) {
    const int a = static_cast<int>(random.NextBelow(static_cast<std::uint64_t>(blocks)));
    const int b = static_cast<int>(random.NextBelow(static_cast<std::uint64_t>(blocks)));
    p.groups.push_back({begin, std::min(rows, begin + 5), a, b});
  }
  p.penalty = 3.0;
  return p;
}

double ObjectiveAt(const StepProblem& p, const Eigen::VectorXd& d) {
  double value = p.gradient.dot(d) + 0.5 * d.dot(p.curvature.cwiseProduct(d));
  for (const RowGroup& g : p.groups) {
    for (int i = g.begin; i < g.end; ++i) {
      const double row = p.coefficients.row(i).head<4>().dot(d.segment<4>(4 * g.block_a)) +
                         p.coefficients.row(i).tail<4>().dot(d.segment<4>(4 * g.block_b)) +
                         p.offsets[i];
      value += p.penalty * std::max(0.0, row);
    }
  }
  return value;
}

TEST(InteriorPointTest, NoPointNearbyOrFarIsBetter) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const StepProblem p = RandomProblem(4, 60, seed);
    const StepSolution s = SolveStep(p, 1e-7, 80);
    EXPECT_TRUE((s.step.array() >= p.low.array()).all());
    EXPECT_TRUE((s.step.array() <= p.high.array()).all());
    const double best = ObjectiveAt(p, s.step);
    EXPECT_NEAR(s.predicted_change, best - ObjectiveAt(p, Eigen::VectorXd::Zero(16)), 1e-9);
    Random random(seed);
    for (int i = 0; i < 2000; ++i) {
      const double reach = i % 2 == 0 ? 1.0 : 0.01;
      Eigen::VectorXd d = s.step;
      for (double& x : d) x += random.NextIn(-reach, reach);
      d = d.cwiseMax(p.low).cwiseMin(p.high);
      EXPECT_GE(ObjectiveAt(p, d), best - 1e-5);
    }
  }
}

TEST(InteriorPointTest, PricesLieBetweenZeroAndThePenalty) {
  const StepProblem p = RandomProblem(5, 80, 7);
  const StepSolution s = SolveStep(p, 1e-6, 60);
  EXPECT_GE(s.prices.minCoeff(), 0.0);
  EXPECT_LE(s.prices.maxCoeff(), p.penalty);
}

TEST(InteriorPointTest, WithoutRowsItRunsDownTheGradient) {
  StepProblem p = RandomProblem(2, 0, 9);
  p.groups.clear();
  const StepSolution s = SolveStep(p, 1e-7, 80);
  for (Eigen::Index k = 0; k < s.step.size(); ++k) {
    const double free = -p.gradient[k] / p.curvature[k];
    EXPECT_NEAR(s.step[k], std::clamp(free, p.low[k], p.high[k]), 1e-4);
  }
}

TEST(InteriorPointTest, FixedEndsAreAllowed) {
  StepProblem p = RandomProblem(3, 30, 5);
  p.groups[0].block_a = -1;
  p.coefficients.topRows(5).leftCols(4).setZero();
  EXPECT_LE(SolveStep(p, 1e-5, 60).predicted_change, 0.0);
}

}  // namespace
}  // namespace capfit::refine
