// Capsules and balls as triangle meshes, turned about their axis.
#ifndef CAPFIT_CORE_EXPORT_LATHE_H_
#define CAPFIT_CORE_EXPORT_LATHE_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/export/solids.h"

namespace capfit::exports {

// Closed and turned outward.
struct LatheMesh {
  std::vector<Eigen::Vector3d> vertices;  // in the frame of Solid::Place, the set's unit
  std::vector<Eigen::Vector3d> normals;   // of the solid, one for each vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

enum class LatheKind {
  kOnSurface,  // vertices lie on the solid, faces within it: for eyes
  kEnclosing   // faces touch the solid from outside: nothing of it is out
};

// `segments` >= 3 around the axis, rings of about the same angle over the ends. Faces are at most
// LatheDeviation(segments) times the larger radius away from the solid. O(segments^2).
[[nodiscard]] LatheMesh Lathe(const Solid& solid, int segments, LatheKind kind);

// 1 / cos^2(pi / segments) - 1: of an enclosing mesh; one on the surface deviates by less.
[[nodiscard]] double LatheDeviation(int segments);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_LATHE_H_
