#include "proto/wire/layout_conversion.h"

#include <optional>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/refine/layouts/standard_layouts.h"
#include "proto/wire/enum_conversion.h"

namespace capfit::wire {
namespace {

absl::Status UnknownLayout(const std::string& name) {
  return InvalidField(ErrorReason::kUnknownValue, "layout.name",
                      absl::StrCat("is \"", name.substr(0, 40), "\", must be one of ",
                                   refine::StandardLayoutNames()),
                      {{"value", name.substr(0, 40)}, {"limit", refine::StandardLayoutNames()}});
}

absl::StatusOr<refine::KeptSphere> SphereFromWire(const v1::Sphere& wire,
                                                  const std::string& field) {
  refine::KeptSphere sphere;
  sphere.name = wire.name();
  const std::optional<body::Part> part = FromWire(wire.part());
  if (!part) return UnknownEnum(absl::StrCat(field, ".part"), wire.part());
  sphere.part = *part;
  sphere.mirror = wire.has_mirror() ? wire.mirror() : -1;
  if (!wire.has_place()) return sphere;
  CAPFIT_ASSIGN_OR_RETURN(sphere.place, PlaceFromWire(wire.place(), absl::StrCat(field, ".place")));
  return sphere;
}

absl::StatusOr<refine::KeptLayout> SetFromWire(const v1::PrimitiveSet& wire) {
  refine::KeptLayout layout;
  for (int i = 0; i < wire.spheres_size(); ++i) {
    CAPFIT_ASSIGN_OR_RETURN(
        refine::KeptSphere sphere,
        SphereFromWire(wire.spheres(i), absl::StrCat("layout.set.spheres[", i, "]")));
    layout.spheres.push_back(std::move(sphere));
  }
  for (const v1::Capsule& capsule : wire.capsules()) {
    layout.capsules.push_back({capsule.first_sphere(), capsule.second_sphere()});
  }
  return layout;
}

}  // namespace

v1::BodyPlace PlaceToWire(const refine::BodyPlace& place) {
  v1::BodyPlace wire;
  wire.set_bone(ToWire(place.bone));
  wire.set_is_right(place.side == refine::Side::kRight);
  wire.set_along(place.place.along);
  wire.set_aside(place.place.aside);
  wire.set_ahead(place.place.ahead);
  wire.set_radius(place.radius);
  return wire;
}

absl::StatusOr<refine::BodyPlace> PlaceFromWire(const v1::BodyPlace& wire,
                                                const std::string& field) {
  const std::optional<refine::BoneId> bone = FromWire(wire.bone());
  if (!bone) return UnknownEnum(absl::StrCat(field, ".bone"), wire.bone());
  return refine::BodyPlace{*bone,
                           wire.is_right() ? refine::Side::kRight : refine::Side::kLeft,
                           {wire.along(), wire.aside(), wire.ahead()},
                           wire.radius()};
}

absl::StatusOr<refine::KeptLayout> LayoutFromWire(const v1::Layout& wire) {
  switch (wire.source_case()) {
    case v1::Layout::kName:
      if (const refine::KeptLayout* const known = refine::FindStandardLayout(wire.name())) {
        return *known;
      }
      return UnknownLayout(wire.name());
    case v1::Layout::kSet:
      return SetFromWire(wire.set());
    case v1::Layout::SOURCE_NOT_SET:
      break;
  }
  return InvalidField(ErrorReason::kMissing, "layout", "has neither a name nor a set");
}

v1::Layout LayoutToWire(const refine::KeptLayout& layout) {
  v1::Layout wire;
  if (!layout.name.empty() && refine::FindStandardLayout(layout.name) != nullptr) {
    wire.set_name(layout.name);
    return wire;
  }
  v1::PrimitiveSet& set = *wire.mutable_set();
  for (const refine::KeptSphere& known : layout.spheres) {
    v1::Sphere& sphere = *set.add_spheres();
    sphere.set_name(known.name);
    sphere.set_part(ToWire(known.part));
    if (known.mirror >= 0) sphere.set_mirror(known.mirror);
    if (known.place) *sphere.mutable_place() = PlaceToWire(*known.place);
  }
  for (const capsule::CapsuleEnds& ends : layout.capsules) {
    v1::Capsule& capsule = *set.add_capsules();
    capsule.set_first_sphere(ends[0]);
    capsule.set_second_sphere(ends[1]);
  }
  return wire;
}

absl::Status WithLayoutPaths(const absl::Status& status) {
  constexpr char kLayout[] = "layout.";
  const std::string field = FieldOf(status).value_or("");
  if (field.rfind(kLayout, 0) != 0 || field.rfind("layout.set.", 0) == 0 ||
      field == "layout.name") {
    return status;
  }
  return WithField(status, absl::StrCat("layout.set.", field.substr(sizeof(kLayout) - 1)));
}

}  // namespace capfit::wire
