// Triangle meshes with names, as files of meshes hold them.
#ifndef CAPFIT_CORE_EXPORT_NAMED_MESH_H_
#define CAPFIT_CORE_EXPORT_NAMED_MESH_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace capfit::exports {

struct NamedMesh {
  std::string name;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise from outside
};

// An OBJ of them all, each an object and a group. Blanks and control characters in names become
// '_'.
[[nodiscard]] std::string ObjOf(std::span<const NamedMesh> meshes);

// A GLB of them all, each a node and a mesh of floats, without normals: readers shade it flat.
[[nodiscard]] absl::StatusOr<std::string> GlbOf(std::span<const NamedMesh> meshes);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_NAMED_MESH_H_
