#include "tests/core/solid/solid_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/mesh/one_surface.h"
#include "core/mesh/triangulate_faces.h"
#include "tests/fuzz/mesh_promises.h"
#include "tests/support/told.h"

namespace capfit::solid {

Triangles TrianglesOf(const formats::PolygonSoup& soup) {
  return {soup.positions, mesh::TriangulateFaces(soup, soup.positions).triangles};
}

Triangles Both(Triangles a, const Triangles& b) {
  const auto first = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const mesh::Triangle& t : b.triangles) {
    a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return a;
}

Triangles Tube(double radius, double low_y, double high_y, int around, int rings) {
  Triangles tube;
  for (int r = 0; r <= rings; ++r) {
    for (int k = 0; k < around; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / around;
      tube.positions.emplace_back(radius * std::sin(angle), low_y + (high_y - low_y) * r / rings,
                                  radius * std::cos(angle));
    }
  }
  for (int r = 0; r < rings; ++r) {
    for (int k = 0; k < around; ++k) {
      const auto a = static_cast<std::uint32_t>(r * around + k);
      const auto b = static_cast<std::uint32_t>(r * around + (k + 1) % around);
      const auto n = static_cast<std::uint32_t>(around);
      tube.triangles.push_back({a, b, b + n});
      tube.triangles.push_back({a, b + n, a + n});
    }
  }
  return tube;
}

Triangles Sheet(double half_side, double height, int steps) {
  Triangles sheet;
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= steps; ++k) {
      sheet.positions.emplace_back(half_side * (2.0 * i / steps - 1.0), height,
                                   half_side * (2.0 * k / steps - 1.0));
    }
  }
  const auto row = static_cast<std::uint32_t>(steps + 1);
  for (std::uint32_t i = 0; i + 1 < row; ++i) {
    for (std::uint32_t k = 0; k + 1 < row; ++k) {
      const std::uint32_t a = i * row + k;
      sheet.triangles.push_back({a, a + 1, a + row + 1});
      sheet.triangles.push_back({a, a + row + 1, a + row});
    }
  }
  return sheet;
}

Solid Made(const Triangles& shells, const SolidOptions& options) {
  absl::StatusOr<Solid> solid = MakeSolid(shells.positions, shells.triangles, options);
  EXPECT_TRUE(solid.ok()) << solid.status();
  if (!solid.ok()) return Solid{mesh::BodyMesh({}, {}, {}), 0.0, {}};
  EXPECT_EQ(fuzz::BrokenPromise(solid->mesh, 0), "");
  EXPECT_TRUE(mesh::IsOneSurface(solid->mesh.triangles(), solid->mesh.mates(),
                                 solid->mesh.vertices().size(), ThreadPool(1)));
  return *std::move(solid);
}

std::string RefusalOfSolid(const Triangles& shells) {
  const absl::StatusOr<Solid> solid = MakeSolid(shells.positions, shells.triangles);
  return solid.ok() ? "accepted with " + WarningCodes(*solid) : Told(solid.status());
}

int GenusOf(const mesh::BodyMesh& mesh) {
  const auto vertices = static_cast<int>(mesh.vertices().size());
  const auto triangles = static_cast<int>(mesh.triangles().size());
  return (2 - (vertices - triangles / 2)) / 2;
}

std::string WarningCodes(const Solid& solid) {
  std::string codes;
  for (const Warning& warning : solid.warnings) {
    codes += (codes.empty() ? "" : " ") + warning.code;
  }
  return codes;
}

}  // namespace capfit::solid
