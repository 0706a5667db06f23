#include "proto/wire/enum_conversion.h"

#include <array>
#include <cstddef>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::wire {
namespace {

template <typename Core, typename Wire, std::size_t n>
using Table = std::array<std::pair<Core, Wire>, n>;

// Each core value stands once; an UNSPECIFIED that means a default is a second row further down.
constexpr Table<body::Unit, v1::LengthUnit, 5> kUnits = {
    {{body::Unit::kAuto, v1::LENGTH_UNIT_UNSPECIFIED},
     {body::Unit::kMetre, v1::LENGTH_UNIT_METRE},
     {body::Unit::kCentimetre, v1::LENGTH_UNIT_CENTIMETRE},
     {body::Unit::kMillimetre, v1::LENGTH_UNIT_MILLIMETRE},
     {body::Unit::kInch, v1::LENGTH_UNIT_INCH}}};

constexpr Table<body::UpAxis, v1::UpAxis, 4> kUpAxes = {
    {{body::UpAxis::kAuto, v1::UP_AXIS_UNSPECIFIED},
     {body::UpAxis::kX, v1::UP_AXIS_X},
     {body::UpAxis::kY, v1::UP_AXIS_Y},
     {body::UpAxis::kZ, v1::UP_AXIS_Z}}};

constexpr Table<formats::MeshFormat, v1::MeshFileFormat, 6> kFormats = {
    {{formats::MeshFormat::kUnknown, v1::MESH_FILE_FORMAT_UNSPECIFIED},
     {formats::MeshFormat::kObj, v1::MESH_FILE_FORMAT_OBJ},
     {formats::MeshFormat::kPly, v1::MESH_FILE_FORMAT_PLY},
     {formats::MeshFormat::kStl, v1::MESH_FILE_FORMAT_STL},
     {formats::MeshFormat::kOff, v1::MESH_FILE_FORMAT_OFF},
     {formats::MeshFormat::kGlb, v1::MESH_FILE_FORMAT_GLB}}};

constexpr Table<body::LandmarkMethod, v1::LandmarkMethod, 4> kMethods = {
    {{body::LandmarkMethod::kMeasured, v1::LANDMARK_METHOD_MEASURED},
     {body::LandmarkMethod::kRatio, v1::LANDMARK_METHOD_RATIO},
     {body::LandmarkMethod::kCaller, v1::LANDMARK_METHOD_CALLER},
     {body::LandmarkMethod::kSkeleton, v1::LANDMARK_METHOD_SKELETON}}};

constexpr Table<body::Part, v1::BodyPart, 10> kParts = {
    {{body::Part::kTorso, v1::BODY_PART_TORSO},
     {body::Part::kLeftArm, v1::BODY_PART_LEFT_ARM},
     {body::Part::kRightArm, v1::BODY_PART_RIGHT_ARM},
     {body::Part::kLeftLeg, v1::BODY_PART_LEFT_LEG},
     {body::Part::kRightLeg, v1::BODY_PART_RIGHT_LEG},
     {body::Part::kHead, v1::BODY_PART_HEAD},
     {body::Part::kLeftHand, v1::BODY_PART_LEFT_HAND},
     {body::Part::kRightHand, v1::BODY_PART_RIGHT_HAND},
     {body::Part::kLeftFoot, v1::BODY_PART_LEFT_FOOT},
     {body::Part::kRightFoot, v1::BODY_PART_RIGHT_FOOT}}};

constexpr Table<refine::BoneId, v1::Bone, refine::kBoneCount> kBones = {
    {{refine::BoneId::kBelly, v1::BONE_BELLY},
     {refine::BoneId::kRibs, v1::BONE_RIBS},
     {refine::BoneId::kChest, v1::BONE_CHEST},
     {refine::BoneId::kHead, v1::BONE_HEAD},
     {refine::BoneId::kClavicle, v1::BONE_CLAVICLE},
     {refine::BoneId::kUpperArm, v1::BONE_UPPER_ARM},
     {refine::BoneId::kForearm, v1::BONE_FOREARM},
     {refine::BoneId::kHand, v1::BONE_HAND},
     {refine::BoneId::kPelvis, v1::BONE_PELVIS},
     {refine::BoneId::kThigh, v1::BONE_THIGH},
     {refine::BoneId::kShin, v1::BONE_SHIN},
     {refine::BoneId::kFoot, v1::BONE_FOOT},
     {refine::BoneId::kHeel, v1::BONE_HEEL}}};

constexpr Table<Stage, v1::Stage, 9> kStages = {{{Stage::kMesh, v1::STAGE_MESH},
                                                 {Stage::kBody, v1::STAGE_BODY},
                                                 {Stage::kSection, v1::STAGE_SECTION},
                                                 {Stage::kCircle, v1::STAGE_CIRCLE},
                                                 {Stage::kCapsule, v1::STAGE_CAPSULE},
                                                 {Stage::kCoverage, v1::STAGE_COVERAGE},
                                                 {Stage::kRefine, v1::STAGE_REFINE},
                                                 {Stage::kMetrics, v1::STAGE_METRICS},
                                                 {Stage::kSkinning, v1::STAGE_SKINNING}}};
static_assert(kStages.size() == kStageCount);

constexpr Table<character::PartKind, v1::MeshPartKind, 8> kMeshPartKinds = {
    {{character::PartKind::kBody, v1::MESH_PART_KIND_BODY},
     {character::PartKind::kClothing, v1::MESH_PART_KIND_CLOTHING},
     {character::PartKind::kShoe, v1::MESH_PART_KIND_SHOE},
     {character::PartKind::kSkirt, v1::MESH_PART_KIND_SKIRT},
     {character::PartKind::kHair, v1::MESH_PART_KIND_HAIR},
     {character::PartKind::kInner, v1::MESH_PART_KIND_INNER},
     {character::PartKind::kAccessory, v1::MESH_PART_KIND_ACCESSORY},
     {character::PartKind::kFragment, v1::MESH_PART_KIND_FRAGMENT}}};
constexpr Table<section::Sex, v1::Sex, 4> kSexes = {{{section::Sex::kAuto, v1::SEX_AUTO},
                                                     {section::Sex::kFemale, v1::SEX_FEMALE},
                                                     {section::Sex::kMale, v1::SEX_MALE},
                                                     {section::Sex::kAuto, v1::SEX_UNSPECIFIED}}};

constexpr Table<pipeline::FitMode, v1::FitMode, 3> kFitModes = {
    {{pipeline::FitMode::kEnclose, v1::FIT_MODE_ENCLOSE},
     {pipeline::FitMode::kBestFit, v1::FIT_MODE_BEST_FIT},
     {pipeline::FitMode::kEnclose, v1::FIT_MODE_UNSPECIFIED}}};

constexpr Table<pipeline::Quality, v1::Quality, 4> kQualities = {
    {{pipeline::Quality::kPaper, v1::QUALITY_PAPER},
     {pipeline::Quality::kBalanced, v1::QUALITY_BALANCED},
     {pipeline::Quality::kTight, v1::QUALITY_TIGHT},
     {pipeline::Quality::kPaper, v1::QUALITY_UNSPECIFIED}}};

constexpr Table<pipeline::SkinningMode, v1::SkinningForm, 5> kSkinningForms = {
    {{pipeline::SkinningMode::kNone, v1::SKINNING_FORM_NONE},
     {pipeline::SkinningMode::kDense, v1::SKINNING_FORM_DENSE},
     {pipeline::SkinningMode::kSparse, v1::SKINNING_FORM_SPARSE},
     {pipeline::SkinningMode::kBones, v1::SKINNING_FORM_BONES},
     {pipeline::SkinningMode::kNone, v1::SKINNING_FORM_UNSPECIFIED}}};

constexpr Table<capsule::CapsuleProfile, v1::CapsuleProfile, 3> kProfiles = {
    {{capsule::CapsuleProfile::kTangentHull, v1::CAPSULE_PROFILE_TANGENT_HULL},
     {capsule::CapsuleProfile::kLerpedRadius, v1::CAPSULE_PROFILE_LERPED_RADIUS},
     {capsule::CapsuleProfile::kUniformRadius, v1::CAPSULE_PROFILE_UNIFORM_RADIUS}}};

template <typename Core, typename Wire, std::size_t n>
Wire WireOf(const Table<Core, Wire, n>& table, Core value) {
  for (const auto& [core, wire] : table) {
    if (core == value) return wire;
  }
  return Wire{};
}

template <typename Core, typename Wire, std::size_t n>
std::optional<Core> CoreOf(const Table<Core, Wire, n>& table, Wire value) {
  for (const auto& [core, wire] : table) {
    if (wire == value) return core;
  }
  return std::nullopt;
}

}  // namespace

