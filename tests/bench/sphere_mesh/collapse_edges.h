// Sphere-Meshes: a mesh taken down to few interpolated spheres, one edge at a time.
#ifndef CAPFIT_TESTS_BENCH_SPHERE_MESH_COLLAPSE_EDGES_H_
#define CAPFIT_TESTS_BENCH_SPHERE_MESH_COLLAPSE_EDGES_H_

#include <vector>

#include "core/mesh/body_mesh.h"
#include "tests/bench/sphere_mesh/sphere_mesh.h"

namespace capfit::bench {

struct CollapseOptions {
  // The radius of a sphere is at most this times the least width of the surface that it stands for:
  // otherwise nearly flat patches become huge spheres. 0: no bound.
  double radius_bound = 0.75;
};

// Collapses the edge of least spherical quadric error until nothing is left to collapse. Gives each
// sphere mesh of at most `most_spheres` spheres on the way, each with a sphere less than the one
// before; the last has one sphere (for a connected mesh). Each vertex starts as a sphere of radius
// 0 with the planes of its triangles, each weighted with a third of its area; a collapsed edge
// becomes the sphere of least error of both ends. Deterministic. O(n log n).
//
// Not OpenMesh's decimater, which keeps a manifold: of the 12,421 collapses of a body 353 leave it,
// the first with 9406 spheres left. Nor a mesh made lighter by it before: halving one takes three
// times as long as all collapses.
//
// Thiery, Guy and Boubekeur, "Sphere-Meshes: Shape Approximation using Spherical Quadric Error
// Metrics", ACM Transactions on Graphics 32(6), 2013, written from the paper; without its optional
// weights for features and without editing by hand.
[[nodiscard]] std::vector<SphereMesh> CollapseEdges(const mesh::BodyMesh& mesh, int most_spheres,
                                                    const CollapseOptions& options);

}  // namespace capfit::bench

#endif  // CAPFIT_TESTS_BENCH_SPHERE_MESH_COLLAPSE_EDGES_H_
