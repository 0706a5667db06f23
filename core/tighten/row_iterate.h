// The rows' side of the interior point method: their slacks and multipliers, and sums over them.
#ifndef CAPFIT_CORE_TIGHTEN_ROW_ITERATE_H_
#define CAPFIT_CORE_TIGHTEN_ROW_ITERATE_H_

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/short_loops.h"
#include "core/tighten/normal_blocks.h"
#include "core/tighten/row_table.h"

namespace capfit::tighten {

// How far rows let a step go, and what becomes of their complementarity along it.
struct RowStep {
  // The largest of -change / value, of slacks and of multipliers.
  double worst_primal = 0.0, worst_dual = 0.0;
  // by_primal * p + by_dual * q + by_both * p * q more.
  double by_primal = 0.0, by_dual = 0.0, by_both = 0.0;
};

struct RowTotals {
  double complementarity = 0.0;
  double excess = 0.0;  // what the slacks s cost
};

// Slacks s >= 0 and t = s - value - coefficients . d >= 0; multipliers `row` of t and penalty - row
// of s. All loops over rows go lane by lane, once over everything that a stage of the iteration
// needs. Numbers of rows are in `Real`, what belongs to variables is in doubles. Sums are taken
// part by part, and the parts do not depend on the threads that take them.
template <typename Real>
class RowIterate {
 public:
  // Keeps references to both.
  RowIterate(RowTable<Real>& rows, ShortLoops& loops)
      : rows_(rows),
        loops_(loops),
        parts_(rows.layout().parts.size()),
        group_sums_(rows.layout().groups.size()) {}

  // How many rows, with those that fill up lanes.
  [[nodiscard]] Eigen::Index size() const { return rows_.layout().size; }

  // At d = 0, with slacks of `slack` at least and products of `mu` about. What the excess costs.
  double Start(double mu, double slack) {
    ForParts([&](std::size_t part) {
      StartPart(static_cast<Real>(mu), static_cast<Real>(slack), part);
    });
    return Totals().excess;
  }

  // At d, where all products are the centre's: t * row = s * (penalty - row) = mu and s - t is the
  // row's excess.
  void StartOnPath(const Eigen::VectorXd& d, double mu) {
    ForParts([&](std::size_t part) {
      for (const RowGroup& group : rows_.GroupsOf(part)) {
        StartOnPath(group, rows_.OwnPart(group, d), static_cast<Real>(mu));
      }
    });
  }

  // Sets what each group adds to the normal matrix.
  void Weigh(NormalBlocks& normal) {
    ForParts([&](std::size_t part) {
      const RowPart& groups = rows_.layout().parts[part];
      for (std::size_t g = groups.begin; g < groups.end; ++g) {
        WeighGroup(rows_.layout().groups[g], normal.of(g));
      }
    });
  }

  // Takes zero for the target of all products; adds what that takes from the right side.
  void AimAtZero(Eigen::VectorXd& sums) {
    SumByVariable([this](const RowGroup& group, Lanes& lanes) {
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const RowLane<Real> lane = rows_.LaneAt(k);
        const Lane slack = lane.penalty() - lane.row();
        lane.s_target() = -lane.s() * slack;
        const Lane shift = lane.weight() * (lane.s() - lane.t());
        lane.shift() = shift;
        lane.AddWeighted(shift, lanes);
      }
    });
    Scatter(sums);
  }

