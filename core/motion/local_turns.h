// How the body has turned around each sphere since the pose in which it was fitted.
#ifndef CAPFIT_CORE_MOTION_LOCAL_TURNS_H_
#define CAPFIT_CORE_MOTION_LOCAL_TURNS_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/capsule/primitive_set.h"

namespace capfit::motion {

class LocalTurns {
 public:
  // Each point counts to the two ends of the solid that is nearest to it at rest, more to the
  // nearer one. `rest_m` must outlive this. O(points * solids nearby).
  LocalTurns(std::span<const Eigen::Vector3d> rest_m, const capsule::PrimitiveSet& set,
             const ThreadPool& pool);

  // By sphere the rotation that brings its points at rest nearest to where they are now, by least
  // squares (Kabsch 1976). A sphere with too few points turns as the nearest one that has enough.
  // `now_m` in the order of the points at rest. O(points).
  [[nodiscard]] std::vector<Eigen::Matrix3d> At(std::span<const Eigen::Vector3d> now_m) const;

 private:
  struct Share {
    std::uint32_t point;
    std::uint32_t sphere;
    double weight;
  };

  std::span<const Eigen::Vector3d> rest_m_;
  std::vector<Share> shares_;
  std::vector<double> weights_;             // by sphere, summed
  std::vector<Eigen::Vector3d> middles_m_;  // of its points at rest
  std::vector<std::size_t> stands_for_;     // by sphere: itself, or the one that it turns as
};

}  // namespace capfit::motion

#endif  // CAPFIT_CORE_MOTION_LOCAL_TURNS_H_
