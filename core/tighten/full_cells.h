// Where a body is full: space that a set must not leave empty.
#ifndef CAPFIT_CORE_TIGHTEN_FULL_CELLS_H_
#define CAPFIT_CORE_TIGHTEN_FULL_CELLS_H_

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace capfit::tighten {

// Equal cubes that lie inside the body as a whole, in a box of cubes around it.
struct FullCells {
  Eigen::Vector3f origin_m = Eigen::Vector3f::Zero();  // lower corner of the box, body frame
  float cells_per_m = 0.0f;
  int nx = 0, ny = 0, nz = 0;
  bool folded = false;                // holds what both halves of the body have, at x >= 0
  std::vector<std::uint8_t> is_full;  // z fastest, then x

  // Whether a point lies in a full cell.
  [[nodiscard]] bool Holds(const Eigen::Vector3d& point_m) const {
    Eigen::Array3f cell = point_m.cast<float>();
    if (folded) cell.x() = std::abs(cell.x());
    cell = (cell - origin_m.array()) * cells_per_m;
    const Eigen::Array3f end = Eigen::Array3i(nx, ny, nz).cast<float>();
    if (!(cell >= 0.0f && cell < end).all()) return false;
    const Eigen::Array3i index = cell.cast<int>();
    return is_full[(std::size_t{1} * nx * index.y() + index.x()) * nz + index.z()] != 0;
  }
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_FULL_CELLS_H_
