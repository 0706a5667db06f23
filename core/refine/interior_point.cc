#include "core/refine/interior_point.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace capfit::refine {
namespace {

using Array = Eigen::ArrayXd;
using Vector = Eigen::VectorXd;
using Vector8 = Eigen::Matrix<double, 8, 1>;

constexpr double kStayInside = 0.995;  // of the way to the border

// A x.
Vector Times(const StepProblem& p, const Vector& x) {
  Vector y(p.offsets.size());
  for (const RowGroup& g : p.groups) {
    Vector8 ends = Vector8::Zero();
    if (g.block_a >= 0) ends.head<4>() = x.segment<4>(4 * g.block_a);
    if (g.block_b >= 0) ends.tail<4>() = x.segment<4>(4 * g.block_b);
    const int rows = g.end - g.begin;
    y.segment(g.begin, rows).noalias() = p.coefficients.middleRows(g.begin, rows) * ends;
  }
  return y;
}

// A' y.
Vector TransposedTimes(const StepProblem& p, const Vector& y) {
  Vector x = Vector::Zero(p.gradient.size());
  for (const RowGroup& g : p.groups) {
    const int rows = g.end - g.begin;
    const Vector8 ends =
        p.coefficients.middleRows(g.begin, rows).transpose() * y.segment(g.begin, rows);
    if (g.block_a >= 0) x.segment<4>(4 * g.block_a) += ends.head<4>();
    if (g.block_b >= 0) x.segment<4>(4 * g.block_b) += ends.tail<4>();
  }
  return x;
}

// Adds A' diag(weights) A.
void AddGram(const StepProblem& p, const Array& weights, Eigen::MatrixXd& matrix) {
  Eigen::Matrix<double, Eigen::Dynamic, 8> scaled;
  for (const RowGroup& g : p.groups) {
    const int rows = g.end - g.begin;
    const auto block = p.coefficients.middleRows(g.begin, rows);
    scaled = block.array().colwise() * weights.segment(g.begin, rows);
    const Eigen::Matrix<double, 8, 8> gram = scaled.transpose().lazyProduct(block);
    const int a = 4 * g.block_a, b = 4 * g.block_b;
    if (a >= 0) matrix.block<4, 4>(a, a) += gram.topLeftCorner<4, 4>();
    if (b >= 0) matrix.block<4, 4>(b, b) += gram.bottomRightCorner<4, 4>();
    if (a >= 0 && b >= 0) {
      matrix.block<4, 4>(b, a) += gram.bottomLeftCorner<4, 4>();
      matrix.block<4, 4>(a, b) += gram.topRightCorner<4, 4>();
    }
  }
}

// The longest step in [0, 1] that keeps x + step * dx >= 0.
double StepTo(const Array& x, const Array& dx) {
  if (x.size() == 0) return 1.0;
  const double worst = (-dx / x).maxCoeff();
  return worst > 1.0 ? 1.0 / worst : 1.0;
}

// The iterates: row slacks s and w = s - A d - c with their duals mu and lambda
// (lambda + mu = penalty), distances to the bounds with theirs.
class Solver {
 public:
  Solver(const StepProblem& problem, double gap_share)
      : p_(problem), gap_share_(gap_share), d_(0.5 * (problem.low + problem.high)) {
    const double reach = 0.5 * (p_.high - p_.low).maxCoeff();
    const Array value = (Times(p_, d_) + p_.offsets).array();
    s_ = value.max(0.0) + 0.2 * reach;
    w_ = s_ - value;
    const auto rows = static_cast<double>(std::max<Eigen::Index>(1, value.size()));
    const double first = std::min(0.1 * p_.penalty, p_.gradient.lpNorm<1>() / rows);
    lambda_ = Array::Constant(value.size(), std::max(first, 1e-9 * p_.penalty));
    mu_ = p_.penalty - lambda_;
    dual_scale_ = std::max(1e-6, p_.gradient.cwiseAbs().mean());
    low_dual_ = high_dual_ = Array::Constant(d_.size(), dual_scale_);
  }

  bool Iterate() {
    to_low_ = (d_ - p_.low).array();
    to_high_ = (p_.high - d_).array();
    const double gap = Gap();
    residual_ = p_.gradient + p_.curvature.cwiseProduct(d_) + TransposedTimes(p_, lambda_.matrix());
    residual_ += (high_dual_ - low_dual_).matrix();
    if (gap < gap_share_ * std::max(Objective(), 1e-9) &&
        residual_.lpNorm<Eigen::Infinity>() < 0.01 * dual_scale_) {
      return false;
    }
    Factor();
    PredictAndCorrect(gap);
    Move();
    return true;
  }

