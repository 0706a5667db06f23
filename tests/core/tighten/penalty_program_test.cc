#include "core/tighten/penalty_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/random.h"

namespace capfit::tighten {
namespace {

PenaltyProgram Free(int variables, double curvature) {
  PenaltyProgram program;
  program.gradient = Eigen::VectorXd::Zero(variables);
  program.hessian = Eigen::VectorXd::Constant(variables, curvature);
  program.lower = Eigen::VectorXd::Constant(variables, -1.0);
  program.upper = Eigen::VectorXd::Constant(variables, 1.0);
  program.batches.emplace_back();
  return program;
}

std::vector<PenaltyRow>& Rows(PenaltyProgram& program) { return program.batches.front().rows; }

Eigen::VectorXd Solve(const PenaltyProgram& program, const SolveTo& to) {
  const ThreadPool pool(1);
  return PenaltySolver(pool).Solve(program, to);
}

double Objective(const PenaltyProgram& program, const Eigen::VectorXd& d) {
  double value = program.gradient.dot(d) + 0.5 * d.dot(program.hessian.cwiseProduct(d));
  for (const PenaltyRow& row : program.batches.front().rows) {
    double excess = row.value;
    for (int k = 0; k < 8; ++k) {
      const int first = row.first[k / 4];
      if (first >= 0) excess += row.coefficients[k] * d[first + k % 4];
    }
    value += row.penalty * std::max(0.0, excess);
  }
  return value;
}

TEST(PenaltyProgramTest, WithoutRowsTheFreeMinimumWithinTheBounds) {
  PenaltyProgram program = Free(4, 2.0);
  program.gradient << 1.0, -10.0, 0.0, 0.2;
  const Eigen::VectorXd d = Solve(program, {.relative_gap = 1e-6});
  EXPECT_NEAR(d[0], -0.5, 1e-3);
  EXPECT_NEAR(d[1], 1.0, 1e-3);
  EXPECT_NEAR(d[2], 0.0, 1e-9);
  EXPECT_NEAR(d[3], -0.1, 1e-3);
}

TEST(PenaltyProgramTest, ARowHoldsWhenItsPenaltyIsWorthIt) {
  // Shrink by one per unit, but stay above -0.3.
  for (const double penalty : {0.5, 5.0}) {
    PenaltyProgram program = Free(4, 1e-3);
    program.gradient[3] = 1.0;
    PenaltyRow row;
    row.coefficients[3] = -1.0;
    row.value = -0.3;
    row.penalty = penalty;
    Rows(program).push_back(row);
    EXPECT_NEAR(Solve(program, {.relative_gap = 1e-6})[3], penalty > 1.0 ? -0.3 : -1.0, 1e-3);
  }
}

constexpr std::size_t kRows = 40;

PenaltyProgram RandomProgram(Random& random, std::size_t rows = kRows) {
  const int groups = 2 + static_cast<int>(random.NextBelow(6));
  PenaltyProgram program = Free(4 * groups, random.NextIn(0.01, 1.0));
  for (double& g : program.gradient) g = random.NextIn(-1, 1);
  for (std::size_t k = 0; k < rows; ++k) {
    PenaltyRow row;
    row.first[0] = 4 * static_cast<int>(random.NextBelow(static_cast<std::uint64_t>(groups)));
    row.first[1] = 4 * static_cast<int>(random.NextBelow(static_cast<std::uint64_t>(groups)));
    if (row.first[0] == row.first[1]) row.first[1] = -1;
    for (double& c : row.coefficients) c = random.NextIn(-1, 1);
    row.value = random.NextIn(-1.0, 0.5);
    row.penalty = random.NextIn(0.05, 3.0);
    Rows(program).push_back(row);
  }
  return program;
}

TEST(PenaltyProgramTest, NothingNearOrFarIsBetter) {
  Random random(61);
  for (int round = 0; round < 30; ++round) {
    const PenaltyProgram program = RandomProgram(random);
    const Eigen::VectorXd d = Solve(program, {.relative_gap = 1e-6});
    EXPECT_TRUE((d.array() > program.lower.array()).all());
    EXPECT_TRUE((d.array() < program.upper.array()).all());
    const double value = Objective(program, d);
    for (int trial = 0; trial < 300; ++trial) {
      const double reach = std::pow(10.0, random.NextIn(-4, 0.3));
      Eigen::VectorXd other = d;
      for (double& x : other) x = std::clamp(x + reach * random.NextIn(-1, 1), -1.0, 1.0);
      EXPECT_GE(Objective(program, other), value - 1e-4);
    }
  }
}

// In floats where so much may be left, else in doubles.
TEST(PenaltyProgramTest, LeavesNoMoreThanTheGapOfWhatItWins) {
  Random random(62);
  for (int round = 0; round < 100; ++round) {
    const PenaltyProgram program = RandomProgram(random);
    const double at_first = Objective(program, Eigen::VectorXd::Zero(program.gradient.size()));
    const double least = Objective(program, Solve(program, {.relative_gap = 1e-9}));
    for (const double gap : {0.1, 0.03, 0.01, 1e-3, 1e-5}) {
      const Eigen::VectorXd d = Solve(program, {.relative_gap = gap});
      EXPECT_TRUE((d.array() > program.lower.array()).all());
      EXPECT_TRUE((d.array() < program.upper.array()).all());
      EXPECT_LE(Objective(program, d) - least, 2.0 * gap * (at_first - least) + 1e-7);
    }
  }
}

TEST(PenaltyProgramTest, MoreIterationsLeaveLessAndAlwaysKeepTheBounds) {
  Random random(63);
  double left_by_few = 0.0;
  double left_by_many = 0.0;
  for (int round = 0; round < 100; ++round) {
    const PenaltyProgram program = RandomProgram(random);
    const double least = Objective(program, Solve(program, {.relative_gap = 1e-9}));
    for (const int iterations : {1, 3, 6, 30}) {
      const Eigen::VectorXd d = Solve(program, {.most_iterations = iterations});
      ASSERT_TRUE(d.allFinite());
      EXPECT_TRUE((d.array() > program.lower.array()).all());
      EXPECT_TRUE((d.array() < program.upper.array()).all());
      if (iterations == 3) left_by_few += Objective(program, d) - least;
      if (iterations == 6) left_by_many += Objective(program, d) - least;
    }
  }
  EXPECT_LT(left_by_many, 0.1 * left_by_few);
}

// The number of iterations does not hang on the last digits, so the result follows the rows
// smoothly.
TEST(PenaltyProgramTest, FewIterationsFollowSmallChangesOfTheRows) {
  Random random(64);
  for (int round = 0; round < 100; ++round) {
    PenaltyProgram program = RandomProgram(random);
    const Eigen::VectorXd before = Solve(program, {.most_iterations = 6});
    for (PenaltyRow& row : Rows(program)) row.value += random.NextIn(-1e-6, 1e-6);
    const Eigen::VectorXd after = Solve(program, {.most_iterations = 6});
    EXPECT_LT((after - before).cwiseAbs().maxCoeff(), 1e-3);
  }
}

// It is as near to the optimum as its products say, and reached in few iterations.
TEST(PenaltyProgramTest, APointOfTheCentralPathIsReachedAndKept) {
  Random random(65);
  for (int round = 0; round < 100; ++round) {
    const PenaltyProgram program = RandomProgram(random);
    const double least = Objective(program, Solve(program, {.relative_gap = 1e-7}));
    const double most = 2.0 * program.gradient.cwiseAbs().maxCoeff();  // bounds are 2 apart
    const auto products = 2.0 * static_cast<double>(kRows + program.gradient.size());
    for (const double share : {1e-2, 1e-4}) {
      const Eigen::VectorXd d = Solve(program, {.most_iterations = 24, .centrality = share});
      const Eigen::VectorXd on = Solve(program, {.most_iterations = 60, .centrality = share});
      EXPECT_LT((on - d).cwiseAbs().maxCoeff(), 1e-6);
      EXPECT_LE(Objective(program, d) - least, share * most * products + 1e-6);
    }
  }
}

// Twice the change of the rows changes it twice as much: there is no corner where it stops at
// another iteration or another row.
TEST(PenaltyProgramTest, APointOfTheCentralPathFollowsTheRowsSmoothly) {
  Random random(66);
  for (int round = 0; round < 100; ++round) {
    PenaltyProgram program = RandomProgram(random);
    std::vector<double> changes;
    for (std::size_t i = 0; i < kRows; ++i) {
      changes.push_back(random.NextIn(-1e-5, 1e-5));
    }
    std::array<Eigen::VectorXd, 3> at;
    for (Eigen::VectorXd& d : at) {
      d = Solve(program, {.centrality = 1e-3});
      for (std::size_t i = 0; i < changes.size(); ++i) Rows(program)[i].value += changes[i];
    }
    const double change = (at[2] - at[0]).cwiseAbs().maxCoeff();
    EXPECT_LT((at[2] - 2.0 * at[1] + at[0]).cwiseAbs().maxCoeff(), 0.01 * change + 1e-10);
  }
}

// Of several parts, which other threads may take.
TEST(PenaltyProgramTest, AnyNumberOfThreadsGivesTheSameBits) {
  Random random(67);
  const ThreadPool one(1);
  const ThreadPool two(2);
  const ThreadPool seven(7);
  for (int round = 0; round < 10; ++round) {
    const PenaltyProgram program = RandomProgram(random, 3000);
    for (const SolveTo& to :
         {SolveTo{}, SolveTo{.relative_gap = 0.03}, SolveTo{.centrality = 1e-3}}) {
      const Eigen::VectorXd expected = PenaltySolver(one).Solve(program, to);
      EXPECT_EQ(PenaltySolver(two).Solve(program, to), expected);
      EXPECT_EQ(PenaltySolver(seven).Solve(program, to), expected);
    }
  }
}

TEST(PenaltyProgramTest, ASolverForgetsTheProgrammesBefore) {
  Random random(68);
  const ThreadPool pool(1);
  PenaltySolver again(pool);
  for (int round = 0; round < 60; ++round) {
    const PenaltyProgram program = RandomProgram(random, 1 + random.NextBelow(400));
    const SolveTo to{.centrality = round % 2 == 0 ? 1e-3 : 0.0};
    EXPECT_EQ(again.Solve(program, to), PenaltySolver(pool).Solve(program, to));
  }
}

TEST(PenaltyProgramTest, BatchesAreRowsOneAfterTheOther) {
  Random random(69);
  PenaltyProgram program = RandomProgram(random);
  const Eigen::VectorXd expected = Solve(program, {.centrality = 1e-3});
  RowBatch& first = program.batches.front();
  RowBatch rest{{first.rows.begin() + 17, first.rows.end()}, 0.5};
  for (PenaltyRow& row : rest.rows) row.penalty *= 2.0;
  first.rows.resize(17);
  program.batches.insert(program.batches.end(), {RowBatch{}, std::move(rest)});
  EXPECT_EQ(Solve(program, {.centrality = 1e-3}), expected);
}

}  // namespace
}  // namespace capfit::tighten
