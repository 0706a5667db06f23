// The wire's enums and the core's, both ways.
//
// To the wire: never fails. From the wire: a number that this version does not know gives nothing,
// because proto3 enums are open; UNSPECIFIED gives the documented default where there is one.
#ifndef CAPFIT_PROTO_WIRE_ENUM_CONVERSION_H_
#define CAPFIT_PROTO_WIRE_ENUM_CONVERSION_H_

#include <google/protobuf/descriptor.h>
#include <google/protobuf/generated_enum_reflection.h>

#include <optional>
#include <string>

#include "absl/status/status.h"
#include "capfit/v1/mesh.pb.h"
#include "capfit/v1/options.pb.h"
#include "capfit/v1/result.pb.h"
#include "core/base/fit_observer.h"
#include "core/body/anatomy.h"
#include "core/body/find_body.h"
#include "core/capsule/capsule_profile.h"
#include "core/character/part_words.h"
#include "core/formats/read_mesh.h"
#include "core/pipeline/fit.h"
#include "core/refine/layouts/bones.h"
#include "core/section/feature_polygon.h"

namespace capfit::wire {

[[nodiscard]] v1::LengthUnit ToWire(body::Unit unit);
[[nodiscard]] v1::UpAxis ToWire(body::UpAxis up);
[[nodiscard]] v1::MeshFileFormat ToWire(formats::MeshFormat format);
[[nodiscard]] v1::LandmarkMethod ToWire(body::LandmarkMethod method);
[[nodiscard]] v1::BodyPart ToWire(body::Part part);
[[nodiscard]] v1::Bone ToWire(refine::BoneId bone);
[[nodiscard]] v1::Stage ToWire(Stage stage);
[[nodiscard]] v1::Sex ToWire(section::Sex sex);
[[nodiscard]] v1::FitMode ToWire(pipeline::FitMode mode);
[[nodiscard]] v1::Quality ToWire(pipeline::Quality quality);
[[nodiscard]] v1::SkinningForm ToWire(pipeline::SkinningMode mode);
[[nodiscard]] v1::MeshPartKind ToWire(character::PartKind kind);
[[nodiscard]] v1::CapsuleProfile ToWire(capsule::CapsuleProfile profile);

[[nodiscard]] std::optional<body::Unit> FromWire(v1::LengthUnit unit);
[[nodiscard]] std::optional<body::UpAxis> FromWire(v1::UpAxis up);
[[nodiscard]] std::optional<formats::MeshFormat> FromWire(v1::MeshFileFormat format);
[[nodiscard]] std::optional<body::LandmarkMethod> FromWire(v1::LandmarkMethod method);
[[nodiscard]] std::optional<body::Part> FromWire(v1::BodyPart part);
[[nodiscard]] std::optional<refine::BoneId> FromWire(v1::Bone bone);
[[nodiscard]] std::optional<Stage> FromWire(v1::Stage stage);
[[nodiscard]] std::optional<section::Sex> FromWire(v1::Sex sex);
[[nodiscard]] std::optional<pipeline::FitMode> FromWire(v1::FitMode mode);
[[nodiscard]] std::optional<pipeline::Quality> FromWire(v1::Quality quality);
[[nodiscard]] std::optional<character::PartKind> FromWire(v1::MeshPartKind kind);
// Nothing for the forms that the core does not have as well.
[[nodiscard]] std::optional<pipeline::SkinningMode> FromWire(v1::SkinningForm form);

// INVALID_ARGUMENT for a number that is no value of the enum, naming those that are.
[[nodiscard]] absl::Status UnknownEnum(const std::string& field, int value,
                                       const google::protobuf::EnumDescriptor& known);
template <typename Wire>
[[nodiscard]] absl::Status UnknownEnum(const std::string& field, Wire value) {
  return UnknownEnum(field, static_cast<int>(value), *google::protobuf::GetEnumDescriptor<Wire>());
}

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_ENUM_CONVERSION_H_