  [[nodiscard]] StepSolution Solution() const {
    StepSolution solution{d_, lambda_.matrix(), 0.0};
    const Array after = (Times(p_, d_) + p_.offsets).array();
    solution.predicted_change =
        p_.gradient.dot(d_) + 0.5 * d_.dot(p_.curvature.cwiseProduct(d_)) +
        p_.penalty * (after.max(0.0).sum() - p_.offsets.array().max(0.0).sum());
    return solution;
  }

 private:
  [[nodiscard]] double Gap() const {
    return (lambda_ * w_).sum() + (mu_ * s_).sum() + (low_dual_ * to_low_).sum() +
           (high_dual_ * to_high_).sum();
  }

  [[nodiscard]] double Objective() const {
    return std::abs(p_.gradient.dot(d_)) + 0.5 * d_.dot(p_.curvature.cwiseProduct(d_)) +
           p_.penalty * s_.sum();
  }

  void Factor() {
    denominator_ = w_ + lambda_ * s_ / mu_;
    weight_ = lambda_ / denominator_;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(d_.size(), d_.size());
    AddGram(p_, weight_, matrix);
    matrix.diagonal().array() +=
        p_.curvature.array() + low_dual_ / to_low_ + high_dual_ / to_high_ + 1e-12;
    factor_.compute(matrix);
  }

  void PredictAndCorrect(double gap) {
    const auto count = static_cast<double>(2 * s_.size() + 2 * d_.size());
    Array cw = Array::Zero(s_.size()), cs = cw;
    Array cl = Array::Zero(d_.size()), ch = cl;
    Direction(0.0, cw, cs, cl, ch);
    const double left =
        ((lambda_ + dual_step_ * d_lambda_) * (w_ + step_ * dw_)).sum() +
        ((mu_ - dual_step_ * d_lambda_) * (s_ + step_ * ds_)).sum() +
        ((low_dual_ + dual_step_ * d_low_) * (to_low_ + step_ * dd_.array())).sum() +
        ((high_dual_ + dual_step_ * d_high_) * (to_high_ - step_ * dd_.array())).sum();
    const double ratio = left / gap;
    cw = d_lambda_ * dw_;
    cs = -d_lambda_ * ds_;
    cl = d_low_ * dd_.array();
    ch = -d_high_ * dd_.array();
    Direction(ratio * ratio * ratio * gap / count, cw, cs, cl, ch);
  }

  // Newton's direction towards products of `target` less the second-order terms.
  void Direction(double target, const Array& cw, const Array& cs, const Array& cl,
                 const Array& ch) {
    const Array r1 = target - lambda_ * w_ - cw;
    const Array r2 = (target - mu_ * s_ - cs) / mu_;
    const Array beta = (r1 - lambda_ * r2) / denominator_;
    Vector rhs = -residual_ - TransposedTimes(p_, beta.matrix());
    rhs.array() += (target - cl) / to_low_ - low_dual_ - (target - ch) / to_high_ + high_dual_;
    dd_ = factor_.solve(rhs);
    const Array row_change = Times(p_, dd_).array();
    d_low_ = (target - cl - low_dual_ * dd_.array()) / to_low_ - low_dual_;
    d_high_ = (target - ch + high_dual_ * dd_.array()) / to_high_ - high_dual_;
    d_lambda_ = weight_ * row_change + beta;
    ds_ = r2 + s_ * d_lambda_ / mu_;
    dw_ = ds_ - row_change;
    step_ = std::min({StepTo(s_, ds_), StepTo(w_, dw_), StepTo(to_low_, dd_.array()),
                      StepTo(to_high_, -dd_.array())});
    dual_step_ = std::min({StepTo(lambda_, d_lambda_), StepTo(mu_, -d_lambda_),
                           StepTo(low_dual_, d_low_), StepTo(high_dual_, d_high_)});
  }

  void Move() {
    const double primal = std::min(1.0, kStayInside * step_);
    const double dual = std::min(1.0, kStayInside * dual_step_);
    d_ += primal * dd_;
    s_ += primal * ds_;
    w_ += primal * dw_;
    lambda_ += dual * d_lambda_;
    mu_ -= dual * d_lambda_;
    low_dual_ += dual * d_low_;
    high_dual_ += dual * d_high_;
  }

  const StepProblem& p_;
  double gap_share_;
  double dual_scale_ = 1.0;
  Vector d_, dd_, residual_;
  Array s_, w_, lambda_, mu_, low_dual_, high_dual_, to_low_, to_high_;
  Array denominator_, weight_, ds_, dw_, d_lambda_, d_low_, d_high_;
  double step_ = 1.0, dual_step_ = 1.0;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace

StepSolution SolveStep(const StepProblem& problem, double gap_share, int max_iterations) {
  Solver solver(problem, gap_share);
  for (int i = 0; i < max_iterations && solver.Iterate(); ++i) {
  }
  return solver.Solution();
}

}  // namespace capfit::refine
