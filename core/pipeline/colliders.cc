#include "core/pipeline/colliders.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/export/export.h"
#include "core/formats/gltf_chunks.h"
#include "core/pipeline/engines.h"

namespace capfit::pipeline {

exports::ColliderSet CollidersOf(const FitResult& result, std::string source) {
  exports::ColliderSet set;
  set.primitives = result.primitives;
  set.sphere_names = result.sphere_names;
  set.body_from_mesh = result.body_from_caller;
  set.joints = result.joints;
  set.sphere_joints = result.sphere_joints;
  set.capsule_joints = result.capsule_joints;
  set.profile = ProfileOf(result.effective_options);
  set.source = std::move(source);
  set.version = result.version;
  return set;
}

absl::Status CheckExports(std::span<const ExportWish> wishes, std::span<const std::byte> original) {
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const exports::ExportFormat* const format = exports::FindExportFormat(wishes[i].format);
    if (format == nullptr || !format->needs_original || formats::LooksLikeGlb(original)) continue;
    return InvalidField(ErrorReason::kConflict, absl::StrCat("exports[", i, "].format"),
                        absl::StrCat("is ", wishes[i].format,
                                     ", which puts the colliders into the file that was fitted: "
                                     "send the body as a GLB or VRM file"));
  }
  return absl::OkStatus();
}

absl::Status AddExports(std::span<const ExportWish> wishes, std::span<const std::byte> original,
                        const std::string& source, FitResult& result) {
  if (wishes.empty()) return absl::OkStatus();
  const exports::ColliderSet set = CollidersOf(result, source);
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    absl::StatusOr<exports::Exported> exported =
        exports::Export(set, wishes[i].format, original, wishes[i].options);
    if (!exported.ok()) {
      return WithField(exported.status(), absl::StrCat("exports[", i, "].format"));
    }
    for (Warning& warning : exported->warnings) {
      warning.message = absl::StrCat(wishes[i].format, ": ", warning.message);
      result.warnings.push_back(std::move(warning));
    }
    for (exports::ExportFile& file : exported->files) {
      result.exports.push_back({wishes[i].format, std::move(file)});
    }
  }
  return absl::OkStatus();
}

}  // namespace capfit::pipeline
