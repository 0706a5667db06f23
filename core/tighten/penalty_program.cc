#include "core/tighten/penalty_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/tighten/normal_matrix.h"

namespace capfit::tighten {
namespace {

using Lane = Eigen::Array4d;
using Lanes = std::array<Lane, 8>;

constexpr int kMaxIterations = 40;
// Steps stop short of the boundary by this share.
constexpr double kStepBack = 0.99;
constexpr Eigen::Index kLane = 4;

// Rows that touch the same variables, [begin, end) in the solver's order, a whole number of lanes.
struct RowGroup {
  Eigen::Index begin = 0;
  Eigen::Index end = 0;
  int first_a = 0;
  int first_b = -1;
  // Its blocks of the normal matrix; the last where there is a second.
  NormalMatrix::Place a, b, across;
};

// The rows with their coefficients apart, group by group. Groups are filled up to whole lanes with
// rows that never bind.
struct RowTable {
  explicit RowTable(const PenaltyProgram& program) {
    const std::vector<PenaltyRow>& rows = program.rows;
    const std::vector<std::size_t> order = OrderOf(rows, program.gradient.size() / 4);
    const auto most = static_cast<Eigen::Index>(rows.size() + kLane * CountGroups(rows, order));
    coefficients.setZero(most, 8);
    value = Eigen::ArrayXd::Constant(most, -(program.upper - program.lower).maxCoeff());
    penalty = Eigen::ArrayXd::Ones(most);
    for (const std::size_t i : order) Append(rows[i]);
    CloseGroup();
    count = next_;
  }

  std::vector<RowGroup> groups;
  Eigen::ArrayXXd coefficients;  // a column for each of the eight
  Eigen::ArrayXd value, penalty;
  Eigen::Index count = 0;  // of rows in use

 private:
  // Indices of the rows, those of one group together, in the order in which they come: a counting
  // sort, as groups are few.
  static std::vector<std::size_t> OrderOf(const std::vector<PenaltyRow>& rows,
                                          Eigen::Index variable_groups) {
    const auto width = static_cast<std::size_t>(variable_groups) + 1;
    const auto key = [width](const PenaltyRow& row) {
      const int b = row.first[1] < 0 ? 0 : row.first[1] / 4 + 1;
      return static_cast<std::size_t>(row.first[0] / 4) * width + static_cast<std::size_t>(b);
    };
    std::vector<std::uint32_t> begin(width * width + 1, 0);
    for (const PenaltyRow& row : rows) ++begin[key(row) + 1];
    for (std::size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
    std::vector<std::size_t> order(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) order[begin[key(rows[i])]++] = i;
    return order;
  }

  static std::size_t CountGroups(const std::vector<PenaltyRow>& rows,
                                 const std::vector<std::size_t>& order) {
    std::size_t groups = 1;
    for (std::size_t i = 1; i < order.size(); ++i) {
      groups += rows[order[i]].first != rows[order[i - 1]].first ? 1 : 0;
    }
    return groups;
  }

  void Append(const PenaltyRow& row) {
    if (groups.empty() || groups.back().first_a != row.first[0] ||
        groups.back().first_b != row.first[1]) {
      CloseGroup();
      groups.push_back({next_, next_, row.first[0], row.first[1], {}, {}, {}});
    }
    for (Eigen::Index c = 0; c < 8; ++c) {
      coefficients(next_, c) = row.coefficients[static_cast<std::size_t>(c)];
    }
    value[next_] = row.value;
    penalty[next_] = row.penalty;
    ++next_;
  }

  void CloseGroup() {
    if (groups.empty()) return;
    // The rows that fill up cost as much as their neighbours, so that they converge like these.
    while (next_ % kLane != 0) penalty[next_] = penalty[next_ - 1], ++next_;
    groups.back().end = next_;
  }

  Eigen::Index next_ = 0;
};

// The longest step in [0, 1] for the largest of -change / value.
double StepFor(double worst) { return worst > 1.0 ? 1.0 / worst : 1.0; }

double WorstRatio(const Eigen::ArrayXd& value, const Eigen::ArrayXd& change) {
  return (-change / value).maxCoeff();
}

// Written with slacks s >= 0 and t = s - value - coefficients . d >= 0; multipliers `row` of t and
// penalty - row of s; `low` and `high` of the bounds. All loops over rows go lane by lane, once
// over the arrays for everything that a stage of the iteration needs.
class InteriorPoint {
 public:
  explicit InteriorPoint(const PenaltyProgram& program)
      : program_(program),
        variables_(program.gradient.size()),
        rows_(program),
        matrix_(variables_, TiedGroups()) {
    for (RowGroup& group : rows_.groups) {
      group.a = matrix_.PlaceOf(group.first_a, group.first_a);
      if (group.first_b < 0) continue;
      group.b = matrix_.PlaceOf(group.first_b, group.first_b);
      group.across = matrix_.PlaceOf(group.first_b, group.first_a);
    }
    width_ = (program_.upper - program_.lower).maxCoeff();
    Start();
  }

