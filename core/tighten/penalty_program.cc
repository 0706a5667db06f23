#include "core/tighten/penalty_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/tighten/normal_matrix.h"
#include "core/tighten/row_table.h"

namespace capfit::tighten {
namespace {

// Steps go no farther than this share of the way to the boundary.
constexpr double kOfTheWay = 0.99;
// After a predictor no farther than this share of a whole one either. (Whole ones serve a single
// programme as well, but the search for sets ends with 1 % more E_r at 48 to 128 primitives.)
constexpr double kOfAWhole = 0.99;
// Programmes that may be left so far from solved are reckoned in floats, twice as many at a time.
constexpr double kFloatGap = 0.01;
// First complementarity, relative to the most that a variable can win, and the least slack that
// rows start with, relative to the trust region's width. On the way to a point of the central path
// half of the slack saves two iterations of eleven; twice of it costs two.
constexpr double kFirstShare = 0.1;
constexpr double kFirstShareToCentre = 0.005;
constexpr double kFirstSlack = 0.25;
constexpr double kFirstSlackToCentre = 0.12;
// There each step aims at this share of the complementarity.
constexpr double kCentring = 0.01;
// It is reached when complementarity is so near to its own after a whole step: of those each
// doubles the digits that are right. Floats do not get much nearer; with 1e-4 and one iteration
// less three bodies of ten move by more than a hundredth of a millimetre when vertices are rounded
// to floats, with 1e-5 one.
constexpr double kAtCentre = 1e-5;
// Iterations in doubles from there: after one, the last digits are still those of floats.
constexpr int kPolishing = 2;

// The longest step in [0, most] that goes `share` of the way to the boundary at most; `worst` is
// the largest of -change / value.
double StepFor(double worst, double share, double most) {
  return most * worst > share ? share / worst : most;
}

double WorstRatio(const Eigen::ArrayXd& value, const Eigen::ArrayXd& change) {
  return (-change / value).maxCoeff();
}

// Written with slacks s >= 0 and t = s - value - coefficients . d >= 0; multipliers `row` of t and
// penalty - row of s; `low` and `high` of the bounds. All loops over rows go lane by lane, once
// over the arrays for everything that a stage of the iteration needs. Rows are in `Real`, what
// belongs to variables is in doubles.
template <typename Real>
class InteriorPoint {
 public:
  // `rows`: those of the programme.
  InteriorPoint(const PenaltyProgram& program, RowTable<Real> rows, const SolveTo& to)
      : program_(program),
        to_(to),
        variables_(program.gradient.size()),
        rows_(std::move(rows)),
        matrix_(variables_, TiedGroups()) {
    for (RowGroup& group : rows_.groups) {
      group.a = matrix_.PlaceOf(group.first_a, group.first_a);
      if (group.first_b < 0) continue;
      group.b = matrix_.PlaceOf(group.first_b, group.first_b);
      group.across = matrix_.PlaceOf(group.first_b, group.first_a);
    }
    width_ = (program_.upper - program_.lower).maxCoeff();
    most_ = std::max(1e-12, program_.gradient.cwiseAbs().maxCoeff()) * width_;
    least_mu_ = to_.centrality * most_;
    for (Array* array :
         {&weight_, &inverse_row_, &inverse_slack_, &s_target_, &shift_, &dt_, &ds_, &drow_}) {
      array->setZero(rows_.value.size());
    }
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
  using Array = typename RowTable<Real>::Array;
  using Lane = typename RowTable<Real>::Lane;
  using Lanes = typename RowTable<Real>::Lanes;
  static auto At(Array& array, Eigen::Index k) { return RowTable<Real>::At(array, k); }
  static Lane At(const Array& array, Eigen::Index k) { return RowTable<Real>::At(array, k); }

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
    double primal = 0.0;  // how far it goes
    double dual = 0.0;
    // Complementarity of the rows along it: by_primal * p + by_dual * q + by_both * p * q more.
    double by_primal = 0.0, by_dual = 0.0, by_both = 0.0;
  };

  // d = 0 satisfies the bounds, and slacks satisfy the rows: only the duals have to be found.
  void Start() {
    d_ = Eigen::VectorXd::Zero(variables_);
    const bool is_to_centre = to_.centrality > 0.0;
    const double mu = (is_to_centre ? kFirstShareToCentre : kFirstShare) * most_;
    const double slack = (is_to_centre ? kFirstSlackToCentre : kFirstSlack) * width_;
    s_ = rows_.value.max(Real{0}) + static_cast<Real>(slack);
    t_ = s_ - rows_.value;
    row_ = (static_cast<Real>(mu) / t_).min(Real{0.5} * rows_.penalty);
    start_excess_ = (rows_.penalty * rows_.value.max(Real{0})).head(rows_.count).sum();
    StartBounds(mu);
  }

