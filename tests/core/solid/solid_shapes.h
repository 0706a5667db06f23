// Triangles of simple shapes, and what is asked of their solids.
#ifndef CAPFIT_TESTS_CORE_SOLID_SOLID_SHAPES_H_
#define CAPFIT_TESTS_CORE_SOLID_SOLID_SHAPES_H_

#include <Eigen/Core>
#include <vector>

#include "core/formats/polygon_soup.h"
#include "core/solid/make_solid.h"

namespace capfit::solid {

struct Triangles {
  std::vector<Eigen::Vector3d> positions;
  std::vector<mesh::Triangle> triangles;
};

[[nodiscard]] Triangles TrianglesOf(const formats::PolygonSoup& soup);
// Both, as separate shells.
[[nodiscard]] Triangles Both(Triangles a, const Triangles& b);
// The wall of a cylinder round the y axis, without ends.
[[nodiscard]] Triangles Tube(double radius, double low_y, double high_y, int around, int rings);
// A square of `steps` x `steps` squares in the plane y = height, with the middle on the y axis.
[[nodiscard]] Triangles Sheet(double half_side, double height, int steps);

// The solid of one thread; the test fails where there is none or it breaks a promise.
[[nodiscard]] Solid Made(const Triangles& shells, const SolidOptions& options = {});
// "REASON message" of a refusal.
[[nodiscard]] std::string RefusalOfSolid(const Triangles& shells);
// Of handles: 0 for a ball, 1 for a ring.
[[nodiscard]] int GenusOf(const mesh::BodyMesh& mesh);
// All codes, in order, with spaces between.
[[nodiscard]] std::string WarningCodes(const Solid& solid);

}  // namespace capfit::solid

#endif  // CAPFIT_TESTS_CORE_SOLID_SOLID_SHAPES_H_
