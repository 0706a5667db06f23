// The solids of a set one by one: what becomes a collider in files that know no shared spheres.
#ifndef CAPFIT_CORE_EXPORT_SOLIDS_H_
#define CAPFIT_CORE_EXPORT_SOLIDS_H_

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/export/collider_set.h"
#include "core/geometry/tapered_capsule.h"

namespace capfit::exports {

// A capsule, or a sphere that no capsule uses. Where one end of a capsule contains the other it is
// a ball.
struct Solid {
  std::string name;                      // of the capsule or the sphere; unique
  std::int32_t joint = -1;               // index into ColliderSet::joints, -1: none
  std::optional<std::size_t> capsule;    // its index; nothing for a lone sphere
  std::array<std::size_t, 2> spheres{};  // indices of its ends; twice the same for a lone sphere
  geometry::TaperedCapsule hull;         // in the set's frame

  [[nodiscard]] bool IsBall() const { return hull.IsSphere(); }
  // The sphere that a ball is.
  [[nodiscard]] const geometry::Sphere& ball() const {
    return hull.a().radius_m >= hull.b().radius_m ? hull.a() : hull.b();
  }
  // From a frame with its axis along +Y, the first sphere at the bottom, the origin in the middle
  // of the two centres (a ball's own centre, unturned), to the set's. No scale.
  [[nodiscard]] Eigen::Isometry3d Place() const;
};

// Capsules in their order, then lone spheres in theirs. `set` must be sound (CheckColliderSet).
[[nodiscard]] std::vector<Solid> SolidsOf(const ColliderSet& set);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_SOLIDS_H_
