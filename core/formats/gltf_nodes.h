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

// A node's place relative to its parent.
struct GltfNodePlace {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // of length 1, as read
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  std::optional<Eigen::Matrix4d> matrix;  // in place of all three, where the node has one

  [[nodiscard]] Eigen::Matrix4d ToParent() const;
};

[[nodiscard]] GltfNodePlace PlaceOf(const nlohmann::json& node);

struct GltfNodes {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::vector<Eigen::Matrix4d> to_world;  // of every node, also of those outside the scene
  std::vector<std::size_t> parent;        // of every node, kNone for roots
  std::vector<std::size_t> order;         // all nodes, parents before children
  std::vector<std::size_t> drawn;         // nodes of the scene, parents before children
};

// INVALID_ARGUMENT where a node has two parents or is its own ancestor. O(nodes).
[[nodiscard]] absl::StatusOr<GltfNodes> ReadGltfNodes(const nlohmann::json& gltf);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_NODES_H_
