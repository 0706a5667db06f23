// A glTF file that is written back with something added: all it holds stays as it was.
#ifndef CAPFIT_CORE_EXPORT_GLTF_DOCUMENT_H_
#define CAPFIT_CORE_EXPORT_GLTF_DOCUMENT_H_

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/formats/gltf_nodes.h"

namespace capfit::exports {

// Members, also unknown ones, keep their values (order and spelling of numbers may change); what
// is added to lists comes last, so that no index changes. Bytes of the binary chunk stay the same,
// and new ones follow.
class GltfDocument {
 public:
  // An empty scene.
  GltfDocument();

  // GLB, VRM or .gltf with its buffers inside, checked as formats::ReadGlb does. Besides refused
  // (INVALID_ARGUMENT, field "mesh.file"): members that are added to and are no lists or objects,
  // children that are no nodes, and JSON nested deeper than 200. A .gltf's first buffer becomes the
  // binary chunk. The document keeps no view of `bytes`.
  [[nodiscard]] static absl::StatusOr<GltfDocument> Open(std::span<const std::byte> bytes);

  [[nodiscard]] nlohmann::json& root() { return json_; }
  [[nodiscard]] const nlohmann::json& root() const { return json_; }
  // Of the nodes that the file came with.
  [[nodiscard]] const formats::GltfNodes& nodes() const { return nodes_; }

  // Adds to the root's list `key`; the index of what was added.
  std::size_t Add(const char* key, nlohmann::json value);
  // Adds a node below `parent`, or without one at the root of the scene.
  std::size_t AddNode(nlohmann::json node, std::optional<std::size_t> parent);
  // Where a node stands, of the file's own or added by AddPlacedNode; the scene's origin for those
  // that AddNode added.
  [[nodiscard]] Eigen::Affine3d ToWorld(std::size_t node) const;
  // Whether the node flattens nothing that is below it.
  [[nodiscard]] bool HasInverse(std::size_t node) const;
  // Nodes that bring what is below them to `world` (no scale), below `parent`, which must have an
  // inverse: one where that is scaled alike in all directions, else two, for a turn between two
  // scalings is no single node's. Returns the index of the inner one, which has `name`.
  std::size_t AddPlacedNode(const std::string& name, const Eigen::Isometry3d& world,
                            std::size_t parent);
  // The root's or a node's extension, an object; added where it is not there, and to
  // extensionsUsed.
  nlohmann::json& Extension(nlohmann::json& owner, const char* name);
  // Adds bytes to the binary chunk, and a view of them. `target`: 34962 vertices, 34963 indices.
  std::size_t AddView(std::string_view bytes, int target);

  // The GLB. Errors: TOO_LARGE beyond 4 GB.
  [[nodiscard]] absl::StatusOr<std::string> Bytes() const;

 private:
  absl::Status CheckLists() const;
  absl::Status CheckNodes(const nlohmann::json& indices, const char* owner) const;
  void TakeBuffer();
  std::size_t OwnBuffer();

  nlohmann::json json_;
  std::string binary_;               // the binary chunk
  std::vector<std::string> others_;  // chunks of other types
  formats::GltfNodes nodes_;
  std::map<std::size_t, Eigen::Isometry3d> placed_;
};

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_GLTF_DOCUMENT_H_
