#include "core/tighten/normal_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <utility>
#include <vector>

#include "core/base/random.h"

namespace capfit::tighten {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

Eigen::Matrix4d RandomBlock(Random& random) {
  Eigen::Matrix4d block;
  for (double& x : block.reshaped()) x = random.NextIn(-1.0, 1.0);
  return block;
}

// The same values in a NormalMatrix and in a full one: products of random rows as the programme's.
struct Twins {
  Twins(int groups, const Pairs& ties, Random& random)
      : blocks(4 * groups, ties), full(Eigen::MatrixXd::Zero(4 * groups, 4 * groups)) {
    const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(4 * groups, 0.1);
    blocks.Reset(diagonal);
    full.diagonal() = diagonal;
    for (const auto& [a, b] : ties) AddTie(a, b, random);
  }

  void AddTie(int a, int b, Random& random) {
    const Eigen::Matrix4d left = RandomBlock(random);
    const Eigen::Matrix4d right = RandomBlock(random);
    Add(a, a, left.transpose() * left);
    Add(b, b, right.transpose() * right);
    Add(b, a, right.transpose() * left);
    full.block<4, 4>(a, b) += left.transpose() * right;
  }

  void Add(int row, int column, const Eigen::Matrix4d& values) {
    blocks.Add(blocks.PlaceOf(row, column), values);
    full.block<4, 4>(row, column) += values;
  }

  NormalMatrix blocks;
  Eigen::MatrixXd full;
};

void ExpectSameSolution(int groups, const Pairs& ties, Random& random) {
  Twins twins(groups, ties, random);
  Eigen::VectorXd right(4 * groups);
  for (double& x : right) x = random.NextIn(-1.0, 1.0);
  twins.blocks.Factorise();
  const Eigen::VectorXd solution = twins.blocks.Solve(right);
  EXPECT_LT((twins.full * solution - right).norm(), 1e-9 * right.norm());
  // Values are added anew after a reset.
  twins.blocks.Reset(Eigen::VectorXd::Constant(4 * groups, 2.0));
  twins.blocks.Factorise();
  EXPECT_LT((2.0 * twins.blocks.Solve(right) - right).norm(), 1e-12);
}

TEST(NormalMatrixTest, SolvesTreesWithLoopsAsAFullMatrixDoes) {
  Random random(7);
  for (int round = 0; round < 50; ++round) {
    const int groups = 1 + static_cast<int>(random.NextBelow(40));
    Pairs ties;
    const auto below = [&random](int n) {
      return static_cast<int>(random.NextBelow(static_cast<std::uint64_t>(n)));
    };
    for (int g = 1; g < groups; ++g) ties.emplace_back(4 * g, 4 * below(g));
    for (int extra = 0; groups > 1 && extra < groups / 4; ++extra) {
      const int a = below(groups);
      const int b = (a + 1 + below(groups - 1)) % groups;
      ties.emplace_back(4 * a, 4 * b);  // may be there already, either way round
    }
    ExpectSameSolution(groups, ties, random);
  }
}

TEST(NormalMatrixTest, TakesGroupsThatAreAllTiedOrNotAtAll) {
  Random random(8);
  ExpectSameSolution(6, {}, random);
  Pairs all;
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < a; ++b) all.emplace_back(4 * b, 4 * a);
  }
  ExpectSameSolution(8, all, random);
}

}  // namespace
}  // namespace capfit::tighten
