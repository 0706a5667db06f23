#include "core/refine/layouts/kept_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/enum_index.h"
#include "core/base/status.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr std::array<std::string_view, kBoneCount> kBoneNames = {
    "belly", "ribs",   "chest", "head", "clavicle", "upper_arm", "forearm",
    "hand",  "pelvis", "thigh", "shin", "foot",     "heel"};
constexpr std::size_t kMostSpheres = 500;
constexpr std::size_t kMostCapsules = 1000;
// Places are a few bones long at most; beyond that a sphere has nothing to do with its bone.
constexpr double kFurthestPlace = 100.0;
constexpr std::size_t kMostNamed = 5;  // spheres in an error

bool IsMidBone(BoneId bone) { return static_cast<int>(bone) < kMidBoneCount; }

struct BoneOnSide {
  BoneId id;
  Side side;
};

// All bones, those of the middle once.
std::vector<BoneOnSide> AllBones() {
  std::vector<BoneOnSide> bones;
  for (int b = 0; b < kBoneCount; ++b) {
    bones.push_back({static_cast<BoneId>(b), Side::kLeft});
    if (b >= kMidBoneCount) bones.push_back({static_cast<BoneId>(b), Side::kRight});
  }
  return bones;
}

std::optional<BoneOnSide> NearestBone(const Skeleton& skeleton, const Vec3& point_m,
                                      const std::optional<body::Part>& part) {
  std::optional<BoneOnSide> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const BoneOnSide& bone : AllBones()) {
    if (part && PartOf(bone.id, bone.side) != *part) continue;
    const double distance = skeleton.DistanceInRadii(bone.id, bone.side, point_m);
    if (distance < least) least = distance, nearest = bone;
  }
  return nearest;
}

std::string FieldOfSphere(std::size_t sphere, const char* member) {
  return absl::StrCat("layout.spheres[", sphere, "].", member);
}

absl::Status CheckPlace(const KeptSphere& sphere, std::size_t index) {
  if (!sphere.place) {
    return InvalidField(ErrorReason::kMissing, FieldOfSphere(index, "place"),
                        "is missing; take a layout from a body on which all landmarks are found");
  }
  const BodyPlace& at = *sphere.place;
  const Vec3 place(at.place.along, at.place.aside, at.place.ahead);
  if (!place.allFinite() || place.cwiseAbs().maxCoeff() > kFurthestPlace) {
    return InvalidField(ErrorReason::kOutOfRange, FieldOfSphere(index, "place"),
                        absl::StrCat("is further than ", kFurthestPlace, " from its bone"));
  }
  if (at.radius > 0.0 && at.radius <= kFurthestPlace) return absl::OkStatus();
  return InvalidField(ErrorReason::kOutOfRange, FieldOfSphere(index, "place.radius"),
                      absl::StrCat("is ", at.radius, ", must be in (0, ", kFurthestPlace, "]"));
}

absl::Status CheckMirror(const KeptLayout& layout, std::size_t index) {
  const int mirror = layout.spheres[index].mirror;
  if (mirror == -1) return absl::OkStatus();
  const std::string field = FieldOfSphere(index, "mirror");
  if (mirror < 0 || std::cmp_greater_equal(mirror, layout.spheres.size())) {
    return IndexOutOfRange(field, mirror, layout.spheres.size());
  }
  const int back = layout.spheres[mirror].mirror;
  if (back == static_cast<int>(index)) return absl::OkStatus();
  return InvalidField(ErrorReason::kConflict, field,
                      absl::StrCat("is ", mirror, ", whose own mirror is ", back));
}

absl::Status CheckSpheres(const KeptLayout& layout) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < layout.spheres.size(); ++i) {
    CAPFIT_RETURN_IF_ERROR(CheckPlace(layout.spheres[i], i));
    CAPFIT_RETURN_IF_ERROR(CheckMirror(layout, i));
    const std::string& name = layout.spheres[i].name;
    if (name.empty()) {
      return InvalidField(ErrorReason::kMissing, FieldOfSphere(i, "name"), "is empty");
    }
    if (!names.insert(name).second) {
      return InvalidField(ErrorReason::kDuplicate, FieldOfSphere(i, "name"),
                          absl::StrCat("is \"", name, "\" for the second time"));
    }
  }
  return absl::OkStatus();
}

absl::Status CheckCapsules(const KeptLayout& layout) {
  std::set<capsule::CapsuleEnds> known;
  for (std::size_t i = 0; i < layout.capsules.size(); ++i) {
    const std::string field = absl::StrCat("layout.capsules[", i, "]");
    const capsule::CapsuleEnds& ends = layout.capsules[i];
    for (const int end : ends) {
      if (end < 0 || std::cmp_greater_equal(end, layout.spheres.size())) {
        const std::size_t count = layout.spheres.size();
        return InvalidField(
            ErrorReason::kOutOfRange, field,
            absl::StrCat("joins spheres ", ends[0], " and ", ends[1], ", both must be below ",
                         count),
            {{"value", absl::StrCat(end)}, {"limit", absl::StrCat("[0, ", count, ")")}});
      }
    }
    if (ends[0] >= ends[1]) {
      return InvalidField(
          ErrorReason::kOutOfRange, field,
          absl::StrCat("joins ", ends[0], " and ", ends[1], ", the first must be the lower"));
    }
    if (!known.insert(ends).second) {
      return InvalidField(ErrorReason::kDuplicate, field, "joins two spheres that are joined");
    }
  }
  return absl::OkStatus();
}

