// From circles to spheres and tapered capsules (paper, III-C).
#ifndef CAPFIT_CORE_CAPSULE_BUILD_PRIMITIVES_H_
#define CAPFIT_CORE_CAPSULE_BUILD_PRIMITIVES_H_

#include <span>

#include "core/body/body.h"
#include "core/capsule/primitive_set.h"
#include "core/circle/approximate_polygon.h"
#include "core/section/feature_polygon.h"

namespace capfit::capsule {

// One sphere for each circle; a capsule for each pair of circles of neighbouring polygons of a
// chain; where `link_limbs`, one capsule from each limb's first polygon to the sphere of the torso
// that leaves the least gap (closes shoulder and hip; not in the paper).
//
// A polygon's mirror image gets exact images of its spheres; on a trunk polygon that mirrors itself
// circles that match as images are made exact, and centred ones get x = 0. SphereOrigin::mirror
// tells which. Spheres come by polygon, then by circle.
[[nodiscard]] PrimitiveSet BuildPrimitives(
    std::span<const section::FeaturePolygon> polygons,
    std::span<const circle::PolygonApproximation> approximations, bool link_limbs);

// How many balls each of them gets.
struct EndBalls {
  int head = 1;
  int hand = 1;
  int foot = 1;

  [[nodiscard]] int Of(body::Part part) const;  // 0 for chains
};

// A set of the smallest enclosing ball of each selected head, hand and foot that the body has,
// around the vertices of that segment; where more than one is asked for (not in the paper), of
// compact clusters of them (point_clusters.h): a palm and fingers, not slices of a hand. On a
// symmetric body hands and feet are exact images of each other, each around both sides' vertices,
// and the head's balls are centred. O(vertices * balls).
[[nodiscard]] PrimitiveSet MakeEndBalls(const body::Body& body, const body::PartSelection& parts,
                                        const EndBalls& balls);

// Adds spheres, behind those of the set.
void AddBalls(const PrimitiveSet& balls, PrimitiveSet& set);

// One of `from` and one of `to`, indices of spheres: the first pair with the least gap between
// their surfaces, which is negative where they overlap. {-1, -1} where there are none.
[[nodiscard]] CapsuleEnds LeastGap(std::span<const geometry::Sphere> spheres,
                                   std::span<const int> from, std::span<const int> to);

// The chain that a head (torso), a hand (arm) or a foot (leg) hangs on.
[[nodiscard]] body::Part ChainAt(body::Part ball);

// A capsule from each head, hand and foot to the sphere of its chain that leaves the least gap to
// one of its balls, and to that one's image, and the tree of capsules with the least gaps between
// its balls (not in the paper): the balls need not reach round the whole part then. For sets whose
// spheres are moved and sized together; where they only grow it would enclose more for nothing.
void LinkEndBalls(PrimitiveSet& set);

// Removes capsules that one other capsule covers, then those that the union of the others covers.
// Mirrored capsules go together; small ones are asked first. The union is certified by cutting the
// capsule's slanted surface into patches until a single one of the others, made larger by
// `tolerance_m`, contains each; its inside on cones of a tenth, two tenths ... of its radii.
// Capsules that one end sphere swallows go too: they are that sphere. Spheres stay, unless no
// capsule is left that uses them and another capsule contains them. O(capsules^2) and some hundred
// patches for each capsule that goes.
void RemoveCoveredCapsules(PrimitiveSet& set, double tolerance_m = 2e-4);

}  // namespace capfit::capsule

#endif  // CAPFIT_CORE_CAPSULE_BUILD_PRIMITIVES_H_
