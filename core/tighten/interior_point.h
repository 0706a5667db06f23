// The method that solves penalty programmes: interior points, rows in floats or doubles.
#ifndef CAPFIT_CORE_TIGHTEN_INTERIOR_POINT_H_
#define CAPFIT_CORE_TIGHTEN_INTERIOR_POINT_H_

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/base/short_loops.h"
#include "core/tighten/normal_blocks.h"
#include "core/tighten/penalty_program.h"
#include "core/tighten/row_table.h"

namespace capfit::tighten {

// Written with slacks s >= 0 and t = s - value - coefficients . d >= 0; multipliers `row` of t and
// penalty - row of s; `low` and `high` of the bounds. All loops over rows go lane by lane, once
// over the arrays for everything that a stage of the iteration needs. Rows are in `Real`, what
// belongs to variables is in doubles. Sums over rows are taken part by part, and the parts do not
// depend on the threads that take them.
template <typename Real>
class InteriorPoint {
 public:
  // `rows`: of the programme. `normal`: for their groups.
  InteriorPoint(const PenaltyProgram& program, const SolveTo& to, ShortLoops& loops,
                RowTable<Real>& rows, NormalBlocks& normal)
      : program_(program),
        to_(to),
        loops_(loops),
        rows_(rows),
        normal_(normal),
        variables_(program.gradient.size()),
        sums_(rows.layout().parts.size()),
        group_sums_(rows.layout().groups.size()) {
    width_ = (program_.upper - program_.lower).maxCoeff();
    most_ = std::max(1e-12, program_.gradient.cwiseAbs().maxCoeff()) * width_;
    least_mu_ = to_.centrality * most_;
  }

  Eigen::VectorXd Run() {
    Start();
    for (int i = 0; i < to_.most_iterations && !IsDone(); ++i) Iterate();
    return d_;
  }

  // The point of the central path, from one that is nearly it.
  Eigen::VectorXd Polish(Eigen::VectorXd d) {
    StartOnPath(std::move(d));
    for (int i = 0; i < kPolishing; ++i) Iterate();
    return d_;
  }

 private:
  static constexpr Eigen::Index kLane = RowTable<Real>::kLane;
  // Steps go no farther than this share of the way to the boundary.
  static constexpr double kOfTheWay = 0.99;
  // After a predictor no farther than this share of a whole one either. (Whole ones serve a single
  // programme as well, but the search for sets ends with 1 % more E_r at 48 to 128 primitives.)
  static constexpr double kOfAWhole = 0.99;
  // First complementarity, relative to the most that a variable can win, and the least slack that
  // rows start with, relative to the trust region's width. On the way to a point of the central
  // path half of the slack saves two iterations of eleven; twice of it costs two.
  static constexpr double kFirstShare = 0.1;
  static constexpr double kFirstShareToCentre = 0.005;
  static constexpr double kFirstSlack = 0.25;
  static constexpr double kFirstSlackToCentre = 0.12;
  // There each step aims at this share of the complementarity.
  static constexpr double kCentring = 0.01;
  // It is reached when complementarity is so near to its own after a whole step: of those each
  // doubles the digits that are right. Floats do not get much nearer; with 1e-4 and one iteration
  // less three bodies of ten move by more than a hundredth of a millimetre when vertices are
  // rounded to floats, with 1e-5 one.
  static constexpr double kAtCentre = 1e-5;
  // Iterations in doubles from there: after one, the last digits are still those of floats.
  static constexpr int kPolishing = 2;

  using Lane = typename RowLane<Real>::Lane;
  using Lanes = typename RowLane<Real>::Lanes;

  // What the rows of a part add up to. On cache lines of its own.
  struct alignas(64) PartSums {
    double worst_primal = 0.0, worst_dual = 0.0;
    double by_primal = 0.0, by_dual = 0.0, by_both = 0.0;
    double complementarity = 0.0, excess = 0.0;
  };

  // One cache line: what one thread sums up another one reads.
  struct alignas(64) GroupSums {
    std::array<double, 8> by_variable{};
  };

  // Calls visit(part's number) for each, on all threads that take part.
  template <typename Visit>
  void ForParts(const Visit& visit) {
    loops_.ForEach(sums_.size(), visit);
  }

  std::span<const RowGroup> GroupsOf(std::size_t part) const { return rows_.GroupsOf(part); }

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

  // Changes of d and of the bounds' multipliers; those of the rows are in dt_, ds_ and drow_.
  struct Step {
    Eigen::VectorXd d;
    Eigen::ArrayXd low, high;
    double primal = 0.0;  // how far it goes
    double dual = 0.0;
    // Complementarity of the rows along it: by_primal * p + by_dual * q + by_both * p * q more.
    double by_primal = 0.0, by_dual = 0.0, by_both = 0.0;
  };

