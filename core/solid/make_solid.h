// One closed surface round a character of many shells.
#ifndef CAPFIT_CORE_SOLID_MAKE_SOLID_H_
#define CAPFIT_CORE_SOLID_MAKE_SOLID_H_

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/base/warning.h"
#include "core/mesh/body_mesh.h"

namespace capfit::solid {

struct SolidOptions {
  // Cells that the surface of the shells passes, about: four times as many halve their size. A body
  // of 2 m^2 gets cells of 6 mm from 60,000.
  std::size_t cells = 60'000;
};

struct Solid {
  mesh::BodyMesh mesh;  // in the caller's frame and unit; `vertex_of_source` is empty
  double cell = 0.0;    // side of a cell, in the caller's unit
  std::vector<Warning> warnings;
};

[[nodiscard]] absl::StatusOr<Solid> MakeSolid(std::span<const Eigen::Vector3d> positions,
                                              std::span<const mesh::Triangle> triangles,
                                              const SolidOptions& options = {},
                                              const ThreadPool& pool = ThreadPool(1),
                                              const FitObserver& observer = NullObserver());

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_MAKE_SOLID_H_
