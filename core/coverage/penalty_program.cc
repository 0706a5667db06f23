#include "core/coverage/penalty_program.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace capfit::coverage {
namespace {

constexpr int kMaxIterations = 40;
// Steps stop short of the boundary by this share.
constexpr double kStepBack = 0.99;

// Written with slacks s >= 0 and t = s - value - coefficients . d >= 0; multipliers `row` of t and
// penalty - row of s; `low` and `high` of the bounds.
class InteriorPoint {
 public:
  explicit InteriorPoint(const PenaltyProgram& program)
      : program_(program),
        variables_(program.gradient.size()),
        rows_(static_cast<Eigen::Index>(program.rows.size())) {
    Start();
  }

  Eigen::VectorXd Run(double relative_gap) {
    for (int i = 0; i < kMaxIterations && !IsDone(relative_gap); ++i) Iterate();
    return d_;
  }

 private:
  // Direction of all unknowns.
  struct Step {
    Eigen::VectorXd d;
    Eigen::ArrayXd t, s, row, low, high;
  };

  // d = 0 satisfies the bounds, and slacks satisfy the rows: only the duals have to be found.
  void Start() {
    d_ = Eigen::VectorXd::Zero(variables_);
    penalty_.resize(rows_);
    value_.resize(rows_);
    for (Eigen::Index k = 0; k < rows_; ++k) {
      penalty_[k] = program_.rows[static_cast<std::size_t>(k)].penalty;
      value_[k] = program_.rows[static_cast<std::size_t>(k)].value;
    }
    const double width = (program_.upper - program_.lower).maxCoeff();
    const double scale = std::max(1e-12, program_.gradient.cwiseAbs().maxCoeff()) * width;
    // First complementarity: a tenth of what the gradient can win.
    const double mu = 0.1 * scale;
    s_ = value_.max(0.0) + 0.25 * width;
    t_ = s_ - value_;
    row_ = (mu / t_).min(0.5 * penalty_);
    low_ = mu / (-program_.lower.array());
    high_ = mu / program_.upper.array();
    start_excess_ = (penalty_ * value_.max(0.0)).sum();
  }

  Eigen::ArrayXd LowGap() const { return d_.array() - program_.lower.array(); }
  Eigen::ArrayXd HighGap() const { return program_.upper.array() - d_.array(); }

  double Complementarity() const {
    return (t_ * row_).sum() + (s_ * (penalty_ - row_)).sum() + (LowGap() * low_).sum() +
           (HighGap() * high_).sum();
  }

  Eigen::VectorXd DualResidual() const {
    Eigen::VectorXd residual = program_.gradient + program_.hessian.cwiseProduct(d_);
    residual.array() += high_ - low_;
    AddRows(row_, residual);
    return residual;
  }

  bool IsDone(double relative_gap) const {
    const double won = start_excess_ - (penalty_ * s_).sum() - program_.gradient.dot(d_) -
                       0.5 * d_.dot(program_.hessian.cwiseProduct(d_));
    const double width = (program_.upper - program_.lower).maxCoeff();
    const double floor = 1e-9 * program_.gradient.cwiseAbs().maxCoeff() * width;
    const double allowed = relative_gap * std::max(won, 0.0) + floor;
    return Complementarity() <= allowed && DualResidual().cwiseAbs().sum() * width <= allowed;
  }

  // sum over rows of weight * coefficients.
  void AddRows(const Eigen::ArrayXd& weights, Eigen::VectorXd& sum) const {
    for (Eigen::Index k = 0; k < rows_; ++k) {
      const PenaltyRow& row = program_.rows[static_cast<std::size_t>(k)];
      const Eigen::Map<const Eigen::Matrix<double, 8, 1>> c(row.coefficients.data());
      sum.segment<4>(row.first[0]) += weights[k] * c.head<4>();
      if (row.first[1] >= 0) sum.segment<4>(row.first[1]) += weights[k] * c.tail<4>();
    }
  }

  Eigen::ArrayXd RowProducts(const Eigen::VectorXd& d) const {
    Eigen::ArrayXd products(rows_);
    for (Eigen::Index k = 0; k < rows_; ++k) {
      const PenaltyRow& row = program_.rows[static_cast<std::size_t>(k)];
      const Eigen::Map<const Eigen::Matrix<double, 8, 1>> c(row.coefficients.data());
      products[k] = c.head<4>().dot(d.segment<4>(row.first[0]));
      if (row.first[1] >= 0) products[k] += c.tail<4>().dot(d.segment<4>(row.first[1]));
    }
    return products;
  }

