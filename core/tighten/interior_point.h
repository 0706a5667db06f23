// The method that solves penalty programmes: interior points, rows in floats or doubles.
#ifndef CAPFIT_CORE_TIGHTEN_INTERIOR_POINT_H_
#define CAPFIT_CORE_TIGHTEN_INTERIOR_POINT_H_

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/short_loops.h"
#include "core/tighten/normal_blocks.h"
#include "core/tighten/penalty_program.h"
#include "core/tighten/row_iterate.h"
#include "core/tighten/row_table.h"

namespace capfit::tighten {

// Primal and dual, with predictor and corrector: changes of the variables d and of the multipliers
// `low` and `high` of their bounds, in doubles, while RowIterate carries the rows.
template <typename Real>
class InteriorPoint {
 public:
  // `rows`: of the programme. `normal`: for their groups.
  InteriorPoint(const PenaltyProgram& program, const SolveTo& to, ShortLoops& loops,
                RowTable<Real>& rows, NormalBlocks& normal)
      : program_(program),
        to_(to),
        rows_(rows, loops),
        normal_(normal),
        variables_(program.gradient.size()) {
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
    d_ = std::move(d);
    rows_.StartOnPath(d_, least_mu_);
    StartBounds(least_mu_);
    for (int i = 0; i < kPolishing; ++i) Iterate();
    return d_;
  }

 private:
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

  struct Step {
    Eigen::VectorXd d;
    Eigen::ArrayXd low, high;
    double primal = 0.0;  // how far it goes
    double dual = 0.0;
    RowStep rows{};
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
    start_excess_ = rows_.Start(mu, (is_to_centre ? kFirstSlackToCentre : kFirstSlack) * width_);
    StartBounds(mu);
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
    return at_rows_.complementarity + (LowGap() * low_).sum() + (HighGap() * high_).sum();
  }

  double Products() const { return static_cast<double>(2 * (rows_.size() + variables_)); }

  bool IsDone() const {
    if (to_.centrality > 0.0) {
      const double wanted = Products() * least_mu_;
      return was_whole_ && std::abs(Complementarity() - wanted) <= kAtCentre * wanted;
    }
    const double won = start_excess_ - at_rows_.excess - program_.gradient.dot(d_) -
                       0.5 * d_.dot(program_.hessian.cwiseProduct(d_));
    const double floor = 1e-9 * program_.gradient.cwiseAbs().maxCoeff() * width_;
    const double allowed = to_.relative_gap * std::max(won, 0.0) + floor;
    return Complementarity() <= allowed && residual_.cwiseAbs().sum() * width_ <= allowed;
  }

  // The normal matrix: everything but d eliminated. Lower half.
  void Factorise() {
    rows_.Weigh(normal_);
    normal_.Factorise((program_.hessian.array() + low_ / LowGap() + high_ / HighGap()).matrix());
  }

  // Straight for zero complementarity.
  Step Predict() {
    Eigen::VectorXd row_sums = Eigen::VectorXd::Zero(variables_);
    rows_.AimAtZero(row_sums);
    return Direction(row_sums, -LowGap() * low_, -HighGap() * high_, 1.0, 1.0);
  }

  // For the complementarity `mu` everywhere; after a predictor with what its step would leave over.
  Step Correct(double mu, const Step* predicted) {
    Eigen::VectorXd row_sums = Eigen::VectorXd::Zero(variables_);
    rows_.AimAt(mu, predicted != nullptr, row_sums);
    Eigen::ArrayXd low_target = mu - LowGap() * low_;
    Eigen::ArrayXd high_target = mu - HighGap() * high_;
    if (predicted != nullptr) {
      low_target -= predicted->d.array() * predicted->low;
      high_target += predicted->d.array() * predicted->high;
    }
    return Direction(row_sums, low_target, high_target, kOfTheWay,
                     predicted != nullptr ? kOfAWhole : 1.0);
  }

  // Solves for targets of the complementarity products: what each should change by. The step is
  // `most` at most, and goes `share` of the way to the boundary at most.
  Step Direction(const Eigen::VectorXd& row_sums, const Eigen::ArrayXd& low_target,
                 const Eigen::ArrayXd& high_target, double share, double most) {
    const Eigen::ArrayXd low_gap = LowGap();
    const Eigen::ArrayXd high_gap = HighGap();
    Eigen::VectorXd right = -residual_ - row_sums;
    right.array() += low_target / low_gap - high_target / high_gap;
    Step step;
    step.d = normal_.Solve(right);
    step.low = (low_target - low_ * step.d.array()) / low_gap;
    step.high = (high_target + high_ * step.d.array()) / high_gap;
    step.rows = rows_.Direct(step.d);
    const double primal = std::max({WorstRatio(low_gap, step.d.array()),
                                    WorstRatio(high_gap, -step.d.array()), step.rows.worst_primal});
    const double dual =
        std::max({WorstRatio(low_, step.low), WorstRatio(high_, step.high), step.rows.worst_dual});
    step.primal = StepFor(primal, share, most);
    step.dual = StepFor(dual, share, most);
    return step;
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
    const double then = at_rows_.complementarity + affine.rows.by_primal * p +
                        affine.rows.by_dual * q + affine.rows.by_both * p * q +
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
    at_rows_ = rows_.Advance(step.primal, step.dual, residual_);
  }

  const PenaltyProgram& program_;
  SolveTo to_;
  RowIterate<Real> rows_;
  NormalBlocks& normal_;
  Eigen::Index variables_;
  double width_ = 0.0;
  double most_ = 0.0;  // that a variable can win
  Eigen::VectorXd d_, residual_;
  Eigen::ArrayXd low_, high_;
  double least_mu_ = 0.0;   // complementarity that is kept
  bool was_whole_ = false;  // the last step
  double start_excess_ = 0.0;
  RowTotals at_rows_;
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_INTERIOR_POINT_H_
