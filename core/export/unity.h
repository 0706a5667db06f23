// Colliders for Unity: Unity Cloth and Magica Cloth 2.
#ifndef CAPFIT_CORE_EXPORT_UNITY_H_
#define CAPFIT_CORE_EXPORT_UNITY_H_

#include "core/export/collider_set.h"

namespace capfit::exports {

// unity_colliders.json and CapfitColliders.cs, a component that makes the colliders of it on a
// character. In UnityFrame(), metres. Members of the JSON, which JsonUtility reads (points are
// {x, y, z}):
//
//   bones        name, parent, position: the rig's joints where they stood
//   spheres      name, bone (index, -1 without a rig), position, bonePosition, radius: of
//   SphereColliders pairs        name, first, second (indices of spheres): ClothSphereColliderPairs
//   loneSpheres  indices of those that no pair uses; they are pairs of one sphere
//   capsules     name, bone, position, bonePosition, up, boneUp, startRadius, endRadius, length,
//                direction (1: Y), reverseDirection, alignedOnCenter, radiusSeparation: of
//                MagicaCapsuleColliders. Its first sphere is the start, at +`up`; `position` is the
//                middle and `length` the distance between the two tips, as Magica Cloth 2 takes
//                them
//   magicaSpheres  name, bone, position, bonePosition, radius: lone spheres, and capsules that are
//   one
//
// `position` and `up` are in the character's frame as it stood when it was fitted; the component
// uses them unless told otherwise, so the character must stand so while colliders are made.
// `bonePosition` and `boneUp` are in the bone's own axes as glTF importers for Unity keep them (x
// turned about): for a character that already moves.
//
// Warnings: COLLIDER_LIMIT (more than 32 spheres or pairs: Unity Cloth ignores the rest),
// INNER_SPHERES (capsules with one sphere inside the other: spheres for Magica Cloth).
[[nodiscard]] Exported WriteUnity(const ColliderSet& set);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_UNITY_H_
