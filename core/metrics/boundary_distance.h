// How far a point inside the union of a set's solids is from the union's boundary.
#ifndef CAPFIT_CORE_METRICS_BOUNDARY_DISTANCE_H_
#define CAPFIT_CORE_METRICS_BOUNDARY_DISTANCE_H_

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/metrics/union_distance.h"

namespace capfit::metrics {

// The depth in the solid that holds the point deepest is a lower bound of the answer, and the
// answer itself when that solid's nearest surface is exposed: nothing nearer can be. Where another
// solid hides it, the nearest boundary lies on a crease, where the surfaces of two solids meet
// (elsewhere on the boundary, the solid would hold the point that deep). So only creases are
// sampled; the nearest sample is then slid along its crease to the nearest point.
class BoundaryDistance {
 public:
  // Looks for creases on a grid of about `grid_points` over all solids' surfaces, in parallel. A
  // closed crease smaller than the grid's mesh (some millimetres) can be missed.
  // Keeps a reference to `set`.
  BoundaryDistance(const UnionDistance& set, int grid_points, const ThreadPool& pool);

  // Signed distance to the union's boundary: > 0 outside, < 0 inside.
  [[nodiscard]] double SignedAt(const Eigen::Vector3d& point_m) const;
  // The same without the sign.
  [[nodiscard]] double At(const Eigen::Vector3d& point_m) const {
    return std::abs(SignedAt(point_m));
  }

  // A point of the boundary on the surfaces of two solids.
  struct CreasePoint {
    Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
    std::int32_t on = -1;     // exposed here
    std::int32_t under = -1;  // hides the former from here on
  };
  [[nodiscard]] const std::vector<CreasePoint>& crease_points() const { return creases_; }

 private:
  [[nodiscard]] bool IsExposed(const Eigen::Vector3d& point_m) const;
  void FindCreases(std::size_t solid, double spacing_m, std::vector<CreasePoint>& found) const;
  [[nodiscard]] CreasePoint Bisect(std::size_t solid, Eigen::Vector2d exposed,
                                   Eigen::Vector2d hidden) const;
  [[nodiscard]] double Slide(const Eigen::Vector3d& point_m, const CreasePoint& start) const;

  // A kd-tree over the crease points, in place: the middle of a range splits it.
  void Sort(std::size_t begin, std::size_t end);
  void Search(const Eigen::Vector3d& point_m, std::size_t begin, std::size_t end,
              double& squared_best, std::size_t& best) const;

  const UnionDistance& set_;
  double tolerance_m_;
  std::vector<CreasePoint> creases_;
  std::vector<std::uint8_t> split_axis_;  // by crease point
};

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_BOUNDARY_DISTANCE_H_
