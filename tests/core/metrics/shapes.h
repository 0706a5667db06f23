// Closed meshes with known volume, distance and winding for the tests of metrics and skinning.
#ifndef CAPFIT_TESTS_CORE_METRICS_SHAPES_H_
#define CAPFIT_TESTS_CORE_METRICS_SHAPES_H_

#include <Eigen/Core>
#include <vector>

#include "core/geometry/sphere.h"
#include "core/mesh/body_mesh.h"

namespace capfit::test_shapes {

// A mesh of these vertices and triangles in which every vertex is the caller's, in order.
[[nodiscard]] mesh::BodyMesh MeshOf(std::vector<Eigen::Vector3d> vertices,
                                    std::vector<mesh::Triangle> triangles);

// The box from `low` to `high`, each side a grid of steps x steps squares cut in two.
[[nodiscard]] mesh::BodyMesh Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                                 int steps = 1);

// An octahedron whose triangles were cut in four `levels` times, blown up to a ball: inscribed.
[[nodiscard]] mesh::BodyMesh Ball(const geometry::Sphere& sphere, int levels);

// A tapered capsule as rings of `around` vertices, `per_cap` rings on each end, inscribed.
[[nodiscard]] mesh::BodyMesh Capsule(const geometry::Sphere& a, const geometry::Sphere& b,
                                     int around, int per_cap);

// Not convex: the box from (0,0,0) to (2,2,1) without the one from (1,1,0) to (2,2,1).
[[nodiscard]] mesh::BodyMesh Bracket();

// How often the surface runs round the point, by solid angles: 1 inside, 0 outside.
[[nodiscard]] double WindingNumber(const mesh::BodyMesh& mesh, const Eigen::Vector3d& point);

}  // namespace capfit::test_shapes

#endif  // CAPFIT_TESTS_CORE_METRICS_SHAPES_H_
