// Where colliders hang in a glTF file: on the nodes of the joints that carry them.
#ifndef CAPFIT_CORE_EXPORT_JOINT_NODES_H_
#define CAPFIT_CORE_EXPORT_JOINT_NODES_H_

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/export/collider_set.h"
#include "core/export/gltf_document.h"

namespace capfit::exports {

class JointNodes {
 public:
  // INVALID_ARGUMENT where a joint of the set is no node of the document. Keeps references.
  [[nodiscard]] static absl::StatusOr<JointNodes> Create(const ColliderSet& set,
                                                         GltfDocument& document);

  // The node that `joint` is, or the nearest above it whose matrix has an inverse; nothing without
  // a joint, and where there is no such node.
  [[nodiscard]] std::optional<std::size_t> NodeOf(std::int32_t joint);
  // Adds a node that stands at `world`, named, below the node of `joint`; without one below the
  // node "capfit_colliders", which is added once. Returns its index.
  std::size_t AddNode(const std::string& name, const Eigen::Isometry3d& world, std::int32_t joint);
  // The same node as NodeOf where things below it keep their size, else one that is added below it
  // and undoes its scale (once for each); "capfit_colliders" where there is none.
  std::size_t UnscaledNodeOf(std::int32_t joint);

  // JOINT_FLATTENS where joints had to be passed over.
  [[nodiscard]] std::vector<Warning> TakeWarnings() &&;

 private:
  JointNodes(const ColliderSet& set, GltfDocument& document) : set_(set), document_(document) {}
  [[nodiscard]] std::size_t Root();

  const ColliderSet& set_;
  GltfDocument& document_;
  std::optional<std::size_t> root_;
  std::vector<char> is_passed_over_;  // of each joint
  std::map<std::size_t, std::size_t> unscaled_;
};

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_JOINT_NODES_H_
