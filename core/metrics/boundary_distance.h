// How far points are from the boundary of the union of a set's solids.
#ifndef CAPFIT_CORE_METRICS_BOUNDARY_DISTANCE_H_
#define CAPFIT_CORE_METRICS_BOUNDARY_DISTANCE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/geometry/tapered_capsule.h"

namespace capfit::metrics {

[[nodiscard]] Eigen::AlignedBox3d BoxOf(const geometry::TaperedCapsule& solid);

// The depth in the solid that holds the point deepest is a lower bound of the answer, and the
// answer itself when that solid's nearest surface is exposed: nothing nearer can be. Where another
// solid hides it, the nearest boundary lies on a crease, where the surfaces of two solids meet
// (elsewhere on the boundary, the solid would hold the point that deep). So only creases are
// sampled; the nearest sample is then slid along its crease to the nearest point.
class BoundaryDistance {
 public:
  // Looks for creases on a grid of about `grid_points` over all solids' surfaces, in parallel. A
  // closed crease smaller than the grid's mesh (a few centimetres on a body) can be missed.
  // Keeps a reference to `solids`.
  BoundaryDistance(const std::vector<geometry::TaperedCapsule>& solids, int grid_points,
                   const ThreadPool& pool);

  // Signed distance of each point to the union's boundary: > 0 outside, < 0 inside. Infinity
  // without solids.
  [[nodiscard]] std::vector<double> SignedAt(std::span<const Eigen::Vector3d> points_m,
                                             const ThreadPool& pool) const;

 private:
  // A point of the boundary on the surfaces of two solids.
  struct CreasePoint {
    Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
    std::int32_t on = -1;     // exposed here
    std::int32_t under = -1;  // hides the former from here on
  };

  // A grid over the surface of a solid, rows of rings, with the depth of each point in the others.
  struct SurfaceGrid;

  // Whether the solid is the image of one before it.
  [[nodiscard]] bool IsLaterImage(std::size_t solid) const {
    return !images_.empty() && images_[solid] < static_cast<std::int32_t>(solid);
  }
  [[nodiscard]] CreasePoint ImageOf(const CreasePoint& point) const;
  [[nodiscard]] double ToCrease(const Eigen::Vector3d& point_m) const;
  void FindNeighbours(const ThreadPool& pool);
  // Whether no other solid holds a point on the surface of `solid`.
  [[nodiscard]] bool IsExposed(const Eigen::Vector3d& point_m, std::int32_t solid) const;
  [[nodiscard]] SurfaceGrid MakeGrid(std::size_t solid, double spacing_m) const;
  void FindCreases(std::size_t solid, double spacing_m, std::vector<CreasePoint>& found) const;
  // The crease that runs between an exposed point, which knows what hides the other, and that.
  [[nodiscard]] CreasePoint Between(const CreasePoint& exposed, Eigen::Vector3d hidden) const;
  [[nodiscard]] double DepthAt(const Eigen::Vector3d& point_m, std::int32_t solid) const;
  [[nodiscard]] double Slide(const Eigen::Vector3d& point_m, const CreasePoint& start) const;

  // A kd-tree over the crease points, in place: the middle of a range splits it.
  void Sort(std::size_t begin, std::size_t end);
  void Search(const Eigen::Vector3d& point_m, std::size_t begin, std::size_t end,
              double& squared_best, std::size_t& best) const;

  const std::vector<geometry::TaperedCapsule>& solids_;
  std::vector<std::int32_t> images_;                   // see solid_images.h
  std::vector<std::vector<std::int32_t>> neighbours_;  // by solid: the others that reach into it
  double tolerance_m_;
  std::vector<CreasePoint> creases_;
  std::vector<std::uint8_t> split_axis_;  // by crease point
};

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_BOUNDARY_DISTANCE_H_
