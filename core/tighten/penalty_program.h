// The small convex programme that every tightening step solves.
#ifndef CAPFIT_CORE_TIGHTEN_PENALTY_PROGRAM_H_
#define CAPFIT_CORE_TIGHTEN_PENALTY_PROGRAM_H_

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "core/base/thread_pool.h"

namespace capfit::tighten {

// value + coefficients . d should be <= 0; what is above costs `penalty` times as much. Touches two
// groups of four variables, from first[0] and first[1] on; first[1] == -1: only one.
struct PenaltyRow {
  std::array<int, 2> first{0, -1};
  std::array<double, 8> coefficients{};
  double value = 0.0;
  double penalty = 1.0;  // > 0
};

// Rows that come together: those of a chunk of points, or one by one.
struct RowBatch {
  std::vector<PenaltyRow> rows;
  double penalty_factor = 1.0;  // of each row's penalty
};

// minimise  gradient . d + sum(hessian_i d_i^2) / 2 + sum over rows penalty * max(0, excess)
// subject to  lower <= d <= upper,  lower < 0 < upper.
struct PenaltyProgram {
  Eigen::VectorXd gradient;
  Eigen::VectorXd hessian;  // diagonal, > 0
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  std::vector<RowBatch> batches;
};

// How far a programme is solved.
struct SolveTo {
  double relative_gap = 1e-8;  // of the decrease won
  int most_iterations = 40;    // whatever the gap is then
  // Above 0: to the point of the central path where each product of a slack and its multiplier is
  // this share of the most that a variable can win, to nearly all digits, whatever the gap. That
  // point follows the programme smoothly, as the optimum does not, and costs half as much: 7 to 12
  // iterations, each of one direction in place of two.
  double centrality = 0.0;
};

// Primal-dual interior point with predictor and corrector (Mehrotra 1992); the rows' slacks are
// eliminated, so that each iteration costs 36 products a row and one Cholesky factorisation by
// blocks. Ten to twenty iterations, about 20 ns a row each; from a gap of a hundredth on, and for a
// centrality all but the last two, rows are reckoned in floats, which takes half as long. The
// bounds hold strictly. Where threads of the pool are idle, they take rows too: with one of them a
// programme of some thousand rows is solved in two thirds of the time. Deterministic, and the same
// for any number of threads.
// For one caller at a time; keeps its memory from one programme to the next.
class PenaltySolver {
 public:
  // Keeps a reference.
  explicit PenaltySolver(const ThreadPool& pool);
  ~PenaltySolver();

  [[nodiscard]] Eigen::VectorXd Solve(const PenaltyProgram& program, const SolveTo& to = {});

 private:
  struct Memory;

  const ThreadPool& pool_;
  std::unique_ptr<Memory> memory_;
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_PENALTY_PROGRAM_H_