  Eigen::VectorXd Run(double relative_gap) {
    for (int i = 0; i < kMaxIterations && !IsDone(relative_gap); ++i) Iterate();
    return d_;
  }

 private:
  std::vector<std::pair<int, int>> TiedGroups() const {
    std::vector<std::pair<int, int>> pairs;
    for (const RowGroup& group : rows_.groups) {
      if (group.first_b >= 0) pairs.emplace_back(group.first_a, group.first_b);
    }
    return pairs;
  }

  // Changes of d and of the bounds' multipliers; those of the rows are in dt_, ds_ and drow_.
  struct Step {
    Eigen::VectorXd d;
    Eigen::ArrayXd low, high;
    double primal = 1.0;  // how far it may go
    double dual = 1.0;
    // Complementarity of the rows along it: by_primal * p + by_dual * q + by_both * p * q more.
    double by_primal = 0.0, by_dual = 0.0, by_both = 0.0;
  };

  // d = 0 satisfies the bounds, and slacks satisfy the rows: only the duals have to be found.
  void Start() {
    d_ = Eigen::VectorXd::Zero(variables_);
    // First complementarity: a tenth of what the gradient can win.
    const double mu = 0.1 * std::max(1e-12, program_.gradient.cwiseAbs().maxCoeff()) * width_;
    s_ = rows_.value.max(0.0) + 0.25 * width_;
    t_ = s_ - rows_.value;
    row_ = (mu / t_).min(0.5 * rows_.penalty);
    low_ = mu / (-program_.lower.array());
    high_ = mu / program_.upper.array();
    start_excess_ = (rows_.penalty * rows_.value.max(0.0)).head(rows_.count).sum();
    for (Eigen::ArrayXd* array :
         {&weight_, &inverse_row_, &inverse_slack_, &s_target_, &shift_, &dt_, &ds_, &drow_}) {
      array->setZero(rows_.value.size());
    }
    Advance({Eigen::VectorXd::Zero(variables_), Eigen::ArrayXd::Zero(variables_),
             Eigen::ArrayXd::Zero(variables_)});
  }

  Eigen::ArrayXd LowGap() const { return d_.array() - program_.lower.array(); }
  Eigen::ArrayXd HighGap() const { return program_.upper.array() - d_.array(); }

  double Complementarity() const {
    return row_complementarity_ + (LowGap() * low_).sum() + (HighGap() * high_).sum();
  }

  bool IsDone(double relative_gap) const {
    const double won = start_excess_ - excess_ - program_.gradient.dot(d_) -
                       0.5 * d_.dot(program_.hessian.cwiseProduct(d_));
    const double floor = 1e-9 * program_.gradient.cwiseAbs().maxCoeff() * width_;
    const double allowed = relative_gap * std::max(won, 0.0) + floor;
    return Complementarity() <= allowed && residual_.cwiseAbs().sum() * width_ <= allowed;
  }

  Lane At(const Eigen::ArrayXd& array, Eigen::Index k) const { return array.segment<kLane>(k); }
  Lane Coefficient(Eigen::Index k, Eigen::Index c) const {
    return rows_.coefficients.col(c).segment<kLane>(k);
  }

  void AddWeighted(Eigen::Index k, const Lane& weight, Lanes& sums) const {
    for (Eigen::Index c = 0; c < 8; ++c) {
      sums[static_cast<std::size_t>(c)] += weight * Coefficient(k, c);
    }
  }
  static void Scatter(const RowGroup& group, const Lanes& sums, Eigen::VectorXd& to) {
    for (int c = 0; c < 4; ++c) {
      to[group.first_a + c] += sums[static_cast<std::size_t>(c)].sum();
      if (group.first_b >= 0) to[group.first_b + c] += sums[static_cast<std::size_t>(4 + c)].sum();
    }
  }
  static Lanes NoLanes() {
    Lanes lanes;
    lanes.fill(Lane::Zero());
    return lanes;
  }

