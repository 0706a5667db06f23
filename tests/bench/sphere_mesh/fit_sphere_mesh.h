// The evaluation's baseline: the best sphere mesh of a budget that several settings give.
#ifndef CAPFIT_TESTS_BENCH_SPHERE_MESH_FIT_SPHERE_MESH_H_
#define CAPFIT_TESTS_BENCH_SPHERE_MESH_FIT_SPHERE_MESH_H_

#include <Eigen/Core>
#include <vector>

#include "core/mesh/body_mesh.h"
#include "tests/bench/sphere_mesh/sphere_mesh.h"
#include "tests/bench/sphere_mesh/volume_error.h"

namespace capfit::bench {

// How far to go; each is at least as good as the one before, as VolumeError sees it.
enum class Steps {
  kCollapse,  // Sphere-Meshes as published in 2013
  kDrop,      // or more spheres than it leaves, with the edges and triangles that matter least
              // dropped (see drop_hulls.h): nearly all triangles and often all but a tree of edges
  kSettle,    // and then spheres that are moved and grown (see settle_spheres.h)
};

struct FitOptions {
  // One collapse for each (see CollapseOptions); not empty. No single one is best for all budgets.
  std::vector<double> radius_bounds = {0.75, 1.0, 1.5, 0.0};
  Steps steps = Steps::kSettle;
};

// Stands for the family of public programs that take a mesh to spheres and what is interpolated
// between them: the least E_r of what all settings give, as one would pick from their outputs.
// Written from the papers; shares nothing with capfit's own fit but reading, geometry and
// measuring.
class SphereMeshFitter {
 public:
  // Collapses the mesh once for each radius bound, for budgets up to `most_primitives` >= 1.
  // Keeps a reference.
  SphereMeshFitter(const mesh::BodyMesh& mesh, int most_primitives, const FitOptions& options);

  // At most `budget` primitives, 1 <= budget <= most_primitives. About .1 s for 22, 1 s for 346.
  [[nodiscard]] SphereMesh Fit(int budget) const;

 private:
  struct Rated {
    double error;
    SphereMesh mesh;
  };
  [[nodiscard]] std::vector<SphereMesh> Candidates(int budget) const;
  [[nodiscard]] Rated Rate(SphereMesh mesh) const;

  FitOptions options_;
  VolumeError error_;
  std::vector<Eigen::Vector3d> drop_points_;
  std::vector<Eigen::Vector3d> settle_points_;
  std::vector<std::vector<SphereMesh>> series_;  // for each radius bound
};

}  // namespace capfit::bench

#endif  // CAPFIT_TESTS_BENCH_SPHERE_MESH_FIT_SPHERE_MESH_H_
