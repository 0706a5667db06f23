#include "client/flag_names.h"

#include <array>
#include <cctype>

#include "core/base/status.h"

namespace capfit::client {
namespace {

constexpr std::array kFlagNames = {
    FlagName{"options.budget.max_primitives", "--max-primitives"},
    FlagName{"options.budget.spheres_and_capsules.max_spheres", "--max-spheres"},
    FlagName{"options.budget.spheres_and_capsules.max_capsules", "--max-capsules"},
    FlagName{"options.budget.max_polygon_error", "--polygon-error"},
    FlagName{"options.fit_mode", "--fit"},
    FlagName{"options.quality", "--quality"},
    FlagName{"options.parts", "--parts"},
    FlagName{"options.require_parts", "--require-parts"},
    FlagName{"options.sex", "--sex"},
    FlagName{"options.skinning", "--skinning"},
    FlagName{"options.landmarks", "--landmarks"},
    FlagName{"options.seed", "--seed"},
    FlagName{"options.want_feature_polygons", "--polygons"},
    FlagName{"options.tolerance_m", "--tolerance-mm"},
    FlagName{"options.want_vertex_gaps", "--heat-map"},
    FlagName{"options.engine", "--engine"},
    FlagName{"exports", "--export"},
    FlagName{"layout", "--layout"},
    FlagName{"options.include_parts", "--include"},
    FlagName{"options.exclude_parts", "--exclude"},
    FlagName{"options.include_hair", "--hair"},
    FlagName{"options.include_skirt", "--skirt"},
    FlagName{"mesh.unit", "--unit"},
    FlagName{"mesh.up_axis", "--up"},
    FlagName{"mesh.file", "BODY"},
    FlagName{"request_id", "--request-id"},
    // Of mannequin.
    FlagName{"height_m", "--height-m"},
    FlagName{"bust_m", "--bust-m"},
    FlagName{"waist_m", "--waist-m"},
    FlagName{"hip_m", "--hip-m"},
    FlagName{"arm_angle_deg", "--arm-angle-deg"},
    FlagName{"faces", "--faces"},
    FlagName{"parts", "--parts"},
    // Of render and animate.
    FlagName{"width", "--width"},
    FlagName{"height", "--height"},
    FlagName{"heat_limit_mm", "--heat-limit-mm"},
    FlagName{"mm_per_unit", "--mm-per-unit"},
    FlagName{"gaps", "--gaps"},
    FlagName{"frames", "--frames"},
    FlagName{"centers", "--centers"},
    FlagName{"show", "--show"},
    FlagName{"views", "--views"},
    FlagName{"polygons", "--polygons"},
    FlagName{"output", "--output"},
};

bool IsNameLetter(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

// Whether text[begin, end) is a name of its own, and not a piece of a longer one. What follows may
// be an index or a member ("options.landmarks.neck"), which is kept.
bool StandsAlone(const std::string& text, std::size_t begin, std::size_t end) {
  const bool starts = begin == 0 || (!IsNameLetter(text[begin - 1]) && text[begin - 1] != '.');
  return starts && (end == text.size() || !IsNameLetter(text[end]));
}

bool HasDot(std::string_view path) { return path.find('.') != std::string_view::npos; }

void ReplaceAll(std::string& text, const FlagName& name) {
  std::size_t from = 0;
  while ((from = text.find(name.path, from)) != std::string::npos) {
    if (StandsAlone(text, from, from + name.path.size())) {
      text.replace(from, name.path.size(), name.flag);
      from += name.flag.size();
    } else {
      from += name.path.size();
    }
  }
}

}  // namespace

std::span<const FlagName> FlagNames() { return kFlagNames; }

std::string InFlags(const absl::Status& status) {
  std::string text(status.message());
  const std::string field = FieldOf(status).value_or("");
  for (const FlagName& name : kFlagNames) {
    if (HasDot(name.path)) {
      ReplaceAll(text, name);
    } else if (field.rfind(name.path, 0) == 0 && text.rfind(field, 0) == 0 &&
               StandsAlone(text, 0, name.path.size())) {
      text.replace(0, name.path.size(), name.flag);
    }
  }
  return text;
}

}  // namespace capfit::client