  // The longest step in [0, most] that goes `share` of the way to the boundary at most; `worst` is
  // the largest of -change / value.
  static double StepFor(double worst, double share, double most) {
    return most * worst > share ? share / worst : most;
  }

  static double WorstRatio(const Eigen::ArrayXd& value, const Eigen::ArrayXd& change) {
    return (-change / value).maxCoeff();
  }

  // d = 0 satisfies the bounds, and slacks satisfy the rows: only the duals have to be found.
  void Start() {
    d_ = Eigen::VectorXd::Zero(variables_);
    const bool is_to_centre = to_.centrality > 0.0;
    const double mu = (is_to_centre ? kFirstShareToCentre : kFirstShare) * most_;
    const double slack = (is_to_centre ? kFirstSlackToCentre : kFirstSlack) * width_;
    ForParts([&](std::size_t part) {
      StartPart(static_cast<Real>(mu), static_cast<Real>(slack), part);
    });
    start_excess_ = 0.0;
    for (const PartSums& sums : sums_) start_excess_ += sums.excess;
    StartBounds(mu);
  }

  void StartPart(Real mu, Real slack, std::size_t part) {
    Lane excess = Lane::Zero();
    for (const RowGroup& group : GroupsOf(part)) {
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
    sums_[part].excess = excess.sum();
  }

  // Slacks and multipliers that belong to d where all their products are the centre's:
  // t * row = s * (penalty - row) = mu and s - t = the row's excess.
  void StartOnPath(Eigen::VectorXd d) {
    d_ = std::move(d);
    ForParts([this](std::size_t part) {
      for (const RowGroup& group : GroupsOf(part)) StartOnPath(group);
    });
    StartBounds(least_mu_);
  }

  void StartOnPath(const RowGroup& group) {
    const auto mu = static_cast<Real>(least_mu_);
    const std::array<Real, 8> own = rows_.OwnPart(group, d_);
    for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
      const RowLane<Real> lane = rows_.LaneAt(k);
      const Lane penalty = lane.penalty();
      const Lane cost = penalty * (lane.value() + lane.Product(own));
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

  void StartBounds(double mu) {
    low_ = mu / LowGap();
    high_ = mu / HighGap();
    Advance({Eigen::VectorXd::Zero(variables_), Eigen::ArrayXd::Zero(variables_),
             Eigen::ArrayXd::Zero(variables_)});
  }

  Eigen::ArrayXd LowGap() const { return d_.array() - program_.lower.array(); }
  Eigen::ArrayXd HighGap() const { return program_.upper.array() - d_.array(); }

  double Complementarity() const {
    return row_complementarity_ + (LowGap() * low_).sum() + (HighGap() * high_).sum();
  }

  double Products() const { return static_cast<double>(2 * (rows_.layout().size + variables_)); }

  bool IsDone() const {
    if (to_.centrality > 0.0) {
      const double wanted = Products() * least_mu_;
      return was_whole_ && std::abs(Complementarity() - wanted) <= kAtCentre * wanted;
    }
    const double won = start_excess_ - excess_ - program_.gradient.dot(d_) -
                       0.5 * d_.dot(program_.hessian.cwiseProduct(d_));
    const double floor = 1e-9 * program_.gradient.cwiseAbs().maxCoeff() * width_;
    const double allowed = to_.relative_gap * std::max(won, 0.0) + floor;
    return Complementarity() <= allowed && residual_.cwiseAbs().sum() * width_ <= allowed;
  }

  // The normal matrix: everything but d eliminated. Lower half.
  void Factorise() {
    ForParts([this](std::size_t part) {
      const RowPart& groups = rows_.layout().parts[part];
      for (std::size_t g = groups.begin; g < groups.end; ++g) {
        WeighGroup(rows_.layout().groups[g], normal_.of(g));
      }
    });
    normal_.Factorise((program_.hessian.array() + low_ / LowGap() + high_ / HighGap()).matrix());
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

  // Straight for zero complementarity.
  Step Predict() {
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
    return Direction(-LowGap() * low_, -HighGap() * high_, 1.0, 1.0);
  }

  // For the complementarity `mu` everywhere; after a predictor with what its step would leave over.
  Step Correct(double mu, const Step* predicted) {
    const auto row_mu = static_cast<Real>(mu);
    const Real left_over = predicted != nullptr ? 1 : 0;
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
    Eigen::ArrayXd low_target = mu - LowGap() * low_;
    Eigen::ArrayXd high_target = mu - HighGap() * high_;
    if (predicted != nullptr) {
      low_target -= predicted->d.array() * predicted->low;
      high_target += predicted->d.array() * predicted->high;
    }
    return Direction(low_target, high_target, kOfTheWay, predicted != nullptr ? kOfAWhole : 1.0);
  }

  // Solves for targets of the complementarity products: what each should change by. The step is
  // `most` at most, and goes `share` of the way to the boundary at most. What the rows add to the
  // right side is in the groups' sums.
  Step Direction(const Eigen::ArrayXd& low_target, const Eigen::ArrayXd& high_target, double share,
                 double most) {
    const Eigen::ArrayXd low_gap = LowGap();
    const Eigen::ArrayXd high_gap = HighGap();
    Eigen::VectorXd row_sums = Eigen::VectorXd::Zero(variables_);
    Scatter(row_sums);
    Eigen::VectorXd right = -residual_ - row_sums;
    right.array() += low_target / low_gap - high_target / high_gap;
    Step step;
    step.d = normal_.Solve(right);
    step.low = (low_target - low_ * step.d.array()) / low_gap;
    step.high = (high_target + high_ * step.d.array()) / high_gap;
    double primal =
        std::max(WorstRatio(low_gap, step.d.array()), WorstRatio(high_gap, -step.d.array()));
    double dual = std::max(WorstRatio(low_, step.low), WorstRatio(high_, step.high));
    DirectRows(step, primal, dual);
    step.primal = StepFor(primal, share, most);
    step.dual = StepFor(dual, share, most);
    return step;
  }

  void DirectRows(Step& step, double& worst_primal, double& worst_dual) {
    ForParts([&](std::size_t part) { DirectPart(step.d, part); });
    for (const PartSums& sums : sums_) {
      worst_primal = std::max(worst_primal, sums.worst_primal);
      worst_dual = std::max(worst_dual, sums.worst_dual);
      step.by_primal += sums.by_primal;
      step.by_dual += sums.by_dual;
      step.by_both += sums.by_both;
    }
  }

  void DirectPart(const Eigen::VectorXd& change, std::size_t part) {
    Lane primal = Lane::Zero();
    Lane dual = Lane::Zero();
    Lane by_primal = Lane::Zero();
    Lane by_dual = Lane::Zero();
    Lane by_both = Lane::Zero();
    for (const RowGroup& group : GroupsOf(part)) {
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
    PartSums& sums = sums_[part];
    sums.worst_primal = primal.maxCoeff();
    sums.worst_dual = dual.maxCoeff();
    sums.by_primal = by_primal.sum();
    sums.by_dual = by_dual.sum();
    sums.by_both = by_both.sum();
  }

  void Iterate() {
    Factorise();
    const Step step =
        to_.centrality > 0.0
            ? Correct(std::max(kCentring * Complementarity() / Products(), least_mu_), nullptr)
            : PredictAndCorrect();
    was_whole_ = step.primal == 1.0 && step.dual == 1.0;
    Advance(step);
  }

  // How far the predictor gets tells how much to centre.
  Step PredictAndCorrect() {
    const Step affine = Predict();
    const double p = affine.primal;
    const double q = affine.dual;
    const double now = Complementarity();
    const double then = row_complementarity_ + affine.by_primal * p + affine.by_dual * q +
                        affine.by_both * p * q +
                        ((LowGap() + p * affine.d.array()) * (low_ + q * affine.low)).sum() +
                        ((HighGap() - p * affine.d.array()) * (high_ + q * affine.high)).sum();
    const double ratio = std::max(0.0, then / now);
    return Correct(ratio * ratio * ratio * now / Products(), &affine);
  }

  void Advance(const Step& step) {
    d_ += step.primal * step.d;
    low_ += step.dual * step.low;
    high_ += step.dual * step.high;
    residual_ = program_.gradient + program_.hessian.cwiseProduct(d_);
    residual_.array() += high_ - low_;
    ForParts([&](std::size_t part) {
      AdvancePart(static_cast<Real>(step.primal), static_cast<Real>(step.dual), part);
    });
    Scatter(residual_);
    row_complementarity_ = excess_ = 0.0;
    for (const PartSums& sums : sums_) {
      row_complementarity_ += sums.complementarity;
      excess_ += sums.excess;
    }
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
    sums_[part].complementarity = complementarity.sum();
    sums_[part].excess = excess.sum();
  }

  const PenaltyProgram& program_;
  SolveTo to_;
  ShortLoops& loops_;
  RowTable<Real>& rows_;
  NormalBlocks& normal_;
  Eigen::Index variables_;
  std::vector<PartSums> sums_;         // by part
  std::vector<GroupSums> group_sums_;  // by group
  double width_ = 0.0;
  double most_ = 0.0;  // that a variable can win
  Eigen::VectorXd d_, residual_;
  Eigen::ArrayXd low_, high_;
  double least_mu_ = 0.0;   // complementarity that is kept
  bool was_whole_ = false;  // the last step
  double start_excess_ = 0.0;
  double row_complementarity_ = 0.0;
  double excess_ = 0.0;  // what the rows' slacks cost
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_INTERIOR_POINT_H_