  // Takes `mu`; `after_step`: less what the step before would leave over.
  void AimAt(double mu, bool after_step, Eigen::VectorXd& sums) {
    const auto row_mu = static_cast<Real>(mu);
    const Real left_over = after_step ? 1 : 0;
    SumByVariable([&](const RowGroup& group, Lanes& lanes) {
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const RowLane<Real> lane = rows_.LaneAt(k);
        const Lane slack = lane.penalty() - lane.row();
        const Lane drow = left_over * lane.drow();
        const Lane t_target = row_mu - lane.t() * lane.row() - lane.dt() * drow;
        const Lane s_target = row_mu - lane.s() * slack + lane.ds() * drow;
        lane.s_target() = s_target;
        const Lane shift =
            lane.weight() * (t_target * lane.inverse_row() - s_target * lane.inverse_slack());
        lane.shift() = shift;
        lane.AddWeighted(shift, lanes);
      }
    });
    Scatter(sums);
  }

  // Where slacks and multipliers go for their target while d changes so.
  RowStep Direct(const Eigen::VectorXd& change) {
    ForParts([&](std::size_t part) { DirectPart(change, part); });
    RowStep all;
    for (const PartSums& part : parts_) {
      all.worst_primal = std::max(all.worst_primal, part.step.worst_primal);
      all.worst_dual = std::max(all.worst_dual, part.step.worst_dual);
      all.by_primal += part.step.by_primal;
      all.by_dual += part.step.by_dual;
      all.by_both += part.step.by_both;
    }
    return all;
  }

  // Goes these shares of the last step; adds the rows times their multipliers.
  RowTotals Advance(double primal, double dual, Eigen::VectorXd& sums) {
    ForParts([&](std::size_t part) {
      AdvancePart(static_cast<Real>(primal), static_cast<Real>(dual), part);
    });
    Scatter(sums);
    return Totals();
  }

 private:
  static constexpr Eigen::Index kLane = RowTable<Real>::kLane;
  using Lane = typename RowLane<Real>::Lane;
  using Lanes = typename RowLane<Real>::Lanes;

  // What the rows of a part add up to, and those of a group, on cache lines of their own: one
  // thread writes them and another one reads them.
  struct alignas(64) PartSums {
    RowStep step;
    RowTotals totals;
  };
  struct alignas(64) GroupSums {
    std::array<double, 8> by_variable{};
  };

  // Calls visit(part's number) for each, on all threads that take part.
  template <typename Visit>
  void ForParts(const Visit& visit) {
    loops_.ForEach(parts_.size(), visit);
  }

  // For each group of a part add(group, its lanes of sums), one for each of its variables.
  template <typename Add>
  void SumByVariable(std::size_t part, const Add& add) {
    const RowPart& groups = rows_.layout().parts[part];
    for (std::size_t g = groups.begin; g < groups.end; ++g) {
      Lanes lanes = RowLane<Real>::NoLanes();
      add(rows_.layout().groups[g], lanes);
      for (std::size_t c = 0; c < 8; ++c) group_sums_[g].by_variable[c] = lanes[c].sum();
    }
  }
  template <typename Add>
  void SumByVariable(const Add& add) {
    ForParts([&](std::size_t part) { SumByVariable(part, add); });
  }

  // Adds what SumByVariable found, group by group: the order does not depend on the parts.
  void Scatter(Eigen::VectorXd& to) const {
    for (std::size_t g = 0; g < group_sums_.size(); ++g) {
      const RowGroup& group = rows_.layout().groups[g];
      const std::array<double, 8>& sums = group_sums_[g].by_variable;
      for (int c = 0; c < 4; ++c) {
        to[group.first_a + c] += sums[c];
        if (group.first_b >= 0) to[group.first_b + c] += sums[c + 4];
      }
    }
  }

  RowTotals Totals() const {
    RowTotals all;
    for (const PartSums& part : parts_) {
      all.complementarity += part.totals.complementarity;
      all.excess += part.totals.excess;
    }
    return all;
  }

  void StartPart(Real mu, Real slack, std::size_t part) {
    Lane excess = Lane::Zero();
    for (const RowGroup& group : rows_.GroupsOf(part)) {
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const RowLane<Real> lane = rows_.LaneAt(k);
        const Lane penalty = lane.penalty();
        const Lane out = lane.value().max(Real{0});
        const Lane t = out + slack - lane.value();
        lane.s() = out + slack;
        lane.t() = t;
        lane.row() = (mu / t).min(Real{0.5} * penalty);
        lane.dt() = lane.ds() = lane.drow() = Lane::Zero();
        excess += penalty * out;
      }
    }
    parts_[part].totals.excess = excess.sum();
  }

  void StartOnPath(const RowGroup& group, const std::array<Real, 8>& d, Real mu) {
    for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
      const RowLane<Real> lane = rows_.LaneAt(k);
      const Lane penalty = lane.penalty();
      const Lane cost = penalty * (lane.value() + lane.Product(d));
      // The root of the sum minus the cost without the difference of two large numbers.
      const Lane far = (cost.square() + 4 * mu * mu).sqrt() + cost.abs();
      const Lane near = (4 * mu * mu) / far;
      const auto is_out = cost > Real{0};
      lane.t() = (2 * mu + is_out.select(near, far)) / (2 * penalty);
      lane.s() = (2 * mu + is_out.select(far, near)) / (2 * penalty);
      lane.row() = mu / lane.t();
      lane.dt() = lane.ds() = lane.drow() = Lane::Zero();
    }
  }

  void WeighGroup(const RowGroup& group, NormalBlocks::Blocks& blocks) {
    for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
      const RowLane<Real> lane = rows_.LaneAt(k);
      const Lane inverse_row = lane.row().inverse();
      const Lane inverse_slack = (lane.penalty() - lane.row()).inverse();
      lane.inverse_row() = inverse_row;
      lane.inverse_slack() = inverse_slack;
      lane.weight() = (lane.t() * inverse_row + lane.s() * inverse_slack).inverse();
    }
    blocks.a = BlockOf(group, 0, 0);
    if (group.first_b < 0) return;
    blocks.b = BlockOf(group, 4, 4);
    blocks.across = BlockOf(group, 4, 0);
  }

  // Weighted products of four columns of coefficients with four others, summed over a group; two
  // rows of the block at a time, whose sums stay in registers.
  Eigen::Matrix4d BlockOf(const RowGroup& group, Eigen::Index left, Eigen::Index right) const {
    Eigen::Matrix4d block = Eigen::Matrix4d::Zero();
    if (left == right) {  // of the diagonal the lower half is enough
      PutTwoRows<2>(group, left, right, block.topRows<2>());
    } else {
      PutTwoRows<4>(group, left, right, block.topRows<2>());
    }
    PutTwoRows<4>(group, left + 2, right, block.bottomRows<2>());
    return block;
  }

  template <Eigen::Index kColumns, typename Rows>
  void PutTwoRows(const RowGroup& group, Eigen::Index left, Eigen::Index right, Rows&& rows) const {
    std::array<Lane, kColumns> upper;
    std::array<Lane, kColumns> lower;
    upper.fill(Lane::Zero());
    lower.fill(Lane::Zero());
    for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
      const RowLane<Real> lane = rows_.LaneAt(k);
      const Lane weight = lane.weight();
      const Lane weighted_upper = weight * lane.coefficient(left);
      const Lane weighted_lower = weight * lane.coefficient(left + 1);
      for (Eigen::Index j = 0; j < kColumns; ++j) {
        const Lane other = lane.coefficient(right + j);
        upper[j] += weighted_upper * other;
        lower[j] += weighted_lower * other;
      }
    }
    for (Eigen::Index j = 0; j < kColumns; ++j) {
      rows(0, j) = upper[j].sum();
      rows(1, j) = lower[j].sum();
    }
  }

  void DirectPart(const Eigen::VectorXd& change, std::size_t part) {
    Lane primal = Lane::Zero();
    Lane dual = Lane::Zero();
    Lane by_primal = Lane::Zero();
    Lane by_dual = Lane::Zero();
    Lane by_both = Lane::Zero();
    for (const RowGroup& group : rows_.GroupsOf(part)) {
      const std::array<Real, 8> d = rows_.OwnPart(group, change);
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const RowLane<Real> lane = rows_.LaneAt(k);
        const Lane product = lane.Product(d);
        const Lane s = lane.s();
        const Lane t = lane.t();
        const Lane row = lane.row();
        const Lane inverse_slack = lane.inverse_slack();
        const Lane drow = lane.weight() * product + lane.shift();
        const Lane ds = (lane.s_target() + s * drow) * inverse_slack;
        const Lane dt = ds - product;
        lane.drow() = drow;
        lane.ds() = ds;
        lane.dt() = dt;
        primal = primal.max(-dt / t).max(-ds / s);
        dual = dual.max(-drow * lane.inverse_row()).max(drow * inverse_slack);
        by_primal += dt * row + ds * (lane.penalty() - row);
        by_dual += drow * (t - s);
        by_both += drow * (dt - ds);
      }
    }
    parts_[part].step = {primal.maxCoeff(), dual.maxCoeff(), by_primal.sum(), by_dual.sum(),
                         by_both.sum()};
  }

  void AdvancePart(Real primal, Real dual, std::size_t part) {
    Lane complementarity = Lane::Zero();
    Lane excess = Lane::Zero();
    SumByVariable(part, [&](const RowGroup& group, Lanes& lanes) {
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const RowLane<Real> lane = rows_.LaneAt(k);
        const Lane t = lane.t() + primal * lane.dt();
        const Lane s = lane.s() + primal * lane.ds();
        const Lane row = lane.row() + dual * lane.drow();
        const Lane penalty = lane.penalty();
        lane.t() = t;
        lane.s() = s;
        lane.row() = row;
        complementarity += t * row + s * (penalty - row);
        excess += penalty * s;
        lane.AddWeighted(row, lanes);
      }
    });
    parts_[part].totals = {complementarity.sum(), excess.sum()};
  }

  RowTable<Real>& rows_;
  ShortLoops& loops_;
  std::vector<PartSums> parts_;
  std::vector<GroupSums> group_sums_;
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_ROW_ITERATE_H_
