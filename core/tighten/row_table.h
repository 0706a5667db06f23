// The rows of a penalty programme as its solver goes through them.
#ifndef CAPFIT_CORE_TIGHTEN_ROW_TABLE_H_
#define CAPFIT_CORE_TIGHTEN_ROW_TABLE_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "core/tighten/normal_matrix.h"
#include "core/tighten/penalty_program.h"

namespace capfit::tighten {

// The programme's rows, those of one group of variables together, in the order in which they come.
// O(rows + groups of variables^2).
[[nodiscard]] std::vector<std::size_t> RowsByGroup(const PenaltyProgram& program);

// Rows in a lane of doubles and of floats, one vector register each.
inline constexpr Eigen::Index kDoublesInLane = 4;
inline constexpr Eigen::Index kFloatsInLane = 8;

// Rows that touch the same variables, [begin, end) in the solver's order, a whole number of lanes.
struct RowGroup {
  Eigen::Index begin = 0;
  Eigen::Index end = 0;
  int first_a = 0;
  int first_b = -1;
  // Its blocks of the normal matrix; the last where there is a second.
  NormalMatrix::Place a, b, across;
};

// The rows with their coefficients apart, group by group, in doubles or floats. Groups are filled
// up to whole lanes with rows that never bind.
template <typename Real>
struct RowTable {
  using Array = Eigen::Array<Real, Eigen::Dynamic, 1>;
  static constexpr Eigen::Index kLane = sizeof(Real) == 8 ? kDoublesInLane : kFloatsInLane;
  using Lane = Eigen::Array<Real, kLane, 1>;
  using Lanes = std::array<Lane, 8>;  // one for each coefficient of a row

  // `lane`: what groups are filled up to, a multiple of kLane.
  RowTable(const PenaltyProgram& program, Eigen::Index lane) : lane_(lane) {
    const std::vector<PenaltyRow>& rows = program.rows;
    const std::vector<std::size_t> order = RowsByGroup(program);
    std::size_t most_groups = 1;
    for (std::size_t i = 1; i < order.size(); ++i) {
      most_groups += rows[order[i]].first != rows[order[i - 1]].first ? 1 : 0;
    }
    const auto most = static_cast<Eigen::Index>(rows.size() + lane * most_groups);
    coefficients.setZero(most, 8);
    value = Array::Constant(most, -static_cast<Real>((program.upper - program.lower).maxCoeff()));
    penalty = Array::Ones(most);
    for (const std::size_t i : order) Append(rows[i]);
    CloseGroup();
    count = next_;
  }

  // The same rows, whose groups fill up lanes of this table too.
  template <typename Other>
  explicit RowTable(const RowTable<Other>& other)
      : groups(other.groups),
        coefficients(other.coefficients.template cast<Real>()),
        value(other.value.template cast<Real>()),
        penalty(other.penalty.template cast<Real>()),
        count(other.count) {}

  // The lane from row k on, here and of coefficient c.
  static auto At(Array& array, Eigen::Index k) { return array.template segment<kLane>(k); }
  static Lane At(const Array& array, Eigen::Index k) { return array.template segment<kLane>(k); }
  Lane Coefficient(Eigen::Index k, Eigen::Index c) const {
    return coefficients.col(c).template segment<kLane>(k);
  }

  // Rows times their weights, added up lane by lane, and then what belongs to each variable.
  void AddWeighted(Eigen::Index k, const Lane& weight, Lanes& sums) const {
    for (Eigen::Index c = 0; c < 8; ++c) {
      sums[c] += weight * Coefficient(k, c);
    }
  }
  static void Scatter(const RowGroup& group, const Lanes& sums, Eigen::VectorXd& to) {
    for (int c = 0; c < 4; ++c) {
      to[group.first_a + c] += sums[c].sum();
      if (group.first_b >= 0) to[group.first_b + c] += sums[4 + c].sum();
    }
  }
  static Lanes NoLanes() {
    Lanes lanes;
    lanes.fill(Lane::Zero());
    return lanes;
  }

  // Of the variables that a group's rows touch.
  static std::array<Real, 8> OwnPart(const RowGroup& group, const Eigen::VectorXd& of) {
    std::array<Real, 8> own{};
    for (int c = 0; c < 4; ++c) {
      own[c] = static_cast<Real>(of[group.first_a + c]);
      if (group.first_b >= 0) own[c + 4] = static_cast<Real>(of[group.first_b + c]);
    }
    return own;
  }

  Lane Product(Eigen::Index k, const std::array<Real, 8>& own) const {
    Lane product = Lane::Zero();
    for (Eigen::Index c = 0; c < 8; ++c) {
      product += own[c] * Coefficient(k, c);
    }
    return product;
  }

  std::vector<RowGroup> groups;
  Eigen::Array<Real, Eigen::Dynamic, 8> coefficients;
  Array value, penalty;
  Eigen::Index count = 0;  // of rows in use

 private:
  void Append(const PenaltyRow& row) {
    if (groups.empty() || groups.back().first_a != row.first[0] ||
        groups.back().first_b != row.first[1]) {
      CloseGroup();
      groups.push_back({next_, next_, row.first[0], row.first[1], {}, {}, {}});
    }
    for (Eigen::Index c = 0; c < 8; ++c) {
      coefficients(next_, c) = static_cast<Real>(row.coefficients[c]);
    }
    value[next_] = static_cast<Real>(row.value);
    penalty[next_] = static_cast<Real>(row.penalty);
    ++next_;
  }

  void CloseGroup() {
    if (groups.empty()) return;
    // The rows that fill up cost as much as their neighbours, so that they converge like these.
    while (next_ % lane_ != 0) penalty[next_] = penalty[next_ - 1], ++next_;
    groups.back().end = next_;
  }

  Eigen::Index lane_ = kLane;
  Eigen::Index next_ = 0;
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_ROW_TABLE_H_
