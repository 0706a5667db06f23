// The node tree of a glTF file: who is drawn and where.
#ifndef CAPFIT_CORE_FORMATS_GLTF_NODES_H_
#define CAPFIT_CORE_FORMATS_GLTF_NODES_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"

namespace capfit::formats {

struct GltfNodes {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::vector<Eigen::Matrix4d> to_world;  // of every node, also of those outside the scene
  std::vector<std::size_t> parent;        // of every node, kNone for roots
  std::vector<std::size_t> order;         // all nodes, parents before children
  std::vector<std::size_t> drawn;         // nodes of the scene, parents before children
};

// What leads from a node's own frame to its parent's: a matrix, or a scale, then a turn, then a
// move.
struct NodePose {
  std::optional<Eigen::Matrix4d> matrix;  // in place of the other three
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();

  [[nodiscard]] Eigen::Matrix4d ToParent() const;
};
// What the node says; what it says in another form than glTF's is as if it said nothing.
[[nodiscard]] NodePose PoseOf(const nlohmann::json& node);

// INVALID_ARGUMENT where a node has two parents or is its own ancestor. O(nodes).
[[nodiscard]] absl::StatusOr<GltfNodes> ReadGltfNodes(const nlohmann::json& gltf);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_NODES_H_