  // Slacks and multipliers that belong to d where all their products are the centre's:
  // t * row = s * (penalty - row) = mu and s - t = the row's excess.
  void StartOnPath(Eigen::VectorXd d) {
    d_ = std::move(d);
    const auto mu = static_cast<Real>(least_mu_);
    t_ = s_ = row_ = Array::Zero(rows_.value.size());
    for (const RowGroup& group : rows_.groups) {
      const std::array<Real, 8> own = rows_.OwnPart(group, d_);
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const Lane penalty = At(rows_.penalty, k);
        const Lane cost = penalty * (At(rows_.value, k) + rows_.Product(k, own));
        // The root of the sum minus the cost without the difference of two large numbers.
        const Lane far = (cost.square() + 4 * mu * mu).sqrt() + cost.abs();
        const Lane near = (4 * mu * mu) / far;
        const auto is_out = cost > Real{0};
        At(t_, k) = (2 * mu + is_out.select(near, far)) / (2 * penalty);
        At(s_, k) = (2 * mu + is_out.select(far, near)) / (2 * penalty);
        At(row_, k) = mu / At(t_, k);
      }
    }
    StartBounds(least_mu_);
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

  double Products() const { return static_cast<double>(2 * (rows_.count + variables_)); }

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
    matrix_.Reset((program_.hessian.array() + low_ / LowGap() + high_ / HighGap()).matrix());
    for (const RowGroup& group : rows_.groups) {
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const Lane inverse_row = At(row_, k).inverse();
        const Lane inverse_slack = (At(rows_.penalty, k) - At(row_, k)).inverse();
        At(inverse_row_, k) = inverse_row;
        At(inverse_slack_, k) = inverse_slack;
        At(weight_, k) = (At(t_, k) * inverse_row + At(s_, k) * inverse_slack).inverse();
      }
      AddBlock(group, 0, 0, group.a);
      if (group.first_b < 0) continue;
      AddBlock(group, 4, 4, group.b);
      AddBlock(group, 4, 0, group.across);
    }
    matrix_.Factorise();
  }

  // Weighted products of four columns of coefficients with four others, summed over a group; two
  // rows of the block at a time, whose sums stay in registers.
  void AddBlock(const RowGroup& group, Eigen::Index left, Eigen::Index right,
                const NormalMatrix::Place& place) {
    Eigen::Matrix4d block = Eigen::Matrix4d::Zero();
    if (left == right) {  // of the diagonal the lower half is enough
      PutTwoRows<2>(group, left, right, block.topRows<2>());
    } else {
      PutTwoRows<4>(group, left, right, block.topRows<2>());
    }
    PutTwoRows<4>(group, left + 2, right, block.bottomRows<2>());
    matrix_.Add(place, block);
  }

  template <Eigen::Index kColumns, typename Rows>
  void PutTwoRows(const RowGroup& group, Eigen::Index left, Eigen::Index right, Rows&& rows) {
    std::array<Lane, kColumns> upper;
    std::array<Lane, kColumns> lower;
    upper.fill(Lane::Zero());
    lower.fill(Lane::Zero());
    for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
      const Lane weight = At(weight_, k);
      const Lane weighted_upper = weight * rows_.Coefficient(k, left);
      const Lane weighted_lower = weight * rows_.Coefficient(k, left + 1);
      for (Eigen::Index j = 0; j < kColumns; ++j) {
        const Lane other = rows_.Coefficient(k, right + j);
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
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(variables_);
    for (const RowGroup& group : rows_.groups) {
      Lanes lanes = RowTable<Real>::NoLanes();
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const Lane slack = At(rows_.penalty, k) - At(row_, k);
        At(s_target_, k) = -At(s_, k) * slack;
        const Lane shift = At(weight_, k) * (At(s_, k) - At(t_, k));
        At(shift_, k) = shift;
        rows_.AddWeighted(k, shift, lanes);
      }
      rows_.Scatter(group, lanes, sums);
    }
    return Direction(sums, -LowGap() * low_, -HighGap() * high_, 1.0, 1.0);
  }

