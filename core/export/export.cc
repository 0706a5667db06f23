#include "core/export/export.h"

#include <array>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/export/gltf_colliders.h"
#include "core/export/mesh_hulls.h"
#include "core/export/mujoco.h"
#include "core/export/nvcloth.h"
#include "core/export/physics_json.h"
#include "core/export/table.h"
#include "core/export/unity.h"
#include "core/export/unreal.h"
#include "core/export/urdf.h"
#include "core/export/usd_colliders.h"
#include "core/export/vrm_colliders.h"

namespace capfit::exports {
namespace {

using Bytes = std::span<const std::byte>;
using Result = absl::StatusOr<Exported>;

Result ToGltf(const ColliderSet& set, Bytes original, const ExportOptions& options) {
  return WriteGltf(set, original, {.has_preview = options.has_preview});
}

Result ToVrm(const ColliderSet& set, Bytes original, const ExportOptions& options) {
  return WriteVrm(set, original, {.max_overshoot_m = options.max_overshoot_m});
}

Result ToUsd(const ColliderSet& set, Bytes /*original*/, const ExportOptions& options) {
  return WriteUsd(set,
                  {.is_tapered = !options.is_plain, .max_overshoot_m = options.max_overshoot_m});
}

Result ToHulls(const ColliderSet& set, Bytes /*original*/, const ExportOptions& /*options*/) {
  return WriteHulls(set);
}

Result ToUnion(const ColliderSet& set, Bytes /*original*/, const ExportOptions& /*options*/) {
  return WriteUnion(set);
}

Result ToMujoco(const ColliderSet& set, Bytes /*original*/, const ExportOptions& options) {
  return WriteMujoco(set,
                     {.as_meshes = options.is_plain, .max_overshoot_m = options.max_overshoot_m});
}

Result ToUrdf(const ColliderSet& set, Bytes /*original*/, const ExportOptions& options) {
  return WriteUrdf(set, {.max_overshoot_m = options.max_overshoot_m});
}

// A format that needs nothing but the set, and cannot fail.
template <Exported (*kWrite)(const ColliderSet&)>
Result ToAlone(const ColliderSet& set, Bytes /*original*/, const ExportOptions& /*options*/) {
  return kWrite(set);
}

}  // namespace

std::span<const ExportFormat> ExportFormats() {
  static constexpr std::array<ExportFormat, 14> kFormats = {{
      {"gltf", "the caller's GLB back, colliders on its bones (KHR_implicit_shapes)", false,
       ToGltf},
      {"vrm", "the caller's VRM back with spring bone colliders (0 and 1.0)", true, ToVrm},
      {"unity", "Unity Cloth and Magica Cloth 2: JSON and a C# component", false,
       ToAlone<WriteUnity>},
      {"unreal", "Unreal: an editor script that makes the physics asset", false,
       ToAlone<WriteUnreal>},
      {"nvcloth", "NvCloth, PhysX 3: a C header of arrays", false, ToAlone<WriteNvCloth>},
      {"jolt", "Jolt: tapered capsules as JSON", false, ToAlone<WriteJolt>},
      {"bullet", "Bullet: multi-sphere shapes as JSON", false, ToAlone<WriteBullet>},
      {"rapier", "Rapier: capsules and convex hulls as JSON", false, ToAlone<WriteRapier>},
      {"mujoco", "MuJoCo: a model (MJCF)", false, ToMujoco},
      {"urdf", "URDF: spheres and cylinders", false, ToUrdf},
      {"usd", "USD layer with Capsule_1 and UsdPhysics", false, ToUsd},
      {"hulls", "OBJ and GLB: a closed mesh for each capsule (Blender, Houdini)", false, ToHulls},
      {"union", "OBJ and GLB: one closed mesh of all (Blender, Houdini)", false, ToUnion},
      {"csv", "two tables", false, ToAlone<WriteTables>},
  }};
  return kFormats;
}

const ExportFormat* FindExportFormat(std::string_view name) {
  for (const ExportFormat& format : ExportFormats()) {
    if (format.name == name) return &format;
  }
  return nullptr;
}

std::string ExportFormatNames() {
  std::string names;
  for (const ExportFormat& format : ExportFormats()) {
    absl::StrAppend(&names, names.empty() ? "" : ", ", std::string(format.name));
  }
  return names;
}

absl::StatusOr<Exported> Export(const ColliderSet& set, const std::string& format,
                                std::span<const std::byte> original, const ExportOptions& options) {
  const ExportFormat* const known = FindExportFormat(format);
  if (known == nullptr) {
    return InvalidField(
        ErrorReason::kUnknownValue, "format",
        absl::StrCat("is \"", format.substr(0, 40), "\", must be one of ", ExportFormatNames()),
        {{"value", format.substr(0, 40)}, {"limit", ExportFormatNames()}});
  }
  CAPFIT_RETURN_IF_ERROR(CheckColliderSet(set));
  if (!(options.max_overshoot_m >= kMinOvershootM && options.max_overshoot_m <= kMaxOvershootM)) {
    return OutOfRange("max_overshoot_m", options.max_overshoot_m, kMinOvershootM, kMaxOvershootM);
  }
  if (known->needs_original && original.empty()) {
    return InvalidField(
        ErrorReason::kMissing, "original",
        absl::StrCat("is missing; ", format, " puts the colliders into the file that was fitted"));
  }
  return known->write(set, original, options);
}

}  // namespace capfit::exports