v1::LengthUnit ToWire(body::Unit unit) { return WireOf(kUnits, unit); }
v1::UpAxis ToWire(body::UpAxis up) { return WireOf(kUpAxes, up); }
v1::MeshFileFormat ToWire(formats::MeshFormat format) { return WireOf(kFormats, format); }
v1::LandmarkMethod ToWire(body::LandmarkMethod method) { return WireOf(kMethods, method); }
v1::BodyPart ToWire(body::Part part) { return WireOf(kParts, part); }
v1::Bone ToWire(refine::BoneId bone) { return WireOf(kBones, bone); }
v1::Stage ToWire(Stage stage) { return WireOf(kStages, stage); }
v1::MeshPartKind ToWire(character::PartKind kind) { return WireOf(kMeshPartKinds, kind); }
v1::Sex ToWire(section::Sex sex) { return WireOf(kSexes, sex); }
v1::FitMode ToWire(pipeline::FitMode mode) { return WireOf(kFitModes, mode); }
v1::Quality ToWire(pipeline::Quality quality) { return WireOf(kQualities, quality); }
v1::SkinningForm ToWire(pipeline::SkinningMode mode) { return WireOf(kSkinningForms, mode); }
v1::CapsuleProfile ToWire(capsule::CapsuleProfile profile) { return WireOf(kProfiles, profile); }

