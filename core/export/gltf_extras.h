// What a glTF file says of its colliders in words that need no extension.
#ifndef CAPFIT_CORE_EXPORT_GLTF_EXTRAS_H_
#define CAPFIT_CORE_EXPORT_GLTF_EXTRAS_H_

#include <nlohmann/json.hpp>
#include <string>

#include "core/export/collider_set.h"
#include "core/export/solids.h"

namespace capfit::exports {

// For the root's extras: StatementOf the set, "metres_per_unit", "spheres" (each with
// "name", "part", "center" and "radius", in the set's frame and unit) and "capsules" (pairs of
// indices into them).
[[nodiscard]] nlohmann::json ExtrasOf(const ColliderSet& set);

// For a collider's own: "spheres" (indices into the root's), and "capsule" (its index) for one of
// two.
[[nodiscard]] nlohmann::json ExtrasOf(const Solid& solid);

// Puts ExtrasOf(set) into the root's extras as "capfit", and warns (COLLIDERS_REPEATED) where one
// is there from before. Extras that are no object are left alone.
void AddExtras(const ColliderSet& set, nlohmann::json& root, std::vector<Warning>& warnings);

// Where the file is not in metres, as glTF's readers take it to be: UNIT_NOT_METRES.
void AddUnitWarning(const ColliderSet& set, std::vector<Warning>& warnings);

// The set's source, or "body".
[[nodiscard]] std::string FileStem(const ColliderSet& set);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_GLTF_EXTRAS_H_
