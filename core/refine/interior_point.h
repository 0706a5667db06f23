// One step of sequential linear programming: a primal-dual interior-point method.
#ifndef CAPFIT_CORE_REFINE_INTERIOR_POINT_H_
#define CAPFIT_CORE_REFINE_INTERIOR_POINT_H_

#include <Eigen/Core>
#include <vector>

namespace capfit::refine {

// Rows that touch the same two blocks of four variables (a capsule's ends); block -1: a fixed end,
// whose four coefficients are zero.
struct RowGroup {
  int begin = 0;
  int end = 0;
  int block_a = -1;
  int block_b = -1;
};

// minimise g.d + 1/2 sum H d^2 + penalty * sum s
// subject to A d + c <= s, s >= 0, low <= d <= high, low < 0 < high.
// A has eight coefficients a row: four for block_a, four for block_b of the row's group.
struct StepProblem {
  Eigen::VectorXd gradient;
  Eigen::VectorXd curvature;  // H, the diagonal; > 0
  Eigen::VectorXd low;
  Eigen::VectorXd high;
  Eigen::Matrix<double, Eigen::Dynamic, 8> coefficients;
  Eigen::VectorXd offsets;  // c
  std::vector<RowGroup> groups;
  double penalty = 1.0;
};

struct StepSolution {
  Eigen::VectorXd step;           // d
  Eigen::VectorXd prices;         // of the rows, in [0, penalty]: what a unit of c costs
  double predicted_change = 0.0;  // of the objective against d = 0; <= 0
};

// Mehrotra's predictor-corrector, always feasible; each iteration O(rows + variables^3). Ends when
// the gap is below `gap_share` of the objective, 15 to 20 iterations at 1 %.
[[nodiscard]] StepSolution SolveStep(const StepProblem& problem, double gap_share,
                                     int max_iterations);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_INTERIOR_POINT_H_