std::optional<body::Unit> FromWire(v1::LengthUnit unit) { return CoreOf(kUnits, unit); }
std::optional<body::UpAxis> FromWire(v1::UpAxis up) { return CoreOf(kUpAxes, up); }
std::optional<formats::MeshFormat> FromWire(v1::MeshFileFormat format) {
  return CoreOf(kFormats, format);
}
std::optional<body::LandmarkMethod> FromWire(v1::LandmarkMethod method) {
  return CoreOf(kMethods, method);
}
std::optional<body::Part> FromWire(v1::BodyPart part) { return CoreOf(kParts, part); }
std::optional<refine::BoneId> FromWire(v1::Bone bone) { return CoreOf(kBones, bone); }
std::optional<Stage> FromWire(v1::Stage stage) { return CoreOf(kStages, stage); }
std::optional<character::PartKind> FromWire(v1::MeshPartKind kind) {
  return CoreOf(kMeshPartKinds, kind);
}
std::optional<section::Sex> FromWire(v1::Sex sex) { return CoreOf(kSexes, sex); }
std::optional<pipeline::FitMode> FromWire(v1::FitMode mode) { return CoreOf(kFitModes, mode); }
std::optional<pipeline::Quality> FromWire(v1::Quality quality) {
  return CoreOf(kQualities, quality);
}
std::optional<pipeline::SkinningMode> FromWire(v1::SkinningForm form) {
  return CoreOf(kSkinningForms, form);
}

absl::Status UnknownEnum(const std::string& field, int value,
                         const google::protobuf::EnumDescriptor& known) {
  std::string names;
  for (int i = 1; i < known.value_count(); ++i) {
    absl::StrAppend(&names, i == 1 ? "" : ", ", known.value(i)->name(), " (",
                    known.value(i)->number(), ")");
  }
  return InvalidField(ErrorReason::kUnknownValue, field,
                      absl::StrCat("is ", value, ", must be one of ", names),
                      {{"value", absl::StrCat(value)}, {"limit", names}});
}

}  // namespace capfit::wire
