// A sphere mesh: spheres, and what is interpolated between two and three of them.
#ifndef CAPFIT_TESTS_BENCH_SPHERE_MESH_SPHERE_MESH_H_
#define CAPFIT_TESTS_BENCH_SPHERE_MESH_SPHERE_MESH_H_

#include <array>
#include <string>
#include <vector>

#include "core/geometry/sphere.h"

namespace capfit::bench {

struct SphereMesh {
  std::vector<geometry::Sphere> spheres;      // in the mesh's frame and unit
  std::vector<std::array<int, 2>> edges;      // hulls of two; with the sides of the triangles
  std::vector<std::array<int, 3>> triangles;  // hulls of three
};

// As the 2018 paper counts, IV-B: spheres, cones, and two plates for each triangle.
[[nodiscard]] int PrimitiveCount(const SphereMesh& mesh);

// {"spheres": [[x, y, z, r], ...], "capsules": [[i, j], ...], "triangles": [[i, j, k], ...],
//  "n_p": .., "seconds": ..}, ending with a newline.
[[nodiscard]] std::string ToJson(const SphereMesh& mesh, double seconds);

// The same solid as spheres and capsules only, for programs that know no triangles: each triangle
// becomes a fan of capsules from its last corner to spheres along its first side, so close that
// their union is nowhere more than `sag` below the triangle's plates (same unit as the mesh;
// triangles of radius near 0 have nothing to lose and get at most 200).
[[nodiscard]] SphereMesh WithoutTriangles(const SphereMesh& mesh, double sag);

}  // namespace capfit::bench

#endif  // CAPFIT_TESTS_BENCH_SPHERE_MESH_SPHERE_MESH_H_
