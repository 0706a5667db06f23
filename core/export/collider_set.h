// What is exported: a result as every engine's file needs it, whichever way it came here.
#ifndef CAPFIT_CORE_EXPORT_COLLIDER_SET_H_
#define CAPFIT_CORE_EXPORT_COLLIDER_SET_H_

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/base/warning.h"
#include "core/capsule/capsule_profile.h"
#include "core/capsule/primitive_set.h"
#include "core/formats/polygon_soup.h"
#include "core/geometry/similarity.h"

namespace capfit::exports {

// Spheres, capsules and what they hang on. All positions in the mesh's own frame and unit, as the
// body stood when it was fitted.
struct ColliderSet {
  capsule::PrimitiveSet primitives;
  std::vector<std::string> sphere_names;  // of each sphere, unique: "left_forearm_2"
  // To metres, +Y up, facing +Z, the body's left at +X, soles at y = 0.
  geometry::Similarity body_from_mesh;
  // The skeleton that came with the mesh; empty where none did.
  std::vector<formats::NamedJoint> joints;
  // The joint that each sphere, and each capsule, moves with where only one can carry it: indices
  // into `joints`; empty without joints.
  std::vector<std::int32_t> sphere_joints;
  std::vector<std::int32_t> capsule_joints;
  // What coverage was proved for.
  capsule::CapsuleProfile profile = capsule::CapsuleProfile::kTangentHull;
  std::string source;   // name of the mesh's file without folder and ending; may be empty
  std::string version;  // of the capfit that fitted it

  [[nodiscard]] std::size_t sphere_count() const { return primitives.spheres.size(); }
  [[nodiscard]] std::size_t capsule_count() const { return primitives.capsules.size(); }
};

// One of the files that an export consists of.
struct ExportFile {
  std::string name;  // without folder: "colliders.json"
  std::string bytes;
};

// What an export made, and in words what the format could not hold.
struct Exported {
  std::vector<ExportFile> files;  // the first is the one that names the export
  std::vector<Warning> warnings;
};

// OK, or INVALID_ARGUMENT naming what does not fit together (a list of another length, an index out
// of range, a number that is not finite, a radius that is not above 0). Makers of files rely on it.
[[nodiscard]] absl::Status CheckColliderSet(const ColliderSet& set);

// Of each capsule its name: the names of its two spheres with "__" between.
[[nodiscard]] std::vector<std::string> CapsuleNames(const ColliderSet& set);

// Indices of the spheres that no capsule uses: readers that build capsules alone would lose them.
[[nodiscard]] std::vector<std::size_t> LoneSpheres(const ColliderSet& set);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_COLLIDER_SET_H_
