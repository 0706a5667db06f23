#include "tests/bench/sphere_mesh/collapse_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "core/geometry/tapered_capsule.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/bench/sphere_mesh/directional_width.h"

namespace capfit::bench {
namespace {

using Eigen::Vector3d;
using geometry::Sphere;

// A capsule of radius 0.1 along x, from -0.3 to 0.3, in 24 meridians.
mesh::BodyMesh CapsuleMesh() {
  constexpr int kAround = 24, kRings = 21;
  std::vector<Vector3d> vertices = {{-0.4, 0, 0}};
  for (int ring = 1; ring < kRings; ++ring) {
    const double angle = std::numbers::pi * ring / kRings;
    const double shift = ring <= kRings / 2 ? -0.3 : 0.3;
    for (int i = 0; i < kAround; ++i) {
      const double around = 2 * std::numbers::pi * i / kAround;
      vertices.emplace_back(shift - 0.1 * std::cos(angle), 0.1 * std::sin(angle) * std::cos(around),
                            0.1 * std::sin(angle) * std::sin(around));
    }
  }
  vertices.emplace_back(0.4, 0, 0);
  const auto at = [](int ring, int i) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * kAround + i % kAround);
  };
  const auto last = static_cast<std::uint32_t>(vertices.size() - 1);
  std::vector<mesh::Triangle> triangles;
  for (int i = 0; i < kAround; ++i) {
    triangles.push_back({0, at(1, i + 1), at(1, i)});
    triangles.push_back({last, at(kRings - 1, i), at(kRings - 1, i + 1)});
    for (int ring = 1; ring + 1 < kRings; ++ring) {
      triangles.push_back({at(ring, i), at(ring, i + 1), at(ring + 1, i)});
      triangles.push_back({at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i)});
    }
  }
  const std::vector<std::int32_t> source(vertices.size(), 0);
  return {vertices, triangles, source};
}

TEST(CollapseEdges, ACapsuleComesBackAsTwoSpheresAndTheirCone) {
  const mesh::BodyMesh mesh = CapsuleMesh();
  ASSERT_GT(mesh.volume(), 0.0);
  const std::vector<SphereMesh> series = CollapseEdges(mesh, 2, {});
  ASSERT_EQ(series.size(), 2U);
  const SphereMesh& found = series.front();
  ASSERT_EQ(found.spheres.size(), 2U);
  ASSERT_EQ(found.edges.size(), 1U);
  EXPECT_TRUE(found.triangles.empty());
  for (const Sphere& sphere : found.spheres) {
    EXPECT_NEAR(std::abs(sphere.center_m.x()), 0.3, 0.02);
    EXPECT_NEAR(sphere.center_m.tail<2>().norm(), 0.0, 0.002);
    EXPECT_NEAR(sphere.radius_m, 0.1, 0.003);
  }
  EXPECT_LT(found.spheres[0].center_m.x() * found.spheres[1].center_m.x(), 0.0);
}

// The complex is sound: indices in range, no edge or triangle twice, every side of a triangle an
// edge, one connected piece.
void ExpectSound(const SphereMesh& mesh) {
  const int count = static_cast<int>(mesh.spheres.size());
  std::set<std::array<int, 2>> edges;
  for (const std::array<int, 2>& edge : mesh.edges) {
    EXPECT_LT(edge[0], edge[1]);
    EXPECT_LT(edge[1], count);
    EXPECT_TRUE(edges.insert(edge).second);
  }
  std::set<std::set<int>> triangles;
  for (const std::array<int, 3>& corners : mesh.triangles) {
    EXPECT_TRUE(triangles.insert(std::set<int>(corners.begin(), corners.end())).second);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(corners[k], corners[(k + 1) % 3]);
      EXPECT_TRUE(edges.contains({a, b}));
    }
  }
  for (const Sphere& sphere : mesh.spheres) EXPECT_GE(sphere.radius_m, 0.0);
  std::vector<int> root(mesh.spheres.size());
  for (int i = 0; i < count; ++i) root[i] = i;
  for (int pass = 0; pass < count; ++pass) {
    for (const auto& [a, b] : edges) {
      int& first = root[a];
      int& second = root[b];
      first = second = std::min(first, second);
    }
  }
  EXPECT_EQ(std::set<int>(root.begin(), root.end()).size(), 1U);
}

TEST(CollapseEdges, AMannequinIsASoundComplexWithASphereLessEachTime) {
  mannequin::MannequinOptions options;
  options.faces = 4000;
  const auto soup = mannequin::MakeMannequin(options);
  ASSERT_TRUE(soup.ok());
  const auto body = mesh::PrepareMesh(*soup);
  ASSERT_TRUE(body.ok());
  const std::vector<SphereMesh> series = CollapseEdges(body->mesh, 150, {});
  ASSERT_EQ(series.size(), 150U);
  for (std::size_t i = 0; i < series.size(); ++i) {
    EXPECT_EQ(series[i].spheres.size(), 150 - i);
    ExpectSound(series[i]);
  }
  const std::vector<SphereMesh> again = CollapseEdges(body->mesh, 150, {});
  EXPECT_EQ(ToJson(again[90], 0.0), ToJson(series[90], 0.0));
  // All of them where the mesh has fewer vertices than asked for.
  EXPECT_EQ(CollapseEdges(body->mesh, 1'000'000, {}).size(), body->mesh.vertices().size());
}

// Every sphere of the fan lies in the triangle's hull, and the plate's middle is as good as
// covered.
TEST(WithoutTriangles, IsTheSameSolid) {
  const SphereMesh mesh{{{{0, 0, 0}, 0.1}, {{0.4, 0, 0}, 0.1}, {{0.1, 0.3, 0}, 0.1}},
                        {{0, 1}, {0, 2}, {1, 2}},
                        {{0, 1, 2}}};
  const double sag = 1e-4;
  const SphereMesh plain = WithoutTriangles(mesh, sag);
  EXPECT_TRUE(plain.triangles.empty());
  double depth = 1.0, least = 1.0;
  for (int i = 1; i < 60; ++i) {
    const Vector3d foot = Vector3d(0.4, 0, 0) * (i / 120.0) + Vector3d(0.1, 0.3, 0) * (i / 120.0);
    const Vector3d above = foot + Vector3d(0, 0, 0.1);
    double nearest = 1.0;
    for (const auto& [a, b] : plain.edges) {
      const geometry::TaperedCapsule capsule(plain.spheres[a], plain.spheres[b]);
      nearest = std::min(nearest, capsule.SignedDistance(above));
    }
    depth = std::min(depth, sag - nearest);
    least = std::min(least, nearest);
  }
  EXPECT_GE(depth, 0.0) << "a furrow deeper than the sag";
  EXPECT_GE(least, -1e-12) << "nothing stands out of the plate";
  EXPECT_EQ(PrimitiveCount(mesh), 8);
}

TEST(DirectionalWidth, IsTheThicknessOfASlab) {
  DirectionalWidth left, right;
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      (i < 10 ? left : right).Add({0.05 * i, 0.05 * j, 0.0});
      (i < 10 ? left : right).Add({0.05 * i, 0.05 * j, 0.1});
    }
  }
  EXPECT_GE(left.LeastWith(right), 0.1 - 1e-6);
  EXPECT_LE(left.LeastWith(right), 0.1 * 1.05 + 1.0 * 0.25) << "30 directions: one within 15 deg";
  EXPECT_DOUBLE_EQ(DirectionalWidth().LeastWith(DirectionalWidth()), 0.0);
}

}  // namespace
}  // namespace capfit::bench
