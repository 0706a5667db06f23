// Loose triangles as closed shells whose union is the solid.
#ifndef CAPFIT_CORE_SOLID_SHELLS_H_
#define CAPFIT_CORE_SOLID_SHELLS_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/mesh/edge_mates.h"

namespace capfit::solid {

// A hole of a shell and how it was closed.
struct Rim {
  std::uint32_t shell = 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // mean of its vertices
  // Of the closing, out of the shell, as long as its area is large.
  Eigen::Vector3d area_vector = Eigen::Vector3d::Zero();
  std::vector<std::uint32_t> vertices;  // in the closing's order
};

// Triangles (of the positions they were made from) that hang together are one shell. Each shell is
// closed by triangles across its holes and turned so that its volume is positive: inside of it is
// where its own winding number is above 0. It may cut through itself and through others.
struct Shells {
  std::vector<mesh::Triangle> triangles;
  std::vector<std::uint32_t> shell_of_triangle;
  std::vector<double> volumes;  // of each shell, >= 0
  std::vector<double> areas;    // of each shell as closed
  std::vector<Rim> rims;
  double area = 0.0;  // of all triangles but those across holes
};

// `triangles`: corners in range and different within each. Vertices at open edges are welded where
// they are within `weld_tolerance`. Close to O(n). Nothing of use where `observer` cancels.
[[nodiscard]] Shells FindShells(std::span<const Eigen::Vector3d> positions,
                                std::vector<mesh::Triangle> triangles, double weld_tolerance,
                                const ThreadPool& pool, const FitObserver& observer);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_SHELLS_H_
