#include "core/export/gltf_extras.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/body/anatomy.h"
#include "core/export/file_text.h"
#include "core/export/frame.h"

namespace capfit::exports {
namespace {

using nlohmann::json;

// Of a body's height, which nobody knows to better than a hundredth.
constexpr double kUnitTolerance = 0.01;

json SphereExtras(const ColliderSet& set, std::size_t index) {
  const geometry::Sphere& sphere = set.primitives.spheres[index];
  return {{"name", set.sphere_names[index]},
          {"part", std::string(body::PartName(set.primitives.origins[index].part))},
          {"center", {sphere.center_m.x(), sphere.center_m.y(), sphere.center_m.z()}},
          {"radius", sphere.radius_m}};
}

}  // namespace

json ExtrasOf(const ColliderSet& set) {
  json spheres = json::array();
  for (std::size_t i = 0; i < set.sphere_count(); ++i) spheres.push_back(SphereExtras(set, i));
  const Frame scene{"the scene's, right-handed, +Y up", Eigen::Matrix3d::Identity(),
                    1.0 / set.body_from_mesh.scale};
  json extras = {{"metres_per_unit", set.body_from_mesh.scale},
                 {"spheres", std::move(spheres)},
                 {"capsules", set.primitives.capsules}};
  for (const auto& [key, value] : StatementOf(
           set, "gltf", scene, "capsules along their node's +Y, the first sphere at the bottom")) {
    extras[key] = value;
  }
  return extras;
}

json ExtrasOf(const Solid& solid) {
  if (!solid.capsule.has_value()) return {{"spheres", {solid.spheres[0]}}};
  return {{"capsule", *solid.capsule}, {"spheres", solid.spheres}};
}

void AddExtras(const ColliderSet& set, json& root, std::vector<Warning>& warnings) {
  json& extras = root["extras"];
  if (!extras.is_null() && !extras.is_object()) return;
  if (extras.contains("capfit")) {
    warnings.push_back({"COLLIDERS_REPEATED",
                        "the file has colliders of capfit's already, and keeps them: export from "
                        "the file as it was before"});
  }
  extras["capfit"] = ExtrasOf(set);
}

void AddUnitWarning(const ColliderSet& set, std::vector<Warning>& warnings) {
  const double metres = set.body_from_mesh.scale;
  if (std::abs(metres - 1.0) <= kUnitTolerance) return;
  warnings.push_back({"UNIT_NOT_METRES",
                      absl::StrCat("glTF counts in metres, but a unit of this file is ", metres,
                                   " m: the colliders fit the file and are as large as it is")});
}

std::string FileStem(const ColliderSet& set) { return set.source.empty() ? "body" : set.source; }

}  // namespace capfit::exports
