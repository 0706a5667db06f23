// The result's shape: spheres, and the tapered capsules between pairs of them (paper, III-C).
#ifndef CAPFIT_CORE_CAPSULE_PRIMITIVE_SET_H_
#define CAPFIT_CORE_CAPSULE_PRIMITIVE_SET_H_

#include <array>
#include <cstddef>
#include <vector>

#include "core/body/anatomy.h"
#include "core/capsule/budget.h"
#include "core/geometry/sphere.h"
#include "core/geometry/tapered_capsule.h"

namespace capfit::capsule {

// Where a sphere comes from.
struct SphereOrigin {
  body::Part part = body::Part::kTorso;
  int polygon = -1;  // index of the feature polygon; -1 for balls and added spheres
  int mirror = -1;   // index of the mirrored sphere; its own index on the mid-plane; -1: none
};

// Two indices into the spheres, first < second.
using CapsuleEnds = std::array<int, 2>;

struct PrimitiveSet {
  std::vector<geometry::Sphere> spheres;  // body frame
  std::vector<SphereOrigin> origins;      // same size as spheres
  std::vector<CapsuleEnds> capsules;      // distinct

  [[nodiscard]] PrimitiveCount count() const {
    return {static_cast<int>(spheres.size()), static_cast<int>(capsules.size())};
  }
  [[nodiscard]] int primitive_count() const { return count().total(); }  // n_p
  [[nodiscard]] geometry::TaperedCapsule Capsule(std::size_t index) const {
    return {spheres[capsules[index][0]], spheres[capsules[index][1]]};
  }
};

// Which sphere and which capsule is whose image in the mid-plane.
struct Images {
  std::vector<int> spheres;   // its own index on the mid-plane; -1 where the two do not agree
  std::vector<int> capsules;  // -1 where an end has no image or the images are not joined
  bool is_whole = false;      // every sphere and capsule has one
};

// From the spheres' own word (SphereOrigin::mirror); places are not looked at. O(n log n).
[[nodiscard]] Images ImagesOf(const PrimitiveSet& set);

// The part that a capsule counts to: that of its ends; between two parts the later in body::Part,
// which is the one further out.
[[nodiscard]] body::Part PartOfCapsule(const PrimitiveSet& set, std::size_t index);

// Whether a capsule uses it, for each sphere.
[[nodiscard]] std::vector<bool> UsedSpheres(const PrimitiveSet& set);

// What the set consists of as a solid, by end spheres: every capsule, in order, and every sphere
// that no capsule uses, with both ends the same.
[[nodiscard]] std::vector<CapsuleEnds> SolidEnds(const PrimitiveSet& set);

// The same, ready to be asked.
[[nodiscard]] std::vector<geometry::TaperedCapsule> Solids(const PrimitiveSet& set);

}  // namespace capfit::capsule

#endif  // CAPFIT_CORE_CAPSULE_PRIMITIVE_SET_H_
