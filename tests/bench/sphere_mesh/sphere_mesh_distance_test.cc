#include "tests/bench/sphere_mesh/sphere_mesh_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace capfit::bench {
namespace {

using Eigen::Vector3d;
using geometry::Sphere;

// One triangle of three radii with a tail.
SphereMesh Kite() {
  return {{{{0, 0, 0}, 0.10}, {{0.4, 0, 0}, 0.16}, {{0.1, 0.3, 0.05}, 0.05}, {{0.9, 0, 0}, 0.02}},
          {{0, 1}, {0, 2}, {1, 2}, {1, 3}},
          {{0, 1, 2}}};
}

Foot Locate(const SphereMesh& mesh, const Vector3d& point) {
  int hint = 0;
  return SphereMeshDistance(mesh).Locate(point, hint);
}

TEST(SphereMeshDistance, AboveATriangleOfEqualRadiiIsTheHeightAboveThePlate) {
  const SphereMesh mesh{{{{0, 0, 0}, 0.1}, {{0.4, 0, 0}, 0.1}, {{0, 0.4, 0}, 0.1}},
                        {{0, 1}, {0, 2}, {1, 2}},
                        {{0, 1, 2}}};
  for (const double height : {0.5, 0.05, -0.05, -0.5}) {
    const Foot foot = Locate(mesh, {0.1, 0.2, height});
    EXPECT_NEAR(foot.distance, std::abs(height) - 0.1, 1e-12);
    EXPECT_NEAR((foot.normal - Vector3d(0, 0, std::copysign(1.0, height))).norm(), 0.0, 1e-12);
    EXPECT_EQ(foot.spheres, (std::array{0, 1, 2}));
    EXPECT_NEAR(foot.shares[0], 0.25, 1e-12);
    EXPECT_NEAR(foot.shares[1], 0.25, 1e-12);
    EXPECT_NEAR(foot.shares[2], 0.5, 1e-12);
  }
}

// The distance is the least of those to all interpolated spheres: none on a fine grid is nearer,
// and one of them is nearly as near.
TEST(SphereMeshDistance, IsTheLeastOverAllInterpolatedSpheres) {
  const SphereMesh mesh = Kite();
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> in(-0.4, 1.0);
  constexpr int kGrid = 60;
  for (int trial = 0; trial < 60; ++trial) {
    const Vector3d point(in(rng), 0.6 * in(rng), 0.4 * in(rng));
    double least = 1e9;
    const auto take = [&](int a, int b, int c, double u, double v) {
      const auto at = [&](int i) { return mesh.spheres[i]; };
      const Vector3d center =
          (1 - u - v) * at(a).center_m + u * at(b).center_m + v * at(c).center_m;
      least = std::min(least, (point - center).norm() - (1 - u - v) * at(a).radius_m -
                                  u * at(b).radius_m - v * at(c).radius_m);
    };
    for (int i = 0; i <= kGrid; ++i) {
      for (int j = 0; i + j <= kGrid; ++j) take(0, 1, 2, 1.0 * i / kGrid, 1.0 * j / kGrid);
      take(1, 3, 3, 1.0 * i / kGrid, 0.0);
    }
    const double found = Locate(mesh, point).distance;
    EXPECT_LE(found, least + 1e-12);
    EXPECT_GE(found, least - 2e-3) << "a step of the grid is at most 9 mm, errors are its square";
  }
}

// What a small change of the spheres does to the distance is what the foot says.
TEST(SphereMeshDistance, ChangesWithTheSpheresAsTheSharesSay) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const SphereMesh mesh = Kite();
    const Vector3d point(0.3 + 0.8 * in(rng), 0.6 * in(rng), 0.5 * in(rng));
    const Foot foot = Locate(mesh, point);
    SphereMesh moved = mesh;
    double expected = foot.distance;
    for (std::size_t i = 0; i < mesh.spheres.size(); ++i) {
      const Vector3d change = 1e-6 * Vector3d(in(rng), in(rng), in(rng));
      const double growth = 1e-6 * in(rng);
      moved.spheres[i].center_m += change;
      moved.spheres[i].radius_m += growth;
      for (std::size_t k = 0; k < 3; ++k) {
        if (foot.spheres[k] != static_cast<int>(i)) continue;
        expected -= foot.shares[k] * (foot.normal.dot(change) + growth);
      }
    }
    EXPECT_NEAR(Locate(moved, point).distance, expected, 1e-9);
  }
}

TEST(SphereMeshDistance, ATriangleWithASphereInsideTheOthersHullHasNoPlates) {
  const SphereMesh mesh{{{{0, 0, 0}, 0.2}, {{0.4, 0, 0}, 0.2}, {{0.2, 0.05, 0}, 0.01}},
                        {{0, 1}, {0, 2}, {1, 2}},
                        {{0, 1, 2}}};
  EXPECT_NEAR(Locate(mesh, {0.2, 0.03, 0.5}).distance, std::hypot(0.03, 0.5) - 0.2, 1e-12);
}

TEST(SphereMeshDistance, DroppedAndLeftOutHullsAreNotThere) {
  SphereMeshDistance distance(Kite());
  ASSERT_EQ(distance.hulls(), 5);
  const Vector3d beyond(0.9, 0, 0.5);
  int hint = 0;
  // The tail's sine is 0.28, its cosine 0.96.
  EXPECT_NEAR(distance.Locate(beyond, hint).distance, 0.96 * 0.5 + 0.28 * 0.5 - 0.16, 1e-12);
  EXPECT_EQ(hint, 3);
  int second = 3;
  const double without = distance.Locate(beyond, second, 3).distance;
  EXPECT_NEAR(without, std::hypot(0.5, 0.5) - 0.16, 1e-12) << "the triangle's widest corner";
  distance.Drop(3);
  EXPECT_DOUBLE_EQ(distance.Locate(beyond, hint).distance, without);
}

TEST(SphereMeshDistance, WithoutEdgesTheSpheresAreTheSolid) {
  const SphereMesh mesh{{{{0, 0, 0}, 0.2}}, {}, {}};
  const Foot foot = Locate(mesh, {0, 0.5, 0});
  EXPECT_NEAR(foot.distance, 0.3, 1e-12);
  EXPECT_EQ(foot.spheres[0], 0);
}

}  // namespace
}  // namespace capfit::bench
