// A sphere mesh with fewer of the edges and triangles that join its spheres.
#ifndef CAPFIT_TESTS_BENCH_SPHERE_MESH_DROP_HULLS_H_
#define CAPFIT_TESTS_BENCH_SPHERE_MESH_DROP_HULLS_H_

#include <Eigen/Core>
#include <span>

#include "tests/bench/sphere_mesh/sphere_mesh.h"

namespace capfit::bench {

// Drops triangles, and edges that are no triangle's side, until at most `budget` primitives are
// left: those first without which the sum of the absolute distances of `points` from the solid
// grows the least for each primitive saved. All spheres stay, connected as they were: at the least
// a tree of 2 spheres - 1 primitives is left.
[[nodiscard]] SphereMesh DropHulls(const SphereMesh& mesh, int budget,
                                   std::span<const Eigen::Vector3d> points);

}  // namespace capfit::bench

#endif  // CAPFIT_TESTS_BENCH_SPHERE_MESH_DROP_HULLS_H_
