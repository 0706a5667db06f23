// Small meshes with known volumes, and ways to spoil them.
#ifndef CAPFIT_TESTS_CORE_MESH_SOUPS_H_
#define CAPFIT_TESTS_CORE_MESH_SOUPS_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/prepare_mesh.h"
#include "core/mesh/surface.h"

namespace capfit::mesh {

// An axis-parallel box of six quads, outward.
[[nodiscard]] formats::PolygonSoup Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
// The unit cube from the origin.
[[nodiscard]] formats::PolygonSoup Cube();
// A ball round the origin as triangles: 2 * meridians * parallels of them, outward.
[[nodiscard]] formats::PolygonSoup Ball(int meridians, int parallels, double radius = 1.0);

// The faces of a soup of triangles.
[[nodiscard]] std::vector<Triangle> TrianglesOf(const formats::PolygonSoup& soup);

// Both in one, as separate parts.
[[nodiscard]] formats::PolygonSoup Together(const formats::PolygonSoup& a,
                                            const formats::PolygonSoup& b);
[[nodiscard]] formats::PolygonSoup Moved(formats::PolygonSoup soup, const Eigen::Vector3d& by);
// Without faces `first` to `first + count - 1`.
[[nodiscard]] formats::PolygonSoup WithoutFaces(const formats::PolygonSoup& soup, std::size_t first,
                                                std::size_t count = 1);
// With one more face.
[[nodiscard]] formats::PolygonSoup WithFace(formats::PolygonSoup soup,
                                            std::vector<std::uint32_t> corners);
// No two faces share a vertex.
[[nodiscard]] formats::PolygonSoup SplitApart(const formats::PolygonSoup& soup);
// Each face turned round with the given chance.
[[nodiscard]] formats::PolygonSoup RandomlyTurned(const formats::PolygonSoup& soup, double chance,
                                                  std::uint64_t seed);
// The faces in another order.
[[nodiscard]] formats::PolygonSoup Shuffled(const formats::PolygonSoup& soup, std::uint64_t seed);

// Triangles that run their common edges in opposite directions, with their neighbours.
[[nodiscard]] Surface SurfaceOf(std::vector<Triangle> triangles, std::size_t vertices);

// The triangles of `soup`, each missing with the given chance.
[[nodiscard]] Surface WithHoles(const formats::PolygonSoup& soup, double chance,
                                std::uint64_t seed);

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
