// Rounding that gives copies of a body the same bits again.
#ifndef CAPFIT_CORE_GEOMETRY_SNAP_H_
#define CAPFIT_CORE_GEOMETRY_SNAP_H_

#include <Eigen/Core>
#include <cmath>

namespace capfit::geometry {

// A body that was turned, moved or scaled comes back with rounding noise of 1e-15 of its size.
// That tips every choice between equals (mirrored halves, ties of a sort), and the fits part ways
// by millimetres. Values on a grid far coarser than the noise have the same bits for every copy.

// Steps of the grids. The odd factor keeps decimals and floats, which many files consist of, off
// the middle between two grid points, where noise would decide.
inline constexpr double kOddFactor = 0.94371;
// For coordinates of about 1: 1.4e-8, so that less than one in a million tips at 1e-15.
inline constexpr double kCoordinateGrid = 0x1p-26 * kOddFactor;
// For few values that must stay precise: 8.6e-13.
inline constexpr double kFineGrid = 0x1p-40 * kOddFactor;

// The grid point nearest to `value`; odd: Snap(-x) = -Snap(x). (What std::round gives, in three
// instructions in place of a call: half a step less its last bit goes to the next integer from
// where std::round does.)
[[nodiscard]] inline double Snap(double value, double grid) {
  const double steps = value / grid;
  return std::trunc(steps + std::copysign(0x1.fffffffffffffp-2, steps)) * grid;
}
[[nodiscard]] inline Eigen::Vector3d Snap(const Eigen::Vector3d& value, double grid) {
  return {Snap(value.x(), grid), Snap(value.y(), grid), Snap(value.z(), grid)};
}

}  // namespace capfit::geometry

#endif  // CAPFIT_CORE_GEOMETRY_SNAP_H_
