// Boxes for tests, several in one mesh.
#ifndef CAPFIT_TESTS_CORE_MESH_BOXES_H_
#define CAPFIT_TESTS_CORE_MESH_BOXES_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/mesh/body_mesh.h"

namespace capfit::mesh {

// Boxes given by their low and high corners, faces outward.
inline BodyMesh BoxesOf(std::span<const std::array<Eigen::Vector3d, 2>> boxes) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  for (const auto& [low, high] : boxes) {
    const auto base = static_cast<std::uint32_t>(vertices.size());
    for (int k = 0; k < 8; ++k) {
      vertices.emplace_back((k & 1) != 0 ? high.x() : low.x(), (k & 2) != 0 ? high.y() : low.y(),
                            (k & 4) != 0 ? high.z() : low.z());
    }
    for (const Triangle& t :
         {Triangle{0, 2, 3}, Triangle{0, 3, 1}, Triangle{4, 5, 7}, Triangle{4, 7, 6},
          Triangle{0, 1, 5}, Triangle{0, 5, 4}, Triangle{2, 6, 7}, Triangle{2, 7, 3},
          Triangle{0, 4, 6}, Triangle{0, 6, 2}, Triangle{1, 3, 7}, Triangle{1, 7, 5}}) {
      triangles.push_back({base + t[0], base + t[1], base + t[2]});
    }
  }
  return BodyMesh(std::move(vertices), std::move(triangles), {});
}

}  // namespace capfit::mesh

#endif  // CAPFIT_TESTS_CORE_MESH_BOXES_H_
