// The caller's own glTF file back, with colliders on its bones.
#ifndef CAPFIT_CORE_EXPORT_GLTF_COLLIDERS_H_
#define CAPFIT_CORE_EXPORT_GLTF_COLLIDERS_H_

#include <cstddef>
#include <span>

#include "absl/status/statusor.h"
#include "core/export/collider_set.h"

namespace capfit::exports {

struct GltfOptions {
  // Each collider also as a translucent mesh, so that any viewer shows it. The meshes come after
  // the file's own in its lists and binary chunk; about 6 kB each.
  bool has_preview = false;
};

// A GLB: `original` (GLB, VRM or .gltf with its buffers inside: the bytes that were fitted) with
// one new node for each capsule and each sphere that no capsule uses, below the node of the joint
// that carries it, or below one node "capfit_colliders" at the root of the scene where the set has
// no joints. All that the file holds stays, see gltf_document.h. Where `original` is no glTF (the
// mesh came as OBJ, or as arrays): a new file with the colliders alone, in metres, +Y up.
//
// - Frame: the scene's, right-handed. Unit: the file's; glTF says metres, and a file that is in
//   another unit gets colliders in that unit and the warning UNIT_NOT_METRES.
// - Shapes: KHR_implicit_shapes, "capsule" (the tangent hull of two spheres: exact) with its height
//   along the node's +Y, the first sphere at the bottom, and "sphere" for lone ones and for
//   capsules of which one end contains the other. Referred to by the node's
//   KHR_physics_rigid_bodies collider.geometry.shape.
// - The new nodes undo the scale above them, so that their own frame is a turned and moved world
//   frame: shapes have the scene's unit also for readers that do not scale them. A joint whose axes
//   are scaled unlike gets a node between.
// - For readers without the extensions: extras.capfit of the root (all spheres, all capsules, where
//   they stand in the scene) and of each new node (which of them it is).
// - Posing a joint moves its colliders rigidly, as it moves vertices that it alone holds. A sphere
//   that two capsules share may lie in both at different places then.
//
// Warnings: UNIT_NOT_METRES, JOINT_FLATTENS (a joint whose matrix has no inverse: its colliders
// hang on the nearest node above that has one), COLLIDERS_REPEATED (the file has colliders of
// capfit's already), RIG_LEFT_OUT (joints, but no file of theirs).
// Errors: INVALID_ARGUMENT for a set that is not sound or whose joints are not nodes of `original`,
// and for what Open() refuses.
[[nodiscard]] absl::StatusOr<Exported> WriteGltf(const ColliderSet& set,
                                                 std::span<const std::byte> original,
                                                 const GltfOptions& options = {});

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_GLTF_COLLIDERS_H_
