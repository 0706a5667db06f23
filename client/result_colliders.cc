#include "client/result_colliders.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "client/picture/result_set.h"
#include "client/skinning_json.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

capsule::CapsuleProfile ProfileFromWord(const std::string& word) {
  if (word == "lerped_radius") return capsule::CapsuleProfile::kLerpedRadius;
  if (word == "uniform_radius") return capsule::CapsuleProfile::kUniformRadius;
  return capsule::CapsuleProfile::kTangentHull;
}

}  // namespace

absl::StatusOr<exports::ColliderSet> CollidersOf(const std::string& result_text,
                                                 const std::string& source) {
  CAPFIT_ASSIGN_OR_RETURN(const ResultSet result, ParseResultSet(result_text));
  CAPFIT_ASSIGN_OR_RETURN(ResultSkinning skinning, ParseSkinning(result_text));
  exports::ColliderSet set;
  set.primitives.spheres = result.spheres;
  for (const auto& [first, second] : result.capsules) {
    set.primitives.capsules.push_back({std::min(first, second), std::max(first, second)});
  }
  for (std::size_t i = 0; i < result.spheres.size(); ++i) {
    const std::optional<body::Part> part = body::PartFromName(result.sphere_parts[i]);
    set.primitives.origins.push_back(
        {part.value_or(body::Part::kTorso), -1, result.sphere_mirrors[i]});
    const std::string& name = result.sphere_names[i];
    set.sphere_names.push_back(name.empty() ? absl::StrCat("sphere_", i + 1) : name);
  }
  if (result.body_from_caller) set.body_from_mesh.rotation = *result.body_from_caller;
  set.body_from_mesh.scale = result.metres_per_unit.value_or(1.0);
  set.joints = std::move(skinning.joints);
  set.sphere_joints = std::move(skinning.sphere_joints);
  set.capsule_joints = std::move(skinning.capsule_joints);
  set.profile = ProfileFromWord(result.capsule_profile);
  set.source = source;
  set.version = result.version;
  CAPFIT_RETURN_IF_ERROR(CheckColliderSet(set));
  return set;
}

}  // namespace capfit::client
