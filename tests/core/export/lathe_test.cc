#include "core/export/lathe.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <numbers>
#include <utility>

namespace capfit::exports {
namespace {

using Vec3 = Eigen::Vector3d;

Solid SolidOf(double low_radius, double high_radius, double length) {
  return {"s",
          -1,
          0,
          {0, 1},
          geometry::TaperedCapsule({Vec3(0, -length / 2, 0), low_radius},
                                   {Vec3(0, length / 2, 0), high_radius})};
}

double VolumeOf(const LatheMesh& mesh) {
  double volume = 0.0;
  for (const auto& t : mesh.triangles) {
    volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
  }
  return volume;
}

void ExpectClosed(const LatheMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

// Uniform, tapered either way, nearly contained, a ball.
const std::vector<Solid>& Solids() {
  static const auto& solids = *new std::vector<Solid>{
      SolidOf(0.1, 0.1, 0.3), SolidOf(0.05, 0.12, 0.4), SolidOf(0.12, 0.05, 0.4),
      SolidOf(0.1, 0.01, 0.0901), SolidOf(0.2, 0.2, 0.0)};
  return solids;
}

TEST(Lathe, IsClosedAndTurnedOutward) {
  for (const Solid& solid : Solids()) {
    for (const LatheKind kind : {LatheKind::kOnSurface, LatheKind::kEnclosing}) {
      const LatheMesh mesh = Lathe(solid, 12, kind);
      ExpectClosed(mesh);
      EXPECT_GT(VolumeOf(mesh), 0.0);
    }
  }
}

TEST(Lathe, OnTheSurfaceItsVerticesAndNormalsAreTheSolids) {
  for (const Solid& solid : Solids()) {
    const LatheMesh mesh = Lathe(solid, 16, LatheKind::kOnSurface);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      EXPECT_NEAR(solid.hull.SignedDistance(mesh.vertices[i]), 0.0, 1e-12);
      const Vec3 out = mesh.vertices[i] + 1e-3 * mesh.normals[i];
      EXPECT_NEAR(solid.hull.SignedDistance(out), 1e-3, 1e-9);
    }
  }
}

// A convex polyhedron encloses a solid if each face's plane is beyond the solid's support there.
TEST(Lathe, EnclosingItsFacesTouchFromOutside) {
  for (const Solid& solid : Solids()) {
    for (const int segments : {8, 32}) {
      const LatheMesh mesh = Lathe(solid, segments, LatheKind::kEnclosing);
      const double most =
          LatheDeviation(segments) * std::max(solid.hull.a().radius_m, solid.hull.b().radius_m);
      for (const Vec3& vertex : mesh.vertices) {
        EXPECT_GE(solid.hull.SignedDistance(vertex), -1e-12);
        EXPECT_LE(solid.hull.SignedDistance(vertex), most + 1e-12);
      }
      for (const auto& t : mesh.triangles) {
        const Vec3& corner = mesh.vertices[t[0]];
        const Vec3 cross = (mesh.vertices[t[1]] - corner).cross(mesh.vertices[t[2]] - corner);
        if (cross.norm() < 1e-14) continue;
        const Vec3 normal = cross.normalized();
        for (const geometry::Sphere& end : {solid.hull.a(), solid.hull.b()}) {
          EXPECT_LE((end.center_m - corner).dot(normal) + end.radius_m, 1e-9);
        }
      }
    }
  }
}

TEST(Lathe, ItsVolumeTendsToTheSolids) {
  for (const Solid& solid : Solids()) {
    const double exact = solid.hull.Volume_m3();
    const double inner = VolumeOf(Lathe(solid, 128, LatheKind::kOnSurface));
    const double outer = VolumeOf(Lathe(solid, 128, LatheKind::kEnclosing));
    EXPECT_LT(inner, exact);
    EXPECT_GT(outer, exact);
    EXPECT_NEAR(inner / exact, 1.0, 2e-3);
    EXPECT_NEAR(outer / exact, 1.0, 2e-3);
  }
}

}  // namespace
}  // namespace capfit::exports
