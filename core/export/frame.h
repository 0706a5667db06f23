// Where engines think up is: frames of export formats, all said from one upright frame.
#ifndef CAPFIT_CORE_EXPORT_FRAME_H_
#define CAPFIT_CORE_EXPORT_FRAME_H_

#include <Eigen/Core>
#include <string_view>

#include "core/export/collider_set.h"
#include "core/geometry/similarity.h"

namespace capfit::exports {

// A frame in which a format keeps its points. The upright frame that it is said from: metres, +Y
// up, the body's front nearest to +Z, the origin where the mesh has it.
struct Frame {
  std::string_view name;         // "metres, +Y up, +Z ahead, right-handed": as files say it
  Eigen::Matrix3d from_upright;  // rows are the frame's axes; determinant -1 where left-handed
  double units_per_metre = 1.0;

  [[nodiscard]] Eigen::Vector3d Point(const Eigen::Vector3d& upright_m) const {
    return units_per_metre * (from_upright * upright_m);
  }
  [[nodiscard]] double Length(double length_m) const { return units_per_metre * length_m; }
};

// glTF, Jolt, Bullet, Rapier, NvCloth: metres, +Y up, right-handed; the upright frame itself.
[[nodiscard]] const Frame& YUpFrame();
// MuJoCo, URDF: metres, +Z up, +X ahead, the body's left at +Y, right-handed.
[[nodiscard]] const Frame& ZUpFrame();
// Unity: metres, +Y up, +Z ahead, left-handed, the body's left at -X: as its importers show a glTF
// or FBX file (they turn x about).
[[nodiscard]] const Frame& UnityFrame();
// Unreal: centimetres, +Z up, left-handed, the body's front at +Y and its left at +X: as its
// importers show a character before the component is turned.
[[nodiscard]] const Frame& UnrealFrame();

// From the mesh's frame to the upright one. The axes are only exchanged, never tilted, so that
// colliders lie on the mesh that an importer has stood up in the same way: what the body's frame is
// turned by beyond the nearest quarter turns stays in it.
[[nodiscard]] geometry::Similarity UprightFromMesh(const ColliderSet& set);

// The same set with positions, radii and joints in the upright frame, metres.
[[nodiscard]] ColliderSet Upright(ColliderSet set);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_FRAME_H_
