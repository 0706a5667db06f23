// The formats that a result can be written in, by name.
#ifndef CAPFIT_CORE_EXPORT_EXPORT_H_
#define CAPFIT_CORE_EXPORT_EXPORT_H_

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/export/collider_set.h"
#include "core/export/uniform_pieces.h"

namespace capfit::exports {

// What may be asked of a format; what does not concern it says nothing.
struct ExportOptions {
  // gltf: each collider also as a translucent mesh, so that any viewer shows it.
  bool has_preview = false;
  // usd, mujoco: shapes that every reader knows in place of tapered ones: capsules of one radius in
  // usd, convex meshes in mujoco.
  bool is_plain = false;
  // vrm, usd (plain), mujoco, urdf: how far shapes of one radius may stand out of the tapered
  // capsules that they contain. Range: [kMinOvershootM, kMaxOvershootM].
  double max_overshoot_m = kDefaultOvershootM;
};

struct ExportFormat {
  std::string_view name;     // the word of options: "gltf"
  std::string_view summary;  // one line for people: what it is, for whom
  // It puts colliders into the caller's own file, which must have been a glTF file or a VRM.
  bool needs_original = false;
  absl::StatusOr<Exported> (*write)(const ColliderSet&, std::span<const std::byte> original,
                                    const ExportOptions&) = nullptr;
};

// In the order in which they are told.
[[nodiscard]] std::span<const ExportFormat> ExportFormats();
// Nothing for an unknown name.
[[nodiscard]] const ExportFormat* FindExportFormat(std::string_view name);
// "gltf, vrm, ...": for messages.
[[nodiscard]] std::string ExportFormatNames();

// The set in the format of that name. `original`: the bytes of the mesh file that was fitted, or
// empty. INVALID_ARGUMENT for an unknown name (field "format"), a set that is not sound (see
// CheckColliderSet), options out of range, and where a format that needs the original file has
// none.
[[nodiscard]] absl::StatusOr<Exported> Export(const ColliderSet& set, const std::string& format,
                                              std::span<const std::byte> original,
                                              const ExportOptions& options = {});

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_EXPORT_H_
