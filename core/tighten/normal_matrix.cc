#include "core/tighten/normal_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace capfit::tighten {
namespace {

void Insert(std::vector<int>& sorted, int value) {
  const auto place = std::lower_bound(sorted.begin(), sorted.end(), value);
  if (place == sorted.end() || *place != value) sorted.insert(place, value);
}

void Remove(std::vector<int>& sorted, int value) {
  sorted.erase(std::lower_bound(sorted.begin(), sorted.end(), value));
}

// Of the lower triangle L of a = L L', of which the lower half is read. In loops of known length,
// which Eigen's own are not: they are called for any size.
Eigen::Matrix4d InverseOfFactor(const Eigen::Matrix4d& a) {
  Eigen::Matrix4d factor = a;
  Eigen::Matrix4d inverse = Eigen::Matrix4d::Zero();
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < k; ++j) {
      for (int i = k; i < 4; ++i) factor(i, k) -= factor(i, j) * factor(k, j);
    }
    const double one_over = 1.0 / std::sqrt(factor(k, k));
    for (int i = k; i < 4; ++i) factor(i, k) *= one_over;
    inverse(k, k) = one_over;
    for (int j = 0; j < k; ++j) {
      double sum = 0.0;
      for (int i = j; i < k; ++i) sum += factor(k, i) * inverse(i, j);
      inverse(k, j) = -sum * one_over;
    }
  }
  return inverse;
}

}  // namespace

NormalMatrix::NormalMatrix(Eigen::Index variables, std::span<const std::pair<int, int>> pairs)
    : groups_(static_cast<int>(variables / 4)) {
  Ties ties(groups_);
  for (const auto& [a, b] : pairs) {
    Insert(ties[a / 4], b / 4);
    Insert(ties[b / 4], a / 4);
  }
  PlaceBlocks(Eliminate(std::move(ties)));
}

// Each time the group that is tied to the fewest; those are tied to each other from then on.
NormalMatrix::Ties NormalMatrix::Eliminate(Ties ties) {
  column_of_group_.assign(groups_, -1);
  for (int column = 0; column < groups_; ++column) {
    int next = -1;
    for (int g = 0; g < groups_; ++g) {
      if (column_of_group_[g] >= 0) continue;
      if (next < 0 || ties[g].size() < ties[next].size()) next = g;
    }
    column_of_group_[next] = column;
    for (const int a : ties[next]) {
      Remove(ties[a], next);
      for (const int b : ties[next]) {
        if (a != b) Insert(ties[a], b);
      }
    }
  }
  return ties;
}

void NormalMatrix::PlaceBlocks(const Ties& later) {
  std::vector<std::vector<int>> rows(groups_);
  for (int g = 0; g < groups_; ++g) {
    std::vector<int>& own = rows[column_of_group_[g]];
    for (const int tied : later[g]) own.push_back(column_of_group_[tied]);
    std::sort(own.begin(), own.end());
  }
  for (const std::vector<int>& own : rows) {
    begin_.push_back(static_cast<std::uint32_t>(rows_.size()));
    rows_.insert(rows_.end(), own.begin(), own.end());
  }
  begin_.push_back(static_cast<std::uint32_t>(rows_.size()));
  for (const std::vector<int>& own : rows) {
    for (std::size_t a = 0; a < own.size(); ++a) {
      for (std::size_t b = 0; b <= a; ++b) targets_.push_back(BlockAt(own[a], own[b]));
    }
  }
  blocks_.resize(groups_ + rows_.size());
  inverses_.resize(groups_);
}

std::uint32_t NormalMatrix::BlockAt(int row, int column) const {
  if (row == column) return static_cast<std::uint32_t>(row);
  const auto first = rows_.begin() + begin_[column];
  const auto last = rows_.begin() + begin_[column + 1];
  const auto place = std::lower_bound(first, last, row);
  return static_cast<std::uint32_t>(groups_ + (place - rows_.begin()));
}

NormalMatrix::Place NormalMatrix::PlaceOf(int row, int column) const {
  const int r = column_of_group_[row / 4];
  const int c = column_of_group_[column / 4];
  return {BlockAt(std::max(r, c), std::min(r, c)), r < c};
}

void NormalMatrix::Reset(const Eigen::VectorXd& diagonal) {
  std::fill(blocks_.begin(), blocks_.end(), Eigen::Matrix4d::Zero());
  for (int g = 0; g < groups_; ++g) {
    blocks_[column_of_group_[g]].diagonal() = diagonal.segment<4>(4 * g);
  }
}

void NormalMatrix::Factorise() {
  auto target = targets_.begin();
  for (std::size_t column = 0; column < inverses_.size(); ++column) {
    inverses_[column] = InverseOfFactor(blocks_[column]);
    const std::size_t first = inverses_.size() + begin_[column];
    const std::size_t last = inverses_.size() + begin_[column + 1];
    for (std::size_t a = first; a < last; ++a) {
      blocks_[a] = (blocks_[a] * inverses_[column].transpose()).eval();
      for (std::size_t b = first; b <= a; ++b) {
        blocks_[*target++].noalias() -= blocks_[a] * blocks_[b].transpose();
      }
    }
  }
}

Eigen::VectorXd NormalMatrix::Solve(const Eigen::VectorXd& right_side) const {
  Eigen::VectorXd by_column(right_side.size());
  for (int g = 0; g < groups_; ++g) {
    by_column.segment<4>(4 * column_of_group_[g]) = right_side.segment<4>(4 * g);
  }
  const auto part = [&by_column](int column) { return by_column.segment<4>(4 * column); };
  for (int column = 0; column < groups_; ++column) {
    part(column) = (inverses_[column] * part(column)).eval();
    for (std::size_t k = begin_[column]; k < begin_[column + 1]; ++k) {
      part(rows_[k]).noalias() -= blocks_[inverses_.size() + k] * part(column);
    }
  }
  for (int column = groups_ - 1; column >= 0; --column) {
    for (std::size_t k = begin_[column]; k < begin_[column + 1]; ++k) {
      part(column).noalias() -= blocks_[inverses_.size() + k].transpose() * part(rows_[k]);
    }
    part(column) = (inverses_[column].transpose() * part(column)).eval();
  }
  Eigen::VectorXd result(right_side.size());
  for (int g = 0; g < groups_; ++g) {
    result.segment<4>(4 * g) = by_column.segment<4>(4 * column_of_group_[g]);
  }
  return result;
}

}  // namespace capfit::tighten
