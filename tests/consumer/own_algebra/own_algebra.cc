// Solvers and inline functions that the library uses inside, too. Where the linker gave the library
// these copies, fits would have other bits.
#include <Eigen/Dense>
#include <cstdio>
#include <cstdlib>

#include "core/geometry/tapered_capsule.h"

namespace {

// True, but nothing that a compiler can know.
bool Solves() {
  Eigen::Matrix3d matrix;
  matrix << 4, 1, 0, 1, 5, 2, 0, 2, 6;
  const Eigen::Vector3d wanted(1, 2, 3);
  Eigen::MatrixXd square = matrix;
  const Eigen::VectorXd x = square.llt().solve(Eigen::VectorXd(matrix * wanted));
  const capfit::geometry::TaperedCapsule capsule({Eigen::Vector3d::Zero(), 1.0},
                                                 {Eigen::Vector3d(3, 0, 0), 0.5});
  return (x - wanted).norm() < 1e-9 &&
         (matrix.ldlt().solve(matrix * wanted) - wanted).norm() < 1e-9 &&
         capsule.SignedDistance(Eigen::Vector3d(0, 0, 2)) < 2.0;
}

// Before main(), which is the sample's. The alignment is part of the interface: the test compares
// it with the one of the library's own build.
[[maybe_unused]] const bool kChecked = [] {
  if (!Solves()) std::fprintf(stderr, "the caller's own algebra is wrong\n"), std::abort();
  std::fprintf(stderr, "blocks of 32 bytes are aligned to %zu\n", alignof(Eigen::Vector4d));
  return true;
}();

}  // namespace
