#include "core/tighten/normal_matrix.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstddef>

namespace capfit::tighten {
namespace {

std::size_t At(int i) { return static_cast<std::size_t>(i); }

void Insert(std::vector<int>& sorted, int value) {
  const auto place = std::lower_bound(sorted.begin(), sorted.end(), value);
  if (place == sorted.end() || *place != value) sorted.insert(place, value);
}

void Remove(std::vector<int>& sorted, int value) {
  sorted.erase(std::lower_bound(sorted.begin(), sorted.end(), value));
}

}  // namespace

NormalMatrix::NormalMatrix(Eigen::Index variables, std::span<const std::pair<int, int>> pairs)
    : groups_(static_cast<int>(variables / 4)) {
  Ties ties(At(groups_));
  for (const auto& [a, b] : pairs) {
    Insert(ties[At(a / 4)], b / 4);
    Insert(ties[At(b / 4)], a / 4);
  }
  PlaceBlocks(Eliminate(std::move(ties)));
}

// Each time the group that is tied to the fewest; those are tied to each other from then on.
NormalMatrix::Ties NormalMatrix::Eliminate(Ties ties) {
  column_of_group_.assign(At(groups_), -1);
  for (int column = 0; column < groups_; ++column) {
    int next = -1;
    for (int g = 0; g < groups_; ++g) {
      if (column_of_group_[At(g)] >= 0) continue;
      if (next < 0 || ties[At(g)].size() < ties[At(next)].size()) next = g;
    }
    column_of_group_[At(next)] = column;
    for (const int a : ties[At(next)]) {
      Remove(ties[At(a)], next);
      for (const int b : ties[At(next)]) {
        if (a != b) Insert(ties[At(a)], b);
      }
    }
  }
  return ties;
}

void NormalMatrix::PlaceBlocks(const Ties& later) {
  std::vector<std::vector<int>> rows(At(groups_));
  for (int g = 0; g < groups_; ++g) {
    std::vector<int>& own = rows[At(column_of_group_[At(g)])];
    for (const int tied : later[At(g)]) own.push_back(column_of_group_[At(tied)]);
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
  blocks_.resize(At(groups_) + rows_.size());
  inverses_.resize(At(groups_));
}

std::uint32_t NormalMatrix::BlockAt(int row, int column) const {
  if (row == column) return static_cast<std::uint32_t>(row);
  const auto first = rows_.begin() + begin_[At(column)];
  const auto last = rows_.begin() + begin_[At(column) + 1];
  const auto place = std::lower_bound(first, last, row);
  return static_cast<std::uint32_t>(groups_ + (place - rows_.begin()));
}

NormalMatrix::Place NormalMatrix::PlaceOf(int row, int column) const {
  const int r = column_of_group_[At(row / 4)];
  const int c = column_of_group_[At(column / 4)];
  return {BlockAt(std::max(r, c), std::min(r, c)), r < c};
}

void NormalMatrix::Reset(const Eigen::VectorXd& diagonal) {
  std::fill(blocks_.begin(), blocks_.end(), Eigen::Matrix4d::Zero());
  for (int g = 0; g < groups_; ++g) {
    blocks_[At(column_of_group_[At(g)])].diagonal() = diagonal.segment<4>(4 * g);
  }
}

void NormalMatrix::Factorise() {
  auto target = targets_.begin();
  for (std::size_t column = 0; column < inverses_.size(); ++column) {
    const Eigen::LLT<Eigen::Matrix4d> factor(blocks_[column]);
    inverses_[column] = factor.matrixL().solve(Eigen::Matrix4d::Identity());
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
    by_column.segment<4>(4 * column_of_group_[At(g)]) = right_side.segment<4>(4 * g);
  }
  const auto part = [&by_column](int column) { return by_column.segment<4>(4 * column); };
  for (int column = 0; column < groups_; ++column) {
    part(column) = (inverses_[At(column)] * part(column)).eval();
    for (std::size_t k = begin_[At(column)]; k < begin_[At(column) + 1]; ++k) {
      part(rows_[k]).noalias() -= blocks_[inverses_.size() + k] * part(column);
    }
  }
  for (int column = groups_ - 1; column >= 0; --column) {
    for (std::size_t k = begin_[At(column)]; k < begin_[At(column) + 1]; ++k) {
      part(column).noalias() -= blocks_[inverses_.size() + k].transpose() * part(rows_[k]);
    }
    part(column) = (inverses_[At(column)].transpose() * part(column)).eval();
  }
  Eigen::VectorXd result(right_side.size());
  for (int g = 0; g < groups_; ++g) {
    result.segment<4>(4 * g) = by_column.segment<4>(4 * column_of_group_[At(g)]);
  }
  return result;
}

}  // namespace capfit::tighten
