// Starting topologies: which spheres a body gets and which of them are tied, before anything is
// optimised.
#ifndef CAPFIT_CORE_REFINE_LAYOUTS_LAYOUT_H_
#define CAPFIT_CORE_REFINE_LAYOUTS_LAYOUT_H_

#include <cstdint>
#include <span>

#include "core/body/body.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/layouts/bones.h"

namespace capfit::refine {

// A sphere of the left half or of the mid-plane, hung on a bone.
struct LayoutNode {
  BoneId bone;
  BonePlace place;
  double radius;  // in bone radii
  bool paired;    // has an image on the right; otherwise it lies on the mid-plane
};

// A capsule between two nodes and its image. `crossed`: from left to right.
struct LayoutEdge {
  std::uint8_t a, b;
  bool crossed;
};

struct Layout {
  std::span<const LayoutNode> nodes;
  std::span<const LayoutEdge> edges;
};

// What a layout is made for.
enum class FitKind { kBestFit, kEnclose };

struct NamedLayout {
  const char* name;
  FitKind kind;
  int primitives;  // that it has on a body with all parts, about; several may share a number
  bool with_ends;  // spheres for head, hands and feet; those for trunk and limbs are fewer for it
  Layout layout;
};

// All of them; of each kind, with and without ends, those of fewer primitives first.
[[nodiscard]] std::span<const NamedLayout> Layouts();

// Hangs the layout on the body's bones. Spheres on missing bones or of parts that are not selected
// are left out with their capsules. Where the graph is symmetric the left side is mirrored. A
// chain of the body that got no sphere at all gets some along its medial curve; a body without any
// landmark gets one ball.
[[nodiscard]] capsule::MirroredSet HangLayout(const Layout& layout, const body::Body& body,
                                              const body::PartSelection& parts, bool symmetric);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_LAYOUTS_LAYOUT_H_
