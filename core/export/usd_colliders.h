// Colliders as a USD layer in text.
#ifndef CAPFIT_CORE_EXPORT_USD_COLLIDERS_H_
#define CAPFIT_CORE_EXPORT_USD_COLLIDERS_H_

#include "absl/status/statusor.h"
#include "core/export/collider_set.h"

namespace capfit::exports {

struct UsdOptions {
  // Capsule_1 (two radii, since OpenUSD 24.08). Without: Capsule, which every reader knows, in
  // pieces of one radius that contain the tapered ones.
  bool is_tapered = true;
  // How far those may stand out. Range: [0.0002, 0.5].
  double max_overshoot_m = 0.005;
};

// One file ".usda": metersPerUnit 1, upAxis Y, right-handed; the body's front nearest to +Z.
//
// The default prim "Colliders" is an Xform with an Xform for each joint that carries colliders,
// where that joint stands (turned and moved, never scaled; not nested, so each can be constrained
// to its joint alone), and "body" for those on none. Below: Capsule_1 (tangent hull of two spheres:
// exact) along the prim's +Y with the first sphere at the bottom, height between the centres, and
// Sphere for lone spheres and for capsules of which one end contains the other; each with
// UsdPhysics' PhysicsCollisionAPI and purpose "guide", which keeps them out of pictures.
//
// Prims are named after spheres and capsules, joints after joints, with '_' for what identifiers
// cannot hold; `string capfit:name` says the name as it was. `int[] capfit:spheres` are a
// collider's spheres by index; customLayerData has StatementOf the set.
//
// Warnings: CAPSULES_REPLACED without tapered ones. Errors: INVALID_ARGUMENT for a set that is not
// sound or an option out of range.
[[nodiscard]] absl::StatusOr<Exported> WriteUsd(const ColliderSet& set,
                                                const UsdOptions& options = {});

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_USD_COLLIDERS_H_
