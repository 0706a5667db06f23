#include "core/tighten/normal_matrix.h"

#include <algorithm>

namespace capfit::tighten {
namespace {

// Below, dense factors are quicker.
constexpr Eigen::Index kLeastSparse = 160;

}  // namespace

NormalMatrix::NormalMatrix(Eigen::Index variables, std::span<const std::pair<int, int>> pairs)
    : variables_(variables), is_sparse_(variables >= kLeastSparse) {
  if (!is_sparse_) {
    values_.setZero(variables * variables);
    return;
  }
  pattern_ = PatternOf(pairs);
  values_.setZero(pattern_.nonZeros());
  sparse_.analyzePattern(pattern_);
}

NormalMatrix::Sparse NormalMatrix::PatternOf(std::span<const std::pair<int, int>> pairs) const {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&entries](int row, int column) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) entries.emplace_back(row + i, column + j, 1.0);
    }
  };
  for (int first = 0; first < variables_; first += 4) add(first, first);
  for (const auto& [a, b] : pairs) add(std::max(a, b), std::min(a, b));
  Sparse pattern(variables_, variables_);
  pattern.setFromTriplets(entries.begin(), entries.end());
  return pattern;
}

NormalMatrix::Slot NormalMatrix::SlotOf(Eigen::Index row, Eigen::Index column) const {
  Slot slot{};
  for (Eigen::Index j = 0; j < 4; ++j) {
    auto& begin = slot[static_cast<std::size_t>(j)];
    if (!is_sparse_) {
      begin = (column + j) * variables_ + row;
      continue;
    }
    const int* const first = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column + j];
    const int* const last = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column + j + 1];
    begin = std::lower_bound(first, last, static_cast<int>(row)) - pattern_.innerIndexPtr();
  }
  return slot;
}

void NormalMatrix::Reset(const Eigen::VectorXd& diagonal) {
  values_.setZero();
  for (Eigen::Index first = 0; first < variables_; first += 4) {
    const Slot slot = SlotOf(first, first);
    for (Eigen::Index i = 0; i < 4; ++i) At(slot, i, i) = diagonal[first + i];
  }
}

void NormalMatrix::Factorise() {
  if (!is_sparse_) {
    dense_.compute(Eigen::Map<const Eigen::MatrixXd>(values_.data(), variables_, variables_));
    return;
  }
  std::copy(values_.begin(), values_.end(), pattern_.valuePtr());
  sparse_.factorize(pattern_);
}

Eigen::VectorXd NormalMatrix::Solve(const Eigen::VectorXd& right_side) const {
  return is_sparse_ ? Eigen::VectorXd(sparse_.solve(right_side))
                    : Eigen::VectorXd(dense_.solve(right_side));
}

}  // namespace capfit::tighten
