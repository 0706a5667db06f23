#include "core/circle/quadratic_program.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace capfit::circle {
namespace {

// Relative to the size of the numbers in play: what rounding leaves of a zero.
constexpr double kTiny = 1e-12;

class DualActiveSet {
 public:
  DualActiveSet(const Eigen::Matrix3d& inverse_b, const Eigen::Vector3d& gradient,
                std::span<const HalfSpace> half_spaces)
      : inverse_b_(inverse_b), half_spaces_(half_spaces) {
    solution_.x = -inverse_b * gradient;
    for (const HalfSpace& h : half_spaces)
      largest_bound_ = std::max(largest_bound_, std::abs(h.bound));
  }

  QuadraticSolution Run() {
    const int rounds = 4 * static_cast<int>(half_spaces_.size()) + 16;  // cycling never seen; a net
    for (int round = 0; round < rounds; ++round) {
      const int worst = MostViolated();
      if (worst < 0 || !TakeIn(worst)) break;
    }
    return solution_;
  }

 private:
  int MostViolated() const {
    int worst = -1;
    double least = 0.0;
    for (std::size_t j = 0; j < half_spaces_.size(); ++j) {
      const HalfSpace& h = half_spaces_[j];
      const double slack = h.normal.dot(solution_.x) - h.bound;
      const double rounding = kTiny * (largest_bound_ + solution_.x.norm());
      if (slack < -rounding && slack < least) {
        least = slack;
        worst = static_cast<int>(j);
      }
    }
    return worst;
  }

  // Moves in the primal and dual space together until half-space `p` holds; drops active ones whose
  // multiplier reaches 0 on the way. False when no step is possible.
  bool TakeIn(int p) {
    const HalfSpace& h = half_spaces_[p];
    double multiplier = 0.0;
    for (int guard = 0; guard < 8; ++guard) {
      const Eigen::Vector3d dual = DualDirection(h.normal);
      Eigen::Vector3d step = h.normal;
      for (int k = 0; k < solution_.active_count; ++k) step -= dual[k] * ActiveNormal(k);
      const Eigen::Vector3d primal = inverse_b_ * step;
      const double along = primal.dot(h.normal);
      const bool movable = along > kTiny * h.normal.dot(inverse_b_ * h.normal);
      const double slack = h.bound - h.normal.dot(solution_.x);
      const double full = movable && solution_.active_count < 3
                              ? slack / along
                              : std::numeric_limits<double>::infinity();
      int leaving = -1;
      double partial = std::numeric_limits<double>::infinity();
      for (int k = 0; k < solution_.active_count; ++k) {
        const double ratio = solution_.multipliers[k] / dual[k];
        if (dual[k] > kTiny && ratio < partial) {
          partial = ratio;
          leaving = k;
        }
      }
      const double t = std::min(full, partial);
      if (t == std::numeric_limits<double>::infinity()) return false;
      if (movable) solution_.x += t * primal;
      for (int k = 0; k < solution_.active_count; ++k) {
        double& value = solution_.multipliers[k];
        value = std::max(0.0, value - t * dual[k]);
      }
      multiplier += t;
      if (full <= partial) return Add(p, multiplier);
      Drop(leaving);
    }
    return false;
  }

  // How the active multipliers must change so that the active half-spaces stay tight.
  Eigen::Vector3d DualDirection(const Eigen::Vector3d& normal) const {
    const int n = solution_.active_count;
    if (n == 0) return Eigen::Vector3d::Zero();
    Eigen::Matrix3d gram = Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector3d turned = inverse_b_ * ActiveNormal(i);
      for (int j = 0; j < n; ++j) gram(i, j) = turned.dot(ActiveNormal(j));
      right[i] = turned.dot(normal);
    }
    return gram.ldlt().solve(right);
  }

  bool Add(int p, double multiplier) {
    solution_.active[solution_.active_count] = p;
    solution_.multipliers[solution_.active_count] = multiplier;
    ++solution_.active_count;
    return true;
  }
  void Drop(int k) {
    for (int i = k; i + 1 < solution_.active_count; ++i) {
      solution_.active[i] = solution_.active[i + 1];
      solution_.multipliers[i] = solution_.multipliers[i + 1];
    }
    --solution_.active_count;
  }
  const Eigen::Vector3d& ActiveNormal(int k) const {
    return half_spaces_[solution_.active[k]].normal;
  }

  const Eigen::Matrix3d& inverse_b_;
  std::span<const HalfSpace> half_spaces_;
  QuadraticSolution solution_;
  double largest_bound_ = 0.0;
};

}  // namespace

QuadraticSolution SolveQuadraticProgram(const Eigen::Matrix3d& inverse_b,
                                        const Eigen::Vector3d& gradient,
                                        std::span<const HalfSpace> half_spaces) {
  return DualActiveSet(inverse_b, gradient, half_spaces).Run();
}

}  // namespace capfit::circle
