// Colliders for Unreal Engine: a physics asset, made by a script in the editor.
#ifndef CAPFIT_CORE_EXPORT_UNREAL_H_
#define CAPFIT_CORE_EXPORT_UNREAL_H_

#include "core/export/collider_set.h"

namespace capfit::exports {

// unreal_physics_asset.py for the editor's Python (Unreal 5.0 and later), with its data in it:
// bones and shapes in UnrealFrame(), centimetres, as the body stood when it was fitted. Run in the
// editor it takes a skeletal mesh, finds by which quarter turn the importer stood it up, and writes
// each shape in the axes that its bone has there into the mesh's physics asset:
// FKTaperedCapsuleElem with Radius0, the first sphere, at +Z, Length between the centres, and
// FKSphereElem for lone spheres. What bodies there had before is replaced. Names of elements are
// those of capsules and spheres.
//
// Warnings: NO_RIG (without a rig all hangs on the root bone), INNER_SPHERES (capsules with one
// sphere inside the other are spheres).
[[nodiscard]] Exported WriteUnreal(const ColliderSet& set);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_UNREAL_H_
