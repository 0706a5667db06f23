// The part of unreal_physics_asset.py that is the same for every set.
#ifndef CAPFIT_CORE_EXPORT_UNREAL_SCRIPT_H_
#define CAPFIT_CORE_EXPORT_UNREAL_SCRIPT_H_

#include <string_view>

namespace capfit::exports {

// Python 3. Reads what stands before it: DATA, a dictionary with
//   bones   name, parent (index, -1), position [x, y, z]
//   shapes  name, bone (index, -1: the root), kind ("tapered" or "sphere"), center, and radius0,
//   radius1,
//           length, axis (unit vector from the centre to Radius0's end), or radius
[[nodiscard]] std::string_view UnrealScript();

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_UNREAL_SCRIPT_H_