  // The normal matrix: everything but d eliminated. Lower half.
  void Factorise() {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(variables_, variables_);
    matrix.diagonal() = program_.hessian;
    matrix.diagonal().array() += low_ / LowGap() + high_ / HighGap();
    weight_ = 1.0 / (t_ / row_ + s_ / (penalty_ - row_));
    for (Eigen::Index k = 0; k < rows_; ++k) {
      const PenaltyRow& row = program_.rows[static_cast<std::size_t>(k)];
      const Eigen::Map<const Eigen::Matrix<double, 8, 1>> c(row.coefficients.data());
      const Eigen::Vector4d head = weight_[k] * c.head<4>();
      matrix.block<4, 4>(row.first[0], row.first[0]).noalias() += head * c.head<4>().transpose();
      if (row.first[1] < 0) continue;
      const Eigen::Vector4d tail = weight_[k] * c.tail<4>();
      matrix.block<4, 4>(row.first[1], row.first[1]).noalias() += tail * c.tail<4>().transpose();
      if (row.first[1] > row.first[0]) {
        matrix.block<4, 4>(row.first[1], row.first[0]).noalias() += tail * c.head<4>().transpose();
      } else {
        matrix.block<4, 4>(row.first[0], row.first[1]).noalias() += head * c.tail<4>().transpose();
      }
    }
    factor_.compute(matrix);
  }

  // Solves for targets of the complementarity products: what each should change by.
  Step Direction(const Eigen::VectorXd& residual, const Eigen::ArrayXd& t_target,
                 const Eigen::ArrayXd& s_target, const Eigen::ArrayXd& low_target,
                 const Eigen::ArrayXd& high_target) const {
    const Eigen::ArrayXd slack = penalty_ - row_;
    const Eigen::ArrayXd shift = weight_ * (t_target / row_ - s_target / slack);
    Eigen::VectorXd right = -residual;
    right.array() += low_target / LowGap() - high_target / HighGap();
    Eigen::VectorXd rows = Eigen::VectorXd::Zero(variables_);
    AddRows(shift, rows);
    Step step;
    step.d = factor_.solve(right - rows);
    const Eigen::ArrayXd products = RowProducts(step.d);
    step.row = weight_ * products + shift;
    step.s = (s_target + s_ * step.row) / slack;
    step.t = step.s - products;
    step.low = (low_target - low_ * step.d.array()) / LowGap();
    step.high = (high_target + high_ * step.d.array()) / HighGap();
    return step;
  }

  static double MaxStep(const Eigen::ArrayXd& value, const Eigen::ArrayXd& change, double longest) {
    for (Eigen::Index i = 0; i < value.size(); ++i) {
      if (value[i] + longest * change[i] < 0.0) longest = -value[i] / change[i];
    }
    return longest;
  }
  double PrimalStep(const Step& step) const {
    double longest = MaxStep(t_, step.t, 1.0);
    longest = MaxStep(s_, step.s, longest);
    longest = MaxStep(LowGap(), step.d.array(), longest);
    return MaxStep(HighGap(), -step.d.array(), longest);
  }
  double DualStep(const Step& step) const {
    double longest = MaxStep(row_, step.row, 1.0);
    longest = MaxStep(penalty_ - row_, -step.row, longest);
    longest = MaxStep(low_, step.low, longest);
    return MaxStep(high_, step.high, longest);
  }

  void Iterate() {
    Factorise();
    const Eigen::VectorXd residual = DualResidual();
    const Eigen::ArrayXd slack = penalty_ - row_;
    const Eigen::ArrayXd low_gap = LowGap();
    const Eigen::ArrayXd high_gap = HighGap();
    // Predictor: straight for zero complementarity. How far it gets tells how much to centre.
    const Step affine =
        Direction(residual, -t_ * row_, -s_ * slack, -low_gap * low_, -high_gap * high_);
    const double primal = PrimalStep(affine);
    const double dual = DualStep(affine);
    const double now = Complementarity();
    const double then =
        ((t_ + primal * affine.t) * (row_ + dual * affine.row)).sum() +
        ((s_ + primal * affine.s) * (slack - dual * affine.row)).sum() +
        ((low_gap + primal * affine.d.array()) * (low_ + dual * affine.low)).sum() +
        ((high_gap - primal * affine.d.array()) * (high_ + dual * affine.high)).sum();
    const double ratio = std::max(0.0, then / now);
    const double mu = ratio * ratio * ratio * now / static_cast<double>(2 * (rows_ + variables_));
    const Step step = Direction(residual, mu - t_ * row_ - affine.t * affine.row,
                                mu - s_ * slack + affine.s * affine.row,
                                mu - low_gap * low_ - affine.d.array() * affine.low,
                                mu - high_gap * high_ + affine.d.array() * affine.high);
    Advance(step, kStepBack * PrimalStep(step), kStepBack * DualStep(step));
  }

  void Advance(const Step& step, double primal, double dual) {
    d_ += primal * step.d;
    t_ += primal * step.t;
    s_ += primal * step.s;
    row_ += dual * step.row;
    low_ += dual * step.low;
    high_ += dual * step.high;
  }

  const PenaltyProgram& program_;
  Eigen::Index variables_;
  Eigen::Index rows_;
  Eigen::VectorXd d_;
  Eigen::ArrayXd penalty_, value_, t_, s_, row_, low_, high_, weight_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  double start_excess_ = 0.0;
};

}  // namespace

Eigen::VectorXd Solve(const PenaltyProgram& program, double relative_gap) {
  return InteriorPoint(program).Run(relative_gap);
}

}  // namespace capfit::coverage
