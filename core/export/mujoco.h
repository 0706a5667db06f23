// Colliders for MuJoCo: a model in its own XML (MJCF).
#ifndef CAPFIT_CORE_EXPORT_MUJOCO_H_
#define CAPFIT_CORE_EXPORT_MUJOCO_H_

#include "absl/status/statusor.h"
#include "core/export/collider_set.h"
#include "core/export/uniform_pieces.h"

namespace capfit::exports {

struct MujocoOptions {
  // Convex meshes around tapered capsules in place of capsules of one radius: one geom each, up to
  // LatheDeviation of the radius too large.
  bool as_meshes = false;
  // How far capsules of one radius may stand out; [kMinOvershootM, kMaxOvershootM].
  double max_overshoot_m = kDefaultOvershootM;
};

// mujoco_colliders.xml in ZUpFrame(), metres. Each joint that carries something is a mocap body of
// the world, of the joint's name, standing where the joint stood (without a rig: one body,
// "capfit"), so that data.mocap_pos and mocap_quat move it; geoms lie in its frame. A capsule
// becomes one or more geoms "NAME" (NAME_2, ...) of type capsule by `fromto`, whose union encloses
// it; what is a ball becomes a sphere. The body's own frame has the axes that the joint has.
//
// Errors: INVALID_ARGUMENT for an overshoot out of range. Warnings: CAPSULES_REPLACED (how many
// capsules became what, and by how much it is too large).
[[nodiscard]] absl::StatusOr<Exported> WriteMujoco(const ColliderSet& set,
                                                   const MujocoOptions& options = {});

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_MUJOCO_H_
