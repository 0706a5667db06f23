// Colliders that a viewer shows: triangle meshes of solids in a glTF file.
#ifndef CAPFIT_CORE_EXPORT_GLTF_PREVIEW_H_
#define CAPFIT_CORE_EXPORT_GLTF_PREVIEW_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/export/gltf_document.h"

namespace capfit::exports {

using Corners = std::array<std::uint32_t, 3>;

// Adds meshes to a document, and once the material that they share.
class GltfPreview {
 public:
  explicit GltfPreview(GltfDocument& document) : document_(document) {}

  // The index of a new mesh: floats, and indices of 16 bits, or 32 where there are more vertices.
  // `normals`: one for each vertex, or none at all.
  std::size_t AddMesh(const std::string& name, const std::vector<Eigen::Vector3d>& vertices,
                      const std::vector<Eigen::Vector3d>& normals,
                      const std::vector<Corners>& triangles);

 private:
  std::size_t AddVectors(const std::vector<Eigen::Vector3d>& vectors, bool has_bounds);
  template <typename Index>
  std::size_t AddIndices(const std::vector<Corners>& triangles, int component_type);
  std::size_t Material();

  GltfDocument& document_;
  std::optional<std::size_t> material_;
};

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_GLTF_PREVIEW_H_
