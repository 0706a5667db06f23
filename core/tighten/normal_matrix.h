// The matrix that each iteration of the penalty programme factorises.
#ifndef CAPFIT_CORE_TIGHTEN_NORMAL_MATRIX_H_
#define CAPFIT_CORE_TIGHTEN_NORMAL_MATRIX_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace capfit::tighten {

// Symmetric and positive definite, made of blocks of 4 x 4: one on the diagonal for each group of
// four variables, and one for each pair of groups that a capsule ties. Capsules form little more
// than a tree, so that its Cholesky factor, groups with few ties first, has hardly a block more
// than the matrix itself: it costs as the groups grow rather than as the cube of their number.
class NormalMatrix {
 public:
  // `pairs`: first variables of two different groups that get a block. O(groups^2).
  NormalMatrix(Eigen::Index variables, std::span<const std::pair<int, int>> pairs);

  // A block among the others.
  struct Place {
    std::uint32_t block = 0;
    bool is_transposed = false;  // it is kept with rows and columns exchanged
  };
  // The block of rows from `row` and columns from `column` on, which must be on the diagonal or of
  // one of the pairs, either way round.
  [[nodiscard]] Place PlaceOf(int row, int column) const;

  // Zero but for the diagonal.
  void Reset(const Eigen::VectorXd& diagonal);
  // Adds to a block; of those on the diagonal only the lower half is read.
  void Add(const Place& place, const Eigen::Matrix4d& values) {
    if (place.is_transposed) {
      blocks_[place.block] += values.transpose();
    } else {
      blocks_[place.block] += values;
    }
  }

  // The matrix makes room for its factor. O(blocks).
  void Factorise();
  [[nodiscard]] Eigen::VectorXd Solve(const Eigen::VectorXd& right_side) const;

 private:
  // By group: the groups of later columns that it is tied to, also by what is eliminated before.
  using Ties = std::vector<std::vector<int>>;
  Ties Eliminate(Ties ties);
  void PlaceBlocks(const Ties& later);
  [[nodiscard]] std::uint32_t BlockAt(int row, int column) const;

  int groups_;
  std::vector<int> column_of_group_;  // in the order of elimination
  // Of each column: where its blocks below the diagonal begin, less `groups_`. Those on the
  // diagonal come before all others.
  std::vector<std::uint32_t> begin_;
  std::vector<int> rows_;  // of the blocks below the diagonal, increasing in each column
  // What the products of two blocks of a column are taken from, in the order of factorisation.
  std::vector<std::uint32_t> targets_;
  std::vector<Eigen::Matrix4d> blocks_;
  std::vector<Eigen::Matrix4d> inverses_;  // of the factor's blocks on the diagonal
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_NORMAL_MATRIX_H_
