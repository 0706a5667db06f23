// Colliders that a viewer shows: triangle meshes of solids in a glTF file.
#ifndef CAPFIT_CORE_EXPORT_GLTF_PREVIEW_H_
#define CAPFIT_CORE_EXPORT_GLTF_PREVIEW_H_

#include <cstddef>
#include <optional>
#include <string>

#include "core/export/gltf_document.h"
#include "core/export/lathe.h"

namespace capfit::exports {

// Adds meshes to a document, and once the material that they share.
class GltfPreview {
 public:
  explicit GltfPreview(GltfDocument& document) : document_(document) {}

  // The index of a new mesh: floats and 16-bit indices, with normals where `has_normals`. At most
  // 65,535 vertices.
  std::size_t AddMesh(const std::string& name, const LatheMesh& mesh, bool has_normals);

 private:
  std::size_t AddVectors(const std::vector<Eigen::Vector3d>& vectors, bool has_bounds);
  std::size_t AddIndices(const LatheMesh& mesh);
  std::size_t Material();

  GltfDocument& document_;
  std::optional<std::size_t> material_;
};

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_GLTF_PREVIEW_H_
