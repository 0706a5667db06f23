// The layout of a finished set, to be kept on other bodies: the same spheres by the same names and
// numbers, the same capsules, wherever the other body has what they stand for.
#ifndef CAPFIT_CORE_REFINE_LAYOUTS_KEPT_LAYOUT_H_
#define CAPFIT_CORE_REFINE_LAYOUTS_KEPT_LAYOUT_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/body/body.h"
#include "core/capsule/mirrored_set.h"
#include "core/capsule/primitive_set.h"
#include "core/refine/layouts/bones.h"

namespace capfit::refine {

// Where on a body a sphere is, and how large, in measures that hold for any body.
struct BodyPlace {
  BoneId bone = BoneId::kBelly;
  Side side = Side::kLeft;  // of trunk and head, which have none, always the left
  BonePlace place;
  double radius = 0.0;  // in bone radii; > 0
};

struct KeptSphere {
  std::string name;  // unique in the layout
  body::Part part = body::Part::kTorso;
  int mirror = -1;                 // as capsule::SphereOrigin::mirror
  std::optional<BodyPlace> place;  // nothing where the body that it was made on had no bone there
};

struct KeptLayout {
  std::string name;  // what it is called; may be empty
  std::vector<KeptSphere> spheres;
  std::vector<capsule::CapsuleEnds> capsules;

  [[nodiscard]] capsule::PrimitiveCount count() const {
    return {static_cast<int>(spheres.size()), static_cast<int>(capsules.size())};
  }
  // The groups of parts that it has spheres for.
  [[nodiscard]] body::PartSelection parts() const;
};

// "belly", "upper_arm", ...: one for each bone.
[[nodiscard]] std::string_view BoneName(BoneId bone);
[[nodiscard]] std::optional<BoneId> BoneByName(std::string_view name);

// The place of each sphere of `set` (body frame): on the nearest bone of its part, in the bones'
// own radii, else on the nearest of all. O(bones * spheres).
[[nodiscard]] std::vector<std::optional<BodyPlace>> PlacesOf(const Skeleton& skeleton,
                                                             const capsule::PrimitiveSet& set);

// INVALID_ARGUMENT naming the sphere or capsule ("layout.spheres[3].mirror is 40, must be below
// 32") where places are missing or not finite, names repeat, images do not agree with each other,
// or a capsule names a sphere that is not there or comes twice; and for less than one sphere, more
// than 500, or more than 1000 capsules.
[[nodiscard]] absl::Status CheckLayout(const KeptLayout& layout);

// The layout's graph on a body, spheres and capsules by the same numbers. It is symmetric where the
// body and the layout are: then the first of each pair is placed and the other is its image.
// FAILED_PRECONDITION (PART_MISSING) names the spheres whose bone the body does not have.
// The layout must pass CheckLayout.
[[nodiscard]] absl::StatusOr<capsule::MirroredSet> HangLayout(const KeptLayout& layout,
                                                              const body::Body& body);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_LAYOUTS_KEPT_LAYOUT_H_
