// Colliders for Jolt, Bullet and Rapier: one JSON file each, shape by shape with the arguments that
// the engine's own constructors take.
#ifndef CAPFIT_CORE_EXPORT_PHYSICS_JSON_H_
#define CAPFIT_CORE_EXPORT_PHYSICS_JSON_H_

#include "core/export/collider_set.h"

namespace capfit::exports {

// Frame of all three: YUpFrame(), metres, right-handed. The root holds what every file says of
// itself (file_text.h), "joints" (name, parent, position, rotation: those that the rig has, where
// they stood when the body was fitted) and "shapes": each capsule, then each sphere that no capsule
// uses. Of each shape:
//
//   name, spheres            its own name and those of its spheres, bottom first (one for a sphere)
//   joint                    index into "joints"; -1 without a rig
//   position, rotation       of its frame: the middle of the two centres; the quaternion (x, y, z,
//   w)
//                            takes +Y to the direction from bottom to top
//   joint_position,          the same in the joint's frame (turned and moved, never scaled);
//   without joint_rotation           a rig the same numbers again shape                    the
//   engine's name of it, with its arguments:
//
// Jolt (jolt_colliders.json):
//   TaperedCapsule           half_height, top_radius, bottom_radius
//   Sphere                   radius (also where one sphere of a capsule contains the other)
// Bullet (bullet_colliders.json); margin 0 is meant, Bullet's own lies within the radius:
//   btMultiSphereShape       positions, radii: two each, in the shape's frame
//   btSphereShape            radius
// Rapier (rapier_colliders.json), which has no tapered capsule:
//   capsule                  half_height, radius: where both radii are the same
//   convexHull               points, three numbers each, in the shape's frame; deviation: how far
//   the
//                            hull may lie outside of the true shape, nothing of which it leaves out
//   ball                     radius
//
// Warnings: CAPSULES_REPLACED (Rapier: how many, and the largest deviation); INNER_SPHERES
// (capsules that are a sphere, in all three).
[[nodiscard]] Exported WriteJolt(const ColliderSet& set);
[[nodiscard]] Exported WriteBullet(const ColliderSet& set);
[[nodiscard]] Exported WriteRapier(const ColliderSet& set);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_PHYSICS_JSON_H_
