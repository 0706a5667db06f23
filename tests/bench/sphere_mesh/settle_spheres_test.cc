#include "tests/bench/sphere_mesh/settle_spheres.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/bench/sphere_mesh/sphere_mesh_distance.h"

namespace capfit::bench {
namespace {

using Eigen::Vector3d;
using geometry::Sphere;

// Points on the surface of the solid: those that lie on rays from inside it.
std::vector<Vector3d> PointsOn(const SphereMesh& mesh, const std::vector<Vector3d>& middles) {
  const SphereMeshDistance distance(mesh);
  std::vector<Vector3d> points;
  int hint = 0;
  for (const Vector3d& middle : middles) {
    for (int i = 0; i < 400; ++i) {
      const double z = -1.0 + (i + 0.5) / 200.0, around = 2.4 * i, ring = std::sqrt(1.0 - z * z);
      const Vector3d ray(ring * std::cos(around), ring * std::sin(around), z);
      Vector3d point = middle + 2.0 * ray;
      // Sphere tracing: no step is longer than the way to the surface.
      for (int step = 0; step < 200; ++step) point -= distance.Locate(point, hint).distance * ray;
      points.push_back(point);
    }
  }
  return points;
}

void ExpectSettlesOn(const SphereMesh& truth, const std::vector<Vector3d>& middles) {
  const std::vector<Vector3d> points = PointsOn(truth, middles);
  SphereMesh start = truth;
  for (std::size_t i = 0; i < start.spheres.size(); ++i) {
    start.spheres[i].center_m += Vector3d(0.01, -0.015, 0.01 * (i % 2 ? 1.0 : -1.0));
    start.spheres[i].radius_m *= i % 2 ? 0.85 : 1.1;
  }
  const SphereMesh found = SettleSpheres(start, points, 60);
  EXPECT_EQ(found.edges, truth.edges);
  EXPECT_EQ(found.triangles, truth.triangles);
  for (std::size_t i = 0; i < truth.spheres.size(); ++i) {
    EXPECT_NEAR((found.spheres[i].center_m - truth.spheres[i].center_m).norm(), 0.0, 1e-6);
    EXPECT_NEAR(found.spheres[i].radius_m, truth.spheres[i].radius_m, 1e-6);
  }
}

TEST(SettleSpheres, FindsTheConeThatThePointsLieOn) {
  ExpectSettlesOn({{{{0, 0, 0}, 0.1}, {{0.5, 0, 0}, 0.06}}, {{0, 1}}, {}},
                  {{0, 0, 0}, {0.25, 0, 0}, {0.5, 0, 0}});
}

TEST(SettleSpheres, FindsTheHullOfThreeSpheresThatThePointsLieOn) {
  ExpectSettlesOn({{{{0, 0, 0}, 0.1}, {{0.5, 0, 0}, 0.06}, {{0.1, 0.4, 0.1}, 0.08}},
                   {{0, 1}, {0, 2}, {1, 2}},
                   {{0, 1, 2}}},
                  {{0.05, 0.03, 0}, {0.4, 0.03, 0}, {0.15, 0.3, 0.08}});
}

// A hand on an arm that has no sphere left for it does not blow up the arm.
TEST(SettleSpheres, LostPointsPullLittle) {
  const SphereMesh arm{{{{0, 0, 0}, 0.05}, {{0.5, 0, 0}, 0.05}}, {{0, 1}}, {}};
  std::vector<Vector3d> points = PointsOn(arm, {{0, 0, 0}, {0.25, 0, 0}, {0.5, 0, 0}});
  for (int i = 0; i < 100; ++i) {
    const double around = 2 * std::numbers::pi * i / 100;
    points.emplace_back(0.25, 0.6 + 0.02 * std::cos(around), 0.02 * std::sin(around));
  }
  const SphereMesh found = SettleSpheres(arm, points, 30);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR((found.spheres[i].center_m - arm.spheres[i].center_m).norm(), 0.0, 0.01);
    EXPECT_NEAR(found.spheres[i].radius_m, 0.05, 0.005);
  }
}

TEST(SettleSpheres, ASphereThatNoPointPullsAtStays) {
  SphereMesh mesh{{{{0, 0, 0}, 0.1}, {{0.01, 0, 0}, 0.01}}, {{0, 1}}, {}};  // the one in the other
  std::vector<Vector3d> points = PointsOn({{{{0, 0, 0}, 0.12}}, {}, {}}, {{0, 0, 0}});
  const SphereMesh found = SettleSpheres(mesh, points, 20);
  EXPECT_NEAR(found.spheres[0].radius_m, 0.12, 1e-6);
  EXPECT_NEAR((found.spheres[1].center_m - mesh.spheres[1].center_m).norm(), 0.0, 1e-9);
  EXPECT_GE(found.spheres[1].radius_m, 0.0);
  EXPECT_EQ(SettleSpheres(mesh, {}, 20).spheres[0].radius_m, 0.1) << "nothing to settle on";
}

// A quarter of the area has a quarter of the points, whatever the triangles.
TEST(SurfacePoints, LieEvenlyOnTheArea) {
  const std::vector<Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const mesh::BodyMesh body(corners, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {0, 1, 2, 3});
  const std::vector<Vector3d> points = SurfacePoints(body, 2000);
  EXPECT_NEAR(static_cast<double>(points.size()), 2000.0, 1.0);
  double on_floor = 0.0, near_corner = 0.0;
  for (const Vector3d& point : points) {
    EXPECT_GE(point.minCoeff(), -1e-12);
    EXPECT_LE(point.sum(), 1.0 + 1e-12);
    if (point.z() > 1e-12) continue;
    ++on_floor;
    if (point.x() + point.y() < 0.5) ++near_corner;
  }
  EXPECT_NEAR(on_floor / 2000.0, 0.5 / body.area(), 0.01);
  EXPECT_NEAR(near_corner / on_floor, 0.25, 0.02);
}

}  // namespace
}  // namespace capfit::bench
