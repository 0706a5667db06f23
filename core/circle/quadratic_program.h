// A quadratic programme in three variables, small enough to be solved inside every fitting step.
#ifndef CAPFIT_CORE_CIRCLE_QUADRATIC_PROGRAM_H_
#define CAPFIT_CORE_CIRCLE_QUADRATIC_PROGRAM_H_

#include <Eigen/Core>
#include <array>
#include <span>

namespace capfit::circle {

// normal . x >= bound
struct HalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double bound = 0.0;
};

struct QuadraticSolution {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  // Of the half-spaces that hold x: at most three, with their multipliers >= 0.
  std::array<int, 3> active{};
  std::array<double, 3> multipliers{};
  int active_count = 0;
};

// Minimises gradient . x + x . B x / 2 under the half-spaces, given B^-1 (symmetric, positive
// semi-definite; directions in its kernel stay 0). Dual active set method (Goldfarb and Idnani
// 1983): starts at the free minimum and takes in one violated half-space after the other; a handful
// of 3x3 solves. The half-spaces must have a common point.
[[nodiscard]] QuadraticSolution SolveQuadraticProgram(const Eigen::Matrix3d& inverse_b,
                                                      const Eigen::Vector3d& gradient,
                                                      std::span<const HalfSpace> half_spaces);

}  // namespace capfit::circle

#endif  // CAPFIT_CORE_CIRCLE_QUADRATIC_PROGRAM_H_
