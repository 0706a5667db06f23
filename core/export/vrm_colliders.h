// The caller's own VRM back, with colliders for its spring bones.
#ifndef CAPFIT_CORE_EXPORT_VRM_COLLIDERS_H_
#define CAPFIT_CORE_EXPORT_VRM_COLLIDERS_H_

#include <cstddef>
#include <span>

#include "absl/status/statusor.h"
#include "core/export/collider_set.h"

namespace capfit::exports {

struct VrmOptions {
  // How far the colliders may stand out of the capsules they replace. Range: [0.001, 0.1]. Half of
  // it takes about 1.4 times as many spheres (VRM 0) or twice as many capsules (VRM 1.0).
  double max_overshoot_m = 0.005;
  // Springs that the file has collide with what was added, see below.
  bool joins_springs = true;
};

// `original` must be a VRM, of which the bytes were fitted; it keeps its version, its springs,
// colliders and groups. Frame: the scene's (VRM 1.0 faces +Z, VRM 0 faces -Z), metres, +Y up,
// right-handed; offsets are in the frame of the joint's node. Where that is scaled, a node is added
// that undoes it, for readers do not agree on what a scale does to radii.
//
// - VRM 1.0: VRMC_springBone colliders. Capsules have one radius there, so each is cut into pieces
//   (UniformPieces), and one new group "capfit" has them all.
// - VRM 0: secondaryAnimation.colliderGroups, spheres only (SphereChain), one group for each
// capsule
//   or lone sphere. Offsets are written with z turned about, as that version has it.
//
// The colliders' union contains that of the capsules: coverage is kept.
//
// A spring whose joints lie inside a collider at rest would be pushed out of its shape from the
// first frame (hair on a head that the colliders enclose). So each spring is joined to those of the
// new colliders that none of its moving joints touches at rest: VRM 1.0 gets further groups
// "capfit_1", ... for springs that are not joined to all.
//
// Warnings: CAPSULES_REPLACED (how many pieces, and how much larger), SPRINGS_INSIDE (how many
// springs are kept away from colliders they lie in), and those of WriteGltf.
// Errors: INVALID_ARGUMENT for a file that is no VRM, options out of range, more than 1024 springs
// or 5000 joints that they move, and as WriteGltf.
[[nodiscard]] absl::StatusOr<Exported> WriteVrm(const ColliderSet& set,
                                                std::span<const std::byte> original,
                                                const VrmOptions& options = {});

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_VRM_COLLIDERS_H_
