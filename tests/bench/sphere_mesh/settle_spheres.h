// A sphere mesh whose spheres are moved and grown until its surface lies on the body's.
#ifndef CAPFIT_TESTS_BENCH_SPHERE_MESH_SETTLE_SPHERES_H_
#define CAPFIT_TESTS_BENCH_SPHERE_MESH_SETTLE_SPHERES_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/mesh/body_mesh.h"
#include "tests/bench/sphere_mesh/sphere_mesh.h"

namespace capfit::bench {

// About `count` points that lie evenly on the area. Deterministic.
[[nodiscard]] std::vector<Eigen::Vector3d> SurfacePoints(const mesh::BodyMesh& mesh, int count);

// At most `steps` Gauss-Newton steps, damped where they do not help (Levenberg-Marquardt), towards
// the least sum of far * atan(|d| / far) over the distances d of `points` from the solid. Near to
// it that is |d|, so that the sum stands for a volume; points that are lost (far: twice the mean
// distance at the start), like those of a hand without a sphere, do not blow up what is left. Which
// spheres are joined stays, radii stay >= 0. What the collapse lacks is that each point pulls at
// the interpolated sphere that is nearest to it, not at the one sphere that stands for its
// triangle.
//
// Tkach, Pauly and Tagliasacchi, "Sphere-Meshes for Real-Time Hand Modeling and Tracking", ACM
// Transactions on Graphics 35(6), 2016: their calibration, without its priors and weights.
[[nodiscard]] SphereMesh SettleSpheres(const SphereMesh& mesh,
                                       std::span<const Eigen::Vector3d> points, int steps);

}  // namespace capfit::bench

#endif  // CAPFIT_TESTS_BENCH_SPHERE_MESH_SETTLE_SPHERES_H_
