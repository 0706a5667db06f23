#include "proto/wire/options_conversion.h"

#include <cmath>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/plain_text.h"
#include "core/base/status.h"
#include "core/pipeline/engines.h"
#include "proto/wire/enum_conversion.h"
#include "proto/wire/export_conversion.h"
#include "proto/wire/layout_conversion.h"

namespace capfit::wire {
namespace {

// EffectiveOptions.layout of a layout that came with the request.
constexpr char kOwnLayout[] = "own";

// Fills `target` from an enum of the wire, or names the number that is not known.
template <typename Core, typename Wire>
absl::Status Read(const std::string& field, Wire value, Core& target) {
  const std::optional<Core> known = FromWire(value);
  if (!known) return UnknownEnum(field, value);
  target = *known;
  return absl::OkStatus();
}

absl::Status ReadBudget(const v1::Budget& budget, pipeline::FitOptions& options) {
  switch (budget.limit_case()) {
    case v1::Budget::kMaxPrimitives:
      options.max_primitives = budget.max_primitives();
      break;
    case v1::Budget::kMaxPolygonError:
      options.polygon_error = budget.max_polygon_error();
      break;
    case v1::Budget::kSpheresAndCapsules: {
      const v1::SphereAndCapsuleLimit& limit = budget.spheres_and_capsules();
      if (!limit.has_max_spheres() && !limit.has_max_capsules()) {
        return InvalidField(ErrorReason::kMissing, "options.budget.spheres_and_capsules",
                            "is empty, must name max_spheres, max_capsules or both");
      }
      if (limit.has_max_spheres()) options.max_spheres = limit.max_spheres();
      if (limit.has_max_capsules()) options.max_capsules = limit.max_capsules();
      break;
    }
    case v1::Budget::LIMIT_NOT_SET:
      break;
  }
  return absl::OkStatus();
}

// The switch of a group; nothing for a number that is not a group.
bool* SwitchOf(v1::BodyPartGroup group, body::PartSelection& parts) {
  switch (group) {
    case v1::BODY_PART_GROUP_TORSO:
      return &parts.torso;
    case v1::BODY_PART_GROUP_ARMS:
      return &parts.arms;
    case v1::BODY_PART_GROUP_LEGS:
      return &parts.legs;
    case v1::BODY_PART_GROUP_HEAD:
      return &parts.head;
    case v1::BODY_PART_GROUP_HANDS:
      return &parts.hands;
    case v1::BODY_PART_GROUP_FEET:
      return &parts.feet;
    default:
      return nullptr;
  }
}

// An empty list leaves `parts` as it is.
absl::Status ReadParts(const google::protobuf::RepeatedField<int>& groups, const char* list,
                       body::PartSelection& parts) {
  if (groups.empty()) return absl::OkStatus();
  parts = {.torso = false, .arms = false, .legs = false};
  for (int i = 0; i < groups.size(); ++i) {
    const std::string field = absl::StrCat("options.", list, "[", i, "]");
    const auto group = static_cast<v1::BodyPartGroup>(groups.Get(i));
    bool* const part = SwitchOf(group, parts);
    if (part == nullptr) return UnknownEnum(field, group);
    if (*part) {
      return InvalidField(ErrorReason::kDuplicate, field,
                          absl::StrCat("is ", v1::BodyPartGroup_Name(group), " a second time"),
                          {{"value", v1::BodyPartGroup_Name(group)}});
    }
    *part = true;
  }
  return absl::OkStatus();
}

void WriteParts(const body::PartSelection& parts, google::protobuf::RepeatedField<int>& groups) {
  if (parts.torso) groups.Add(v1::BODY_PART_GROUP_TORSO);
  if (parts.arms) groups.Add(v1::BODY_PART_GROUP_ARMS);
  if (parts.legs) groups.Add(v1::BODY_PART_GROUP_LEGS);
  if (parts.head) groups.Add(v1::BODY_PART_GROUP_HEAD);
  if (parts.hands) groups.Add(v1::BODY_PART_GROUP_HANDS);
  if (parts.feet) groups.Add(v1::BODY_PART_GROUP_FEET);
}

absl::Status ReadLandmark(const v1::Landmark& wire, const std::string& field,
                          pipeline::FitOptions& options) {
  const std::optional<body::LandmarkId> id = body::LandmarkFromName(wire.name());
  if (!id) {
    const std::string name = wire.name().substr(0, 40);
    const std::string known = body::LandmarkNames();
    return InvalidField(
        ErrorReason::kUnknownValue, field + ".name",
        absl::StrCat("is \"", name, "\", which is no landmark's name, must be one of ", known),
        {{"value", name}, {"limit", known}});
  }
  if (!wire.has_position()) {
    return InvalidField(ErrorReason::kMissing, field + ".position", "is missing");
  }
  const Eigen::Vector3d position(wire.position().x(), wire.position().y(), wire.position().z());
  if (!position.allFinite()) {
    const std::string text =
        absl::StrCat("(", position.x(), ", ", position.y(), ", ", position.z(), ")");
    return InvalidField(ErrorReason::kNotFinite, field + ".position",
                        absl::StrCat("is ", text, ", must be finite"),
                        {{"value", text}, {"limit", "finite"}});
  }
  if (!options.landmarks.emplace(*id, position).second) {
    return InvalidField(ErrorReason::kDuplicate, field + ".name",
                        absl::StrCat("is \"", wire.name(), "\" a second time"),
                        {{"value", wire.name()}});
  }
  return absl::OkStatus();
}

void WriteBudget(const pipeline::FitOptions& options, v1::FitOptions& wire) {
  if (options.max_primitives) wire.mutable_budget()->set_max_primitives(*options.max_primitives);
  if (options.polygon_error) wire.mutable_budget()->set_max_polygon_error(*options.polygon_error);
  if (!options.max_spheres && !options.max_capsules) return;
  v1::SphereAndCapsuleLimit& limit = *wire.mutable_budget()->mutable_spheres_and_capsules();
  if (options.max_spheres) limit.set_max_spheres(*options.max_spheres);
  if (options.max_capsules) limit.set_max_capsules(*options.max_capsules);
}

// Of v1::FitOptions and v1::EffectiveOptions, whose fields have the same names.
template <typename Options>
character::CharacterOptions CharacterFromWire(const Options& wire) {
  character::CharacterOptions options;
  options.include.assign(wire.include_parts().begin(), wire.include_parts().end());
  options.exclude.assign(wire.exclude_parts().begin(), wire.exclude_parts().end());
  options.hair = wire.include_hair();
  options.skirt = wire.include_skirt();
  return options;
}

template <typename Options>
void CharacterToWire(const character::CharacterOptions& options, Options& wire) {
  for (const std::string& name : options.include) wire.add_include_parts(name);
  for (const std::string& name : options.exclude) wire.add_exclude_parts(name);
  wire.set_include_hair(options.hair);
  wire.set_include_skirt(options.skirt);
}

}  // namespace

absl::StatusOr<pipeline::FitOptions> OptionsFromWire(const v1::ApproximateBodyHeader& header) {
  const v1::FitOptions& wire = header.options();
  pipeline::FitOptions options;
  CAPFIT_RETURN_IF_ERROR(Read("mesh.unit", header.mesh().unit(), options.unit));
  CAPFIT_RETURN_IF_ERROR(Read("mesh.up_axis", header.mesh().up_axis(), options.up));
  CAPFIT_RETURN_IF_ERROR(ReadBudget(wire.budget(), options));
  CAPFIT_RETURN_IF_ERROR(Read("options.fit_mode", wire.fit_mode(), options.fit));
  CAPFIT_RETURN_IF_ERROR(Read("options.quality", wire.quality(), options.quality));
  CAPFIT_RETURN_IF_ERROR(ReadParts(wire.parts(), "parts", options.parts));
  CAPFIT_RETURN_IF_ERROR(Read("options.sex", wire.sex(), options.sex));
  CAPFIT_RETURN_IF_ERROR(Read("options.skinning", wire.skinning(), options.skinning));
  for (int i = 0; i < wire.landmarks_size(); ++i) {
    CAPFIT_RETURN_IF_ERROR(
        ReadLandmark(wire.landmarks(i), absl::StrCat("options.landmarks[", i, "]"), options));
  }
  options.seed = wire.seed();
  options.want_polygons = wire.want_feature_polygons();
  CAPFIT_RETURN_IF_ERROR(ReadParts(wire.require_parts(), "require_parts", options.require_parts));
  options.want_vertex_gaps = wire.want_vertex_gaps();
  options.tolerance_m = wire.tolerance_m();
  options.engine = wire.engine();
  options.character = CharacterFromWire(wire);
  options.exports = ExportsFromWire(header.exports());
  if (!header.has_layout()) return options;
  CAPFIT_ASSIGN_OR_RETURN(options.layout, LayoutFromWire(header.layout()));
  if (wire.parts().empty()) options.parts = options.layout->parts();
  return options;
}

void OptionsToWire(const pipeline::FitOptions& options, v1::ApproximateBodyHeader& header) {
  header.mutable_mesh()->set_unit(ToWire(options.unit));
  header.mutable_mesh()->set_up_axis(ToWire(options.up));
  v1::FitOptions& wire = *header.mutable_options();
  WriteBudget(options, wire);
  wire.set_fit_mode(ToWire(options.fit));
  wire.set_quality(ToWire(options.quality));
  WriteParts(options.parts, *wire.mutable_parts());
  wire.set_sex(ToWire(options.sex));
  wire.set_skinning(ToWire(options.skinning));
  for (const auto& [id, position] : options.landmarks) {
    v1::Landmark& landmark = *wire.add_landmarks();
    landmark.set_name(std::string(body::LandmarkName(id)));
    landmark.mutable_position()->set_x(position.x());
    landmark.mutable_position()->set_y(position.y());
    landmark.mutable_position()->set_z(position.z());
  }
  wire.set_seed(options.seed);
  wire.set_want_feature_polygons(options.want_polygons);
  WriteParts(options.require_parts, *wire.mutable_require_parts());
  wire.set_want_vertex_gaps(options.want_vertex_gaps);
  wire.set_tolerance_m(options.tolerance_m);
  wire.set_engine(options.engine);
  CharacterToWire(options.character, wire);
  if (options.layout) *header.mutable_layout() = LayoutToWire(*options.layout);
  ExportsToWire(options.exports, *header.mutable_exports());
}

absl::Status WithWirePaths(const absl::Status& status, const v1::FitOptions& options) {
  constexpr char kLandmarks[] = "options.landmarks.";
  const std::string field = FieldOf(status).value_or("");
  if (field.rfind(kLandmarks, 0) != 0) return WithLayoutPaths(status);
  const std::string name = field.substr(sizeof(kLandmarks) - 1);
  for (int i = 0; i < options.landmarks_size(); ++i) {
    if (options.landmarks(i).name() != name) continue;
    return WithField(status, absl::StrCat("options.landmarks[", i, "].position"));
  }
  return status;
}

v1::EffectiveOptions EffectiveOptionsToWire(const pipeline::FitOptions& options) {
  v1::EffectiveOptions wire;
  v1::EffectiveBudget& budget = *wire.mutable_budget();
  if (options.max_primitives) budget.set_max_primitives(*options.max_primitives);
  if (options.max_spheres) budget.set_max_spheres(*options.max_spheres);
  if (options.max_capsules) budget.set_max_capsules(*options.max_capsules);
  if (options.polygon_error) budget.set_max_polygon_error(*options.polygon_error);
  wire.set_fit_mode(ToWire(options.fit));
  wire.set_quality(ToWire(options.quality));
  WriteParts(options.parts, *wire.mutable_parts());
  WriteParts(options.require_parts, *wire.mutable_require_parts());
  wire.set_sex(ToWire(options.sex));
  wire.set_skinning(ToWire(options.skinning));
  wire.set_seed(options.seed);
  wire.set_tolerance_m(options.tolerance_m);
  wire.set_engine(options.engine);
  wire.set_capsule_profile(ToWire(pipeline::ProfileOf(options)));
  if (const pipeline::Engine* const engine = pipeline::FindEngine(options.engine)) {
    if (engine->max_shapes > 0) budget.set_max_shapes(engine->max_shapes);
  }
  wire.set_unit(ToWire(options.unit));
  wire.set_up_axis(ToWire(options.up));
  wire.set_caller_landmark_count(static_cast<int>(options.landmarks.size()));
  wire.set_want_feature_polygons(options.want_polygons);
  wire.set_want_vertex_gaps(options.want_vertex_gaps);
  CharacterToWire(options.character, wire);
  if (options.layout)
    wire.set_layout(options.layout->name.empty() ? kOwnLayout : options.layout->name);
  return wire;
}

absl::StatusOr<pipeline::FitOptions> EffectiveOptionsFromWire(const v1::EffectiveOptions& wire) {
  pipeline::FitOptions options;
  if (wire.budget().has_max_primitives()) options.max_primitives = wire.budget().max_primitives();
  if (wire.budget().has_max_spheres()) options.max_spheres = wire.budget().max_spheres();
  if (wire.budget().has_max_capsules()) options.max_capsules = wire.budget().max_capsules();
  if (wire.budget().has_max_polygon_error()) {
    options.polygon_error = wire.budget().max_polygon_error();
  }
  CAPFIT_RETURN_IF_ERROR(Read("summary.options.fit_mode", wire.fit_mode(), options.fit));
  CAPFIT_RETURN_IF_ERROR(Read("summary.options.quality", wire.quality(), options.quality));
  CAPFIT_RETURN_IF_ERROR(ReadParts(wire.parts(), "parts", options.parts));
  CAPFIT_RETURN_IF_ERROR(ReadParts(wire.require_parts(), "require_parts", options.require_parts));
  CAPFIT_RETURN_IF_ERROR(Read("summary.options.sex", wire.sex(), options.sex));
  CAPFIT_RETURN_IF_ERROR(Read("summary.options.skinning", wire.skinning(), options.skinning));
  options.seed = wire.seed();
  options.tolerance_m = wire.tolerance_m();
  options.engine = wire.engine();
  CAPFIT_RETURN_IF_ERROR(Read("summary.options.unit", wire.unit(), options.unit));
  CAPFIT_RETURN_IF_ERROR(Read("summary.options.up_axis", wire.up_axis(), options.up));
  options.want_polygons = wire.want_feature_polygons();
  options.want_vertex_gaps = wire.want_vertex_gaps();
  options.character = CharacterFromWire(wire);
  if (!wire.layout().empty()) {
    options.layout.emplace();
    if (wire.layout() != kOwnLayout) options.layout->name = PlainText(wire.layout());
  }
  return options;
}

}  // namespace capfit::wire
