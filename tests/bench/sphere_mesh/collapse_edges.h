// Sphere-Meshes: a mesh taken down to few interpolated spheres, one edge at a time.
#ifndef CAPFIT_TESTS_BENCH_SPHERE_MESH_COLLAPSE_EDGES_H_
#define CAPFIT_TESTS_BENCH_SPHERE_MESH_COLLAPSE_EDGES_H_

#include <functional>
#include <span>

#include "core/mesh/body_mesh.h"
#include "tests/bench/sphere_mesh/sphere_mesh.h"

namespace capfit::bench {

struct CollapseOptions {
  // The radius of a sphere is at most this times the least width of the surface that it stands for:
  // otherwise nearly flat patches become huge spheres. 0: no bound.
  double radius_bound = 0.75;
};

// Collapses the edge of least spherical quadric error until nothing is left to collapse, and calls
// `on_budget(i, sphere mesh)` as soon as at most budgets[i] primitives are left; budgets descend,
// >= 1. Each vertex starts as a sphere of radius 0 with the planes of its triangles, each weighted
// with a third of its area; a collapsed edge becomes the sphere of least error of both ends.
// Deterministic. O(n log n).
//
// Thiery, Guy and Boubekeur, "Sphere-Meshes: Shape Approximation using Spherical Quadric Error
// Metrics", ACM Transactions on Graphics 32(6), 2013, written from the paper; without its optional
// weights for features and without editing by hand.
void CollapseEdges(const mesh::BodyMesh& mesh, std::span<const int> budgets,
                   const CollapseOptions& options,
                   const std::function<void(std::size_t, const SphereMesh&)>& on_budget);

}  // namespace capfit::bench

#endif  // CAPFIT_TESTS_BENCH_SPHERE_MESH_COLLAPSE_EDGES_H_
