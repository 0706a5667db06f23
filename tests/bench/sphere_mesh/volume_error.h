// The relative volume error E_r of sphere meshes against one body, for choosing among them.
#ifndef CAPFIT_TESTS_BENCH_SPHERE_MESH_VOLUME_ERROR_H_
#define CAPFIT_TESTS_BENCH_SPHERE_MESH_VOLUME_ERROR_H_

#include <vector>

#include "core/mesh/body_mesh.h"
#include "core/metrics/column_grid.h"
#include "tests/bench/sphere_mesh/sphere_mesh.h"

namespace capfit::bench {

// Cut along `columns` x `columns` columns that cover the body's box and a tenth of its diagonal
// around it; what a set has beyond them is not seen.
class VolumeError {
 public:
  VolumeError(const mesh::BodyMesh& mesh, int columns);

  // (Volume in the solid or in the body but not in both) / volume of the body.
  [[nodiscard]] double Of(const SphereMesh& mesh) const;

 private:
  metrics::ColumnGrid grid_;
  std::vector<metrics::RowIntervals> body_rows_;
  double body_length_ = 0.0;
  double sag_ = 0.0;
};

}  // namespace capfit::bench

#endif  // CAPFIT_TESTS_BENCH_SPHERE_MESH_VOLUME_ERROR_H_
