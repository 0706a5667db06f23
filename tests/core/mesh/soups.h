// Small meshes with known volumes, and ways to spoil them.
#ifndef CAPFIT_TESTS_CORE_MESH_SOUPS_H_
#define CAPFIT_TESTS_CORE_MESH_SOUPS_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/prepare_mesh.h"

namespace capfit::mesh {

// An axis-parallel box of six quads, outward.
[[nodiscard]] PolygonSoup Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
// The unit cube from the origin.
[[nodiscard]] PolygonSoup Cube();
// A ball round the origin as triangles: 2 * meridians * parallels of them, outward.
[[nodiscard]] PolygonSoup Ball(int meridians, int parallels, double radius = 1.0);

// Both in one, as separate parts.
[[nodiscard]] PolygonSoup Together(const PolygonSoup& a, const PolygonSoup& b);
[[nodiscard]] PolygonSoup Moved(PolygonSoup soup, const Eigen::Vector3d& by);
// Without faces `first` to `first + count - 1`.
[[nodiscard]] PolygonSoup WithoutFaces(const PolygonSoup& soup, std::size_t first,
                                       std::size_t count = 1);
// With one more face.
[[nodiscard]] PolygonSoup WithFace(PolygonSoup soup, std::vector<std::uint32_t> corners);
// No two faces share a vertex.
[[nodiscard]] PolygonSoup SplitApart(const PolygonSoup& soup);
// Each face turned round with the given chance.
[[nodiscard]] PolygonSoup RandomlyTurned(const PolygonSoup& soup, double chance,
                                         std::uint64_t seed);
// The faces in another order.
[[nodiscard]] PolygonSoup Shuffled(const PolygonSoup& soup, std::uint64_t seed);

// The corners of all triangles as sorted, rotated coordinates: equal for equal surfaces whatever
// the order of vertices and faces. Coordinates are rounded to `grid`.
using SurfaceKey = std::vector<std::array<std::array<std::int64_t, 3>, 3>>;
[[nodiscard]] SurfaceKey KeyOf(const BodyMesh& mesh, double grid);

// The count of the warning with that code; 0 where there is none.
[[nodiscard]] std::int64_t CountOf(const PreparedMesh& prepared, const std::string& code);
// All codes, in order, with spaces between.
[[nodiscard]] std::string CodesOf(const PreparedMesh& prepared);

}  // namespace capfit::mesh

#endif  // CAPFIT_TESTS_CORE_MESH_SOUPS_H_