  // The normal matrix: everything but d eliminated. Lower half.
  void Factorise() {
    matrix_.Reset((program_.hessian.array() + low_ / LowGap() + high_ / HighGap()).matrix());
    for (const RowGroup& group : rows_.groups) {
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const Lane inverse_row = At(row_, k).inverse();
        const Lane inverse_slack = (At(rows_.penalty, k) - At(row_, k)).inverse();
        inverse_row_.segment<kLane>(k) = inverse_row;
        inverse_slack_.segment<kLane>(k) = inverse_slack;
        weight_.segment<kLane>(k) = (At(t_, k) * inverse_row + At(s_, k) * inverse_slack).inverse();
      }
      AddBlock(group, 0, 0, group.a);
      if (group.first_b < 0) continue;
      AddBlock(group, 4, 4, group.b);
      AddBlock(group, 4, 0, group.across);
    }
    matrix_.Factorise();
  }

  // Weighted products of four columns of coefficients with four others, summed over a group.
  void AddBlock(const RowGroup& group, Eigen::Index left, Eigen::Index right,
                const NormalMatrix::Place& place) {
    Eigen::Matrix4d block;
    for (Eigen::Index i = 0; i < 4; ++i) {
      std::array<Lane, 4> sums;
      sums.fill(Lane::Zero());
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const Lane weighted = At(weight_, k) * Coefficient(k, left + i);
        for (Eigen::Index j = 0; j < 4; ++j) {
          sums[static_cast<std::size_t>(j)] += weighted * Coefficient(k, right + j);
        }
      }
      for (Eigen::Index j = 0; j < 4; ++j) block(i, j) = sums[static_cast<std::size_t>(j)].sum();
    }
    matrix_.Add(place, block);
  }

  // Straight for zero complementarity.
  Step Predict() {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(variables_);
    for (const RowGroup& group : rows_.groups) {
      Lanes lanes = NoLanes();
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const Lane slack = At(rows_.penalty, k) - At(row_, k);
        s_target_.segment<kLane>(k) = -At(s_, k) * slack;
        const Lane shift = At(weight_, k) * (At(s_, k) - At(t_, k));
        shift_.segment<kLane>(k) = shift;
        AddWeighted(k, shift, lanes);
      }
      Scatter(group, lanes, sums);
    }
    return Direction(sums, -LowGap() * low_, -HighGap() * high_);
  }

