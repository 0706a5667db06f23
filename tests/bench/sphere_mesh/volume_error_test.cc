#include "tests/bench/sphere_mesh/volume_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace capfit::bench {
namespace {

using Eigen::Vector3d;

// A box from the origin, outward.
mesh::BodyMesh Box(const Vector3d& size) {
  std::vector<Vector3d> vertices;
  for (int i = 0; i < 8; ++i) {
    vertices.push_back(size.cwiseProduct(Vector3d(i & 1, (i >> 1) & 1, (i >> 2) & 1)));
  }
  return {vertices,
          {{0, 2, 1},
           {1, 2, 3},
           {4, 5, 6},
           {5, 7, 6},
           {0, 1, 4},
           {1, 5, 4},
           {2, 6, 3},
           {3, 6, 7},
           {0, 4, 2},
           {2, 4, 6},
           {1, 3, 5},
           {3, 7, 5}},
          {0, 1, 2, 3, 4, 5, 6, 7}};
}

double BallVolume(double radius) { return 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3); }

TEST(VolumeError, IsWhatABallInsideLeavesUncovered) {
  const mesh::BodyMesh box = Box({1, 2, 1.5});
  ASSERT_NEAR(box.volume(), 3.0, 1e-12);
  const SphereMesh ball{{{{0.5, 1, 0.75}, 0.4}}, {}, {}};
  EXPECT_NEAR(VolumeError(box, 200).Of(ball), 1.0 - BallVolume(0.4) / 3.0, 2e-3);
}

TEST(VolumeError, CountsHalfABallOutsideAndTheRestUncovered) {
  const mesh::BodyMesh box = Box({1, 2, 1.5});
  const SphereMesh ball{{{{0.5, 1, 1.5}, 0.2}}, {}, {}};  // half of it above
  EXPECT_NEAR(VolumeError(box, 200).Of(ball), 1.0, 2e-3);
  const SphereMesh none{{{{0.5, 1, 0.7}, 0.0}}, {}, {}};
  EXPECT_NEAR(VolumeError(box, 200).Of(none), 1.0, 1e-9);
}

// A slab of a triangle: its area by its thickness, half cylinders along the sides, and the corners
// make one ball.
TEST(VolumeError, KnowsTheHullOfThreeSpheres) {
  const mesh::BodyMesh box = Box({2, 2, 1});
  const double radius = 0.1, leg = 0.8;
  const SphereMesh slab{
      {{{0.5, 0.5, 0.5}, radius}, {{0.5 + leg, 0.5, 0.5}, radius}, {{0.5, 0.5 + leg, 0.5}, radius}},
      {{0, 1}, {0, 2}, {1, 2}},
      {{0, 1, 2}}};
  const double sides = (2.0 + std::numbers::sqrt2) * leg;
  const double volume = 0.5 * leg * leg * 2 * radius +
                        0.5 * std::numbers::pi * radius * radius * sides + BallVolume(radius);
  EXPECT_NEAR(VolumeError(box, 200).Of(slab), 1.0 - volume / 4.0, 1e-3);
}

}  // namespace
}  // namespace capfit::bench