absl::Status MissingBones(const std::vector<std::string>& spheres) {
  std::string names;
  for (std::size_t i = 0; i < std::min(kMostNamed, spheres.size()); ++i) {
    absl::StrAppend(&names, i == 0 ? "" : ", ", spheres[i]);
  }
  if (spheres.size() > kMostNamed) {
    absl::StrAppend(&names, " and ", spheres.size() - kMostNamed, " more");
  }
  return Refused(ErrorReason::kPartMissing,
                 absl::StrCat("the layout has spheres where nothing was found on this body: ",
                              names, "; take a layout without them"));
}

}  // namespace

body::PartSelection KeptLayout::parts() const {
  body::PartSelection parts{false, false, false, false, false, false};
  for (const KeptSphere& sphere : spheres) {
    switch (sphere.part) {
      case body::Part::kTorso:
        parts.torso = true;
        break;
      case body::Part::kLeftArm:
      case body::Part::kRightArm:
        parts.arms = true;
        break;
      case body::Part::kLeftLeg:
      case body::Part::kRightLeg:
        parts.legs = true;
        break;
      case body::Part::kHead:
        parts.head = true;
        break;
      case body::Part::kLeftHand:
      case body::Part::kRightHand:
        parts.hands = true;
        break;
      case body::Part::kLeftFoot:
      case body::Part::kRightFoot:
        parts.feet = true;
        break;
    }
  }
  return parts;
}

std::string_view BoneName(BoneId bone) { return kBoneNames[Index(bone)]; }

std::optional<BoneId> BoneByName(std::string_view name) {
  const auto found = std::find(kBoneNames.begin(), kBoneNames.end(), name);
  if (found == kBoneNames.end()) return std::nullopt;
  return static_cast<BoneId>(found - kBoneNames.begin());
}

std::vector<std::optional<BodyPlace>> PlacesOf(const Skeleton& skeleton,
                                               const capsule::PrimitiveSet& set) {
  std::vector<std::optional<BodyPlace>> places(set.spheres.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const geometry::Sphere& sphere = set.spheres[i];
    std::optional<BoneOnSide> bone = NearestBone(skeleton, sphere.center_m, set.origins[i].part);
    if (!bone) bone = NearestBone(skeleton, sphere.center_m, std::nullopt);
    if (!bone) continue;
    places[i] = {bone->id, bone->side, *skeleton.PlaceOf(bone->id, bone->side, sphere.center_m),
                 sphere.radius_m / skeleton.bone(bone->id, bone->side)->radius_m};
  }
  return places;
}

absl::Status CheckLayout(const KeptLayout& layout) {
  if (layout.spheres.empty()) {
    return InvalidField(ErrorReason::kMissing, "layout.spheres", "is empty");
  }
  if (layout.spheres.size() > kMostSpheres) {
    return TooLarge("layout.spheres", layout.spheres.size(), "spheres", kMostSpheres);
  }
  if (layout.capsules.size() > kMostCapsules) {
    return TooLarge("layout.capsules", layout.capsules.size(), "capsules", kMostCapsules);
  }
  CAPFIT_RETURN_IF_ERROR(CheckSpheres(layout));
  return CheckCapsules(layout);
}

absl::StatusOr<capsule::MirroredSet> HangLayout(const KeptLayout& layout, const body::Body& body) {
  const Skeleton skeleton(body);
  capsule::PrimitiveSet set;
  set.capsules = layout.capsules;
  std::vector<std::string> missing;
  for (const KeptSphere& sphere : layout.spheres) {
    const BodyPlace& at = *sphere.place;
    const Side side = IsMidBone(at.bone) ? Side::kLeft : at.side;
    set.origins.push_back({sphere.part, -1, sphere.mirror});
    set.spheres.emplace_back();
    const std::optional<Vec3> center = skeleton.Position(at.bone, side, at.place);
    if (!center) {
      missing.push_back(sphere.name);
      continue;
    }
    const double radius = at.radius * skeleton.bone(at.bone, side)->radius_m;
    set.spheres.back() = {*center, std::max(kLeastHungRadiusM, radius)};
  }
  if (!missing.empty()) return MissingBones(missing);
  const bool is_mirrored = body.is_symmetric && capsule::ImagesOf(set).is_whole;
  if (!is_mirrored) {
    for (capsule::SphereOrigin& origin : set.origins) origin.mirror = -1;
  }
  return capsule::MirroredSet(std::move(set), is_mirrored);
}

}  // namespace capfit::refine