  // For the complementarity `mu` everywhere, with what the predictor's step would leave over.
  Step Correct(double mu, const Step& affine) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(variables_);
    for (const RowGroup& group : rows_.groups) {
      Lanes lanes = NoLanes();
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const Lane slack = At(rows_.penalty, k) - At(row_, k);
        const Lane t_target = mu - At(t_, k) * At(row_, k) - At(dt_, k) * At(drow_, k);
        const Lane s_target = mu - At(s_, k) * slack + At(ds_, k) * At(drow_, k);
        s_target_.segment<kLane>(k) = s_target;
        const Lane shift =
            At(weight_, k) * (t_target * At(inverse_row_, k) - s_target * At(inverse_slack_, k));
        shift_.segment<kLane>(k) = shift;
        AddWeighted(k, shift, lanes);
      }
      Scatter(group, lanes, sums);
    }
    return Direction(sums, mu - LowGap() * low_ - affine.d.array() * affine.low,
                     mu - HighGap() * high_ + affine.d.array() * affine.high);
  }

  // Solves for targets of the complementarity products: what each should change by.
  Step Direction(const Eigen::VectorXd& row_sums, const Eigen::ArrayXd& low_target,
                 const Eigen::ArrayXd& high_target) {
    const Eigen::ArrayXd low_gap = LowGap();
    const Eigen::ArrayXd high_gap = HighGap();
    Eigen::VectorXd right = -residual_ - row_sums;
    right.array() += low_target / low_gap - high_target / high_gap;
    Step step;
    step.d = matrix_.Solve(right);
    step.low = (low_target - low_ * step.d.array()) / low_gap;
    step.high = (high_target + high_ * step.d.array()) / high_gap;
    double primal =
        std::max(WorstRatio(low_gap, step.d.array()), WorstRatio(high_gap, -step.d.array()));
    double dual = std::max(WorstRatio(low_, step.low), WorstRatio(high_, step.high));
    DirectRows(step, primal, dual);
    step.primal = StepFor(primal);
    step.dual = StepFor(dual);
    return step;
  }

  void DirectRows(Step& step, double& worst_primal, double& worst_dual) {
    Lane primal = Lane::Zero();
    Lane dual = Lane::Zero();
    Lane by_primal = Lane::Zero();
    Lane by_dual = Lane::Zero();
    Lane by_both = Lane::Zero();
    for (const RowGroup& group : rows_.groups) {
      std::array<double, 8> d{};
      for (int c = 0; c < 4; ++c) {
        d[static_cast<std::size_t>(c)] = step.d[group.first_a + c];
        if (group.first_b >= 0) d[static_cast<std::size_t>(4 + c)] = step.d[group.first_b + c];
      }
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        Lane product = Lane::Zero();
        for (Eigen::Index c = 0; c < 8; ++c) {
          product += d[static_cast<std::size_t>(c)] * Coefficient(k, c);
        }
        const Lane s = At(s_, k);
        const Lane t = At(t_, k);
        const Lane row = At(row_, k);
        const Lane inverse_slack = At(inverse_slack_, k);
        const Lane drow = At(weight_, k) * product + At(shift_, k);
        const Lane ds = (At(s_target_, k) + s * drow) * inverse_slack;
        const Lane dt = ds - product;
        drow_.segment<kLane>(k) = drow;
        ds_.segment<kLane>(k) = ds;
        dt_.segment<kLane>(k) = dt;
        primal = primal.max(-dt / t).max(-ds / s);
        dual = dual.max(-drow * At(inverse_row_, k)).max(drow * inverse_slack);
        by_primal += dt * row + ds * (At(rows_.penalty, k) - row);
        by_dual += drow * (t - s);
        by_both += drow * (dt - ds);
      }
    }
    worst_primal = std::max(worst_primal, primal.maxCoeff());
    worst_dual = std::max(worst_dual, dual.maxCoeff());
    step.by_primal = by_primal.sum();
    step.by_dual = by_dual.sum();
    step.by_both = by_both.sum();
  }

  void Iterate() {
    Factorise();
    // How far the predictor gets tells how much to centre.
    const Step affine = Predict();
    const double p = affine.primal;
    const double q = affine.dual;
    const double now = Complementarity();
    const double then = row_complementarity_ + affine.by_primal * p + affine.by_dual * q +
                        affine.by_both * p * q +
                        ((LowGap() + p * affine.d.array()) * (low_ + q * affine.low)).sum() +
                        ((HighGap() - p * affine.d.array()) * (high_ + q * affine.high)).sum();
    const double ratio = std::max(0.0, then / now);
    const double products = static_cast<double>(2 * (rows_.count + variables_));
    Step step = Correct(ratio * ratio * ratio * now / products, affine);
    step.primal *= kStepBack;
    step.dual *= kStepBack;
    Advance(step);
  }

  void Advance(const Step& step) {
    d_ += step.primal * step.d;
    low_ += step.dual * step.low;
    high_ += step.dual * step.high;
    residual_ = program_.gradient + program_.hessian.cwiseProduct(d_);
    residual_.array() += high_ - low_;
    Lane complementarity = Lane::Zero();
    Lane excess = Lane::Zero();
    for (const RowGroup& group : rows_.groups) {
      Lanes lanes = NoLanes();
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const Lane t = At(t_, k) + step.primal * At(dt_, k);
        const Lane s = At(s_, k) + step.primal * At(ds_, k);
        const Lane row = At(row_, k) + step.dual * At(drow_, k);
        const Lane penalty = At(rows_.penalty, k);
        t_.segment<kLane>(k) = t;
        s_.segment<kLane>(k) = s;
        row_.segment<kLane>(k) = row;
        complementarity += t * row + s * (penalty - row);
        excess += penalty * s;
        AddWeighted(k, row, lanes);
      }
      Scatter(group, lanes, residual_);
    }
    row_complementarity_ = complementarity.sum();
    excess_ = excess.sum();
  }

  const PenaltyProgram& program_;
  Eigen::Index variables_;
  RowTable rows_;
  NormalMatrix matrix_;
  double width_ = 0.0;
  Eigen::VectorXd d_, residual_;
  Eigen::ArrayXd t_, s_, row_, low_, high_;
  Eigen::ArrayXd weight_, inverse_row_, inverse_slack_, s_target_, shift_, dt_, ds_, drow_;
  double start_excess_ = 0.0;
  double row_complementarity_ = 0.0;
  double excess_ = 0.0;  // what the rows' slacks cost
};

}  // namespace

Eigen::VectorXd Solve(const PenaltyProgram& program, double relative_gap) {
  return InteriorPoint(program).Run(relative_gap);
}

}  // namespace capfit::tighten
