// What a mesh promises, checked from its faces alone.
#ifndef CAPFIT_TESTS_CORE_MANNEQUIN_SURFACE_CHECKS_H_
#define CAPFIT_TESTS_CORE_MANNEQUIN_SURFACE_CHECKS_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/formats/polygon_soup.h"

namespace capfit::test_support {

using Corners = std::vector<std::uint32_t>;

[[nodiscard]] std::vector<Corners> Faces(const formats::PolygonSoup& soup);
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> Triangles(const formats::PolygonSoup& soup);

struct SurfaceFacts {
  int unmatched_edges = 0;  // not run exactly once in each of the two directions
  int euler_number = 0;
  int unused_vertices = 0;
  double volume = 0.0;  // > 0: outward
};
[[nodiscard]] SurfaceFacts Examine(const formats::PolygonSoup& soup);

// Pairs of triangles without a common corner that cut each other (an edge of one through the
// other).
[[nodiscard]] int CountSelfIntersections(const formats::PolygonSoup& soup);

// Tape around the slice of the surface at height `y`: the convex hull of the closed curve around
// the y axis (other curves, such as arms, are left out).
[[nodiscard]] double TapeAt(const formats::PolygonSoup& soup, double y);

}  // namespace capfit::test_support

#endif  // CAPFIT_TESTS_CORE_MANNEQUIN_SURFACE_CHECKS_H_
