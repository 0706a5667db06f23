// Triangles that will be cut by many planes.
#ifndef CAPFIT_CORE_MESH_PLANE_CUTTER_H_
#define CAPFIT_CORE_MESH_PLANE_CUTTER_H_

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/mesh/plane_cut.h"

namespace capfit::mesh {

// Neighbouring triangles are looked at in groups, each with a box around it, so that a plane
// touches few of them when neighbours in the list are neighbours in space.
class PlaneCutter {
 public:
  // Both spans must outlive this. O(triangles).
  PlaneCutter(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
              const ThreadPool& pool = ThreadPool(1));

  // The pieces of the cut by the plane through `origin` across `normal` (length 1), in the order of
  // the triangles; see CutTriangle.
  [[nodiscard]] std::vector<CutPiece> Cut(const Eigen::Vector3d& origin,
                                          const Eigen::Vector3d& normal) const;

  [[nodiscard]] std::span<const Eigen::Vector3d> points() const { return points_; }

 private:
  struct Box {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    Eigen::Vector3d half = Eigen::Vector3d::Zero();
  };
  void CutGroup(std::size_t group, const Eigen::Vector3d& origin, const Eigen::Vector3d& normal,
                std::vector<CutPiece>& pieces) const;

  std::span<const Eigen::Vector3d> points_;
  std::span<const Triangle> triangles_;
  std::vector<Box> groups_;  // of triangles
  std::vector<Box> blocks_;  // of groups
};

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_PLANE_CUTTER_H_
