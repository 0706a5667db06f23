// The matrix that each iteration of the penalty programme factorises.
#ifndef CAPFIT_CORE_TIGHTEN_NORMAL_MATRIX_H_
#define CAPFIT_CORE_TIGHTEN_NORMAL_MATRIX_H_

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace capfit::tighten {

// Symmetric and positive definite, made of blocks of 4 x 4: one on the diagonal for each group of
// four variables, and one for each pair of groups that a capsule ties. Capsules form little more
// than a tree, so factors of large ones are nearly empty: they are kept sparse, and cost as their
// variables grow rather than as the cube of their number.
class NormalMatrix {
 public:
  // Where a block's columns begin among the values.
  using Slot = std::array<Eigen::Index, 4>;

  // `pairs`: first variables of two different groups that may get a block.
  NormalMatrix(Eigen::Index variables, std::span<const std::pair<int, int>> pairs);

  // The block of rows from `row` and columns from `column` on, row >= column; it must be on the
  // diagonal or of one of the pairs.
  [[nodiscard]] Slot SlotOf(Eigen::Index row, Eigen::Index column) const;

  // Zero but for the diagonal.
  void Reset(const Eigen::VectorXd& diagonal);
  // Adds to entry (i, j) of a block. Above the diagonal nothing is read.
  double& At(const Slot& slot, Eigen::Index i, Eigen::Index j) {
    return values_[slot[static_cast<std::size_t>(j)] + i];
  }

  void Factorise();
  [[nodiscard]] Eigen::VectorXd Solve(const Eigen::VectorXd& right_side) const;

 private:
  using Sparse = Eigen::SparseMatrix<double>;

  [[nodiscard]] Sparse PatternOf(std::span<const std::pair<int, int>> pairs) const;

  Eigen::Index variables_;
  bool is_sparse_;
  Eigen::ArrayXd values_;
  Sparse pattern_;
  Eigen::LLT<Eigen::MatrixXd> dense_;
  Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>> sparse_;
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_NORMAL_MATRIX_H_
