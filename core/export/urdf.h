// Colliders for programs that read URDF (ROS, PyBullet, Gazebo).
#ifndef CAPFIT_CORE_EXPORT_URDF_H_
#define CAPFIT_CORE_EXPORT_URDF_H_

#include "absl/status/statusor.h"
#include "core/export/collider_set.h"
#include "core/export/uniform_pieces.h"

namespace capfit::exports {

struct UrdfOptions {
  // How far cylinders may stand out of a cone; [kMinOvershootM, kMaxOvershootM].
  double max_overshoot_m = kDefaultOvershootM;
};

// colliders.urdf in ZUpFrame(), metres. A link "capfit", and below it by a floating joint one link
// for each joint that carries something, named like it, where the joint stood (without a rig all is
// in "capfit"). URDF knows no capsule: a collision for each sphere ("NAME"), held once by the link
// of each capsule that it ends, and cylinders along their +Z ("CAPSULE_1", ...) for the cone
// between: together they enclose the capsules.
//
// Errors: INVALID_ARGUMENT for an overshoot out of range. Warnings: CAPSULES_REPLACED (how many
// capsules became how many, and by how much they are too large).
[[nodiscard]] absl::StatusOr<Exported> WriteUrdf(const ColliderSet& set,
                                                 const UrdfOptions& options = {});

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_URDF_H_
