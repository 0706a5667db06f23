#include "core/circle/quadratic_program.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "core/base/random.h"

namespace capfit::circle {
namespace {

Eigen::Vector3d RandomVector(Random& random) {
  return {random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(-1, 1)};
}

// The conditions of Karush, Kuhn and Tucker prove a minimum of a convex programme.
TEST(QuadraticProgramTest, RandomProgrammesMeetTheOptimalityConditions) {
  Random random(31);
  for (int scene = 0; scene < 500; ++scene) {
    Eigen::Matrix3d root;
    for (int i = 0; i < 3; ++i) root.col(i) = RandomVector(random);
    const Eigen::Matrix3d b = root * root.transpose() + 0.05 * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d gradient = 3.0 * RandomVector(random);
    const Eigen::Vector3d common = RandomVector(random);  // a point in all half-spaces
    std::vector<HalfSpace> half_spaces;
    for (int j = 0; j < scene % 25; ++j) {
      const Eigen::Vector3d normal = RandomVector(random);
      half_spaces.push_back({normal, normal.dot(common) - random.NextIn(0.0, 0.5)});
    }
    const QuadraticSolution s = SolveQuadraticProgram(b.inverse(), gradient, half_spaces);
    for (const HalfSpace& h : half_spaces) EXPECT_GE(h.normal.dot(s.x), h.bound - 1e-9);
    Eigen::Vector3d residual = gradient + b * s.x;
    for (int k = 0; k < s.active_count; ++k) {
      const auto index = static_cast<std::size_t>(k);
      const HalfSpace& h = half_spaces[s.active[index]];
      EXPECT_GE(s.multipliers[index], 0.0);
      EXPECT_NEAR(h.normal.dot(s.x), h.bound, 1e-9);
      residual -= s.multipliers[index] * h.normal;
    }
    EXPECT_NEAR(residual.norm(), 0.0, 1e-8) << "scene " << scene;
  }
}

TEST(QuadraticProgramTest, KernelDirectionsStayPut) {
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Identity();
  inverse(0, 0) = 0.0;
  const std::vector<HalfSpace> half_spaces{{{0.6, 0.8, 1.0}, 1.0}};
  const QuadraticSolution s = SolveQuadraticProgram(inverse, {5, 0, 1}, half_spaces);
  EXPECT_EQ(s.x.x(), 0.0);
  EXPECT_NEAR(0.8 * s.x.y() + s.x.z(), 1.0, 1e-12);
}

}  // namespace
}  // namespace capfit::circle