  // For the complementarity `mu` everywhere; after a predictor with what its step would leave over.
  Step Correct(double mu, const Step* predicted) {
    const auto row_mu = static_cast<Real>(mu);
    const Real left_over = predicted != nullptr ? 1 : 0;
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(variables_);
    for (const RowGroup& group : rows_.groups) {
      Lanes lanes = RowTable<Real>::NoLanes();
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const Lane slack = At(rows_.penalty, k) - At(row_, k);
        const Lane drow = left_over * At(drow_, k);
        const Lane t_target = row_mu - At(t_, k) * At(row_, k) - At(dt_, k) * drow;
        const Lane s_target = row_mu - At(s_, k) * slack + At(ds_, k) * drow;
        At(s_target_, k) = s_target;
        const Lane shift =
            At(weight_, k) * (t_target * At(inverse_row_, k) - s_target * At(inverse_slack_, k));
        At(shift_, k) = shift;
        rows_.AddWeighted(k, shift, lanes);
      }
      rows_.Scatter(group, lanes, sums);
    }
    Eigen::ArrayXd low_target = mu - LowGap() * low_;
    Eigen::ArrayXd high_target = mu - HighGap() * high_;
    if (predicted != nullptr) {
      low_target -= predicted->d.array() * predicted->low;
      high_target += predicted->d.array() * predicted->high;
    }
    return Direction(sums, low_target, high_target, kOfTheWay,
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
    step.d = matrix_.Solve(right);
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
    Lane primal = Lane::Zero();
    Lane dual = Lane::Zero();
    Lane by_primal = Lane::Zero();
    Lane by_dual = Lane::Zero();
    Lane by_both = Lane::Zero();
    for (const RowGroup& group : rows_.groups) {
      const std::array<Real, 8> d = rows_.OwnPart(group, step.d);
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const Lane product = rows_.Product(k, d);
        const Lane s = At(s_, k);
        const Lane t = At(t_, k);
        const Lane row = At(row_, k);
        const Lane inverse_slack = At(inverse_slack_, k);
        const Lane drow = At(weight_, k) * product + At(shift_, k);
        const Lane ds = (At(s_target_, k) + s * drow) * inverse_slack;
        const Lane dt = ds - product;
        At(drow_, k) = drow;
        At(ds_, k) = ds;
        At(dt_, k) = dt;
        primal = primal.max(-dt / t).max(-ds / s);
        dual = dual.max(-drow * At(inverse_row_, k)).max(drow * inverse_slack);
        by_primal += dt * row + ds * (At(rows_.penalty, k) - row);
        by_dual += drow * (t - s);
        by_both += drow * (dt - ds);
      }
    }
    worst_primal = std::max(worst_primal, double{primal.maxCoeff()});
    worst_dual = std::max(worst_dual, double{dual.maxCoeff()});
    step.by_primal = by_primal.sum();
    step.by_dual = by_dual.sum();
    step.by_both = by_both.sum();
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
    const auto primal = static_cast<Real>(step.primal);
    const auto dual = static_cast<Real>(step.dual);
    Lane complementarity = Lane::Zero();
    Lane excess = Lane::Zero();
    for (const RowGroup& group : rows_.groups) {
      Lanes lanes = RowTable<Real>::NoLanes();
      for (Eigen::Index k = group.begin; k < group.end; k += kLane) {
        const Lane t = At(t_, k) + primal * At(dt_, k);
        const Lane s = At(s_, k) + primal * At(ds_, k);
        const Lane row = At(row_, k) + dual * At(drow_, k);
        const Lane penalty = At(rows_.penalty, k);
        At(t_, k) = t;
        At(s_, k) = s;
        At(row_, k) = row;
        complementarity += t * row + s * (penalty - row);
        excess += penalty * s;
        rows_.AddWeighted(k, row, lanes);
      }
      rows_.Scatter(group, lanes, residual_);
    }
    row_complementarity_ = complementarity.sum();
    excess_ = excess.sum();
  }

  const PenaltyProgram& program_;
  const SolveTo& to_;
  Eigen::Index variables_;
  RowTable<Real> rows_;
  NormalMatrix matrix_;
  double width_ = 0.0;
  double most_ = 0.0;  // that a variable can win
  Eigen::VectorXd d_, residual_;
  Eigen::ArrayXd low_, high_;
  Array t_, s_, row_;
  Array weight_, inverse_row_, inverse_slack_, s_target_, shift_, dt_, ds_, drow_;
  double least_mu_ = 0.0;   // complementarity that is kept
  bool was_whole_ = false;  // the last step
  double start_excess_ = 0.0;
  double row_complementarity_ = 0.0;
  double excess_ = 0.0;  // what the rows' slacks cost
};

}  // namespace

Eigen::VectorXd Solve(const PenaltyProgram& program, const SolveTo& to) {
  if (to.centrality <= 0.0 && to.relative_gap < kFloatGap) {
    return InteriorPoint<double>(program, RowTable<double>(program, kDoublesInLane), to).Run();
  }
  RowTable<double> rows(program, kFloatsInLane);
  Eigen::VectorXd d = InteriorPoint<float>(program, RowTable<float>(rows), to).Run();
  if (to.centrality <= 0.0) return d;
  return InteriorPoint<double>(program, std::move(rows), to).Polish(std::move(d));
}

}  // namespace capfit::tighten
