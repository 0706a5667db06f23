// A small rigged glTF and a collider set on its joints, for tests.
#ifndef CAPFIT_TESTS_CORE_EXPORT_RIGGED_SAMPLE_H_
#define CAPFIT_TESTS_CORE_EXPORT_RIGGED_SAMPLE_H_

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/export/collider_set.h"
#include "core/formats/gltf_chunks.h"
#include "core/formats/gltf_file.h"
#include "core/formats/gltf_nodes.h"

namespace capfit::exports {

inline std::span<const std::byte> BytesOf(const std::string& text) {
  return std::as_bytes(std::span(text));
}

inline std::string GlbOf(const nlohmann::json& gltf, const std::string& binary = "12345678") {
  const std::string text = gltf.dump();
  formats::GltfChunks chunks;
  chunks.description = text;
  chunks.binary = BytesOf(binary);
  return formats::JoinGltf(chunks).value();
}

inline nlohmann::json JsonOf(const std::string& glb) {
  const auto chunks = formats::SplitGltf(BytesOf(glb));
  EXPECT_TRUE(chunks.ok()) << chunks.status();
  return nlohmann::json::parse(chunks->description);
}

// Nodes of every kind that a joint may be: scaled, mirrored, with unlike scales below a turn, and
// one that flattens.
inline nlohmann::json RiggedGltf() {
  const nlohmann::json half_turn = {0.3535533905932738, 0.3535533905932738, 0.1464466094067262,
                                    0.8535533905932738};
  return {
      {"asset", {{"version", "2.0"}, {"copyright", "caller"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes",
       {{{"name", "root"}, {"children", {1, 2, 3, 4}}, {"scale", {0.5, 0.5, 0.5}}},
        {{"name", "plain"}, {"translation", {1, 2, 3}}, {"rotation", half_turn}},
        {{"name", "mirrored"}, {"scale", {-2, 2, 2}}, {"translation", {0, 1, 0}}},
        {{"name", "stretched"}, {"scale", {1, 3, 0.5}}, {"rotation", half_turn}, {"children", {5}}},
        {{"name", "flat"}, {"scale", {1, 0, 1}}},
        {{"name", "sheared"}, {"rotation", half_turn}, {"translation", {0.1, 0.2, 0.3}}}}},
      {"buffers", {{{"byteLength", 8}}}},
      {"images", {{{"uri", "data:image/png;base64,AA=="}}}},
      {"animations", nlohmann::json::array()},
      {"extras", {{"own", {1, 2.5, "x"}}}},
      {"extensionsUsed", {"CALLER_words"}},
      {"extensions", {{"CALLER_words", {{"deep", {{"er", true}}}}}}}};
}

// One capsule and one lone sphere on each of the joints in `nodes`, the joint's number apart.
inline ColliderSet SetOn(const std::string& glb, const std::vector<std::int32_t>& nodes) {
  const auto file = formats::GltfFile::Open(BytesOf(glb));
  EXPECT_TRUE(file.ok()) << file.status();
  const auto tree = formats::ReadGltfNodes(file->description());
  ColliderSet set;
  set.version = "0.0.0";
  for (const std::int32_t node : nodes) {
    const auto joint = static_cast<std::int32_t>(set.joints.size());
    formats::NamedJoint& named = set.joints.emplace_back();
    named.name = "joint_" + std::to_string(joint);
    named.node = node;
    named.to_mesh = tree->to_world[node].topRows<3>();
    named.position = named.to_mesh.col(3);
    const Eigen::Vector3d at(0.3 * joint, 0.2, -0.1 * joint);
    const auto first = static_cast<int>(set.sphere_count());
    set.primitives.spheres.push_back({at, 0.1});
    set.primitives.spheres.push_back({at + Eigen::Vector3d(0.1, -0.4, 0.2), 0.15});
    set.primitives.spheres.push_back({at + Eigen::Vector3d(1, 1, 1), 0.05});
    set.primitives.capsules.push_back({first, first + 1});
    for (const char* end : {"a", "b", "lone"}) {
      set.sphere_names.push_back(std::string(end) + std::to_string(joint));
      set.sphere_joints.push_back(joint);
    }
    set.capsule_joints.push_back(joint);
  }
  set.primitives.origins.resize(set.sphere_count());
  return set;
}

// From the frame of the node of that name to the scene.
inline Eigen::Affine3d NodeNamed(const std::string& glb, const std::string& name) {
  const auto file = formats::GltfFile::Open(BytesOf(glb));
  EXPECT_TRUE(file.ok()) << file.status();
  const auto tree = formats::ReadGltfNodes(file->description());
  const nlohmann::json& nodes = file->description()["nodes"];
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].value("name", "") == name) return Eigen::Affine3d(tree->to_world[n]);
  }
  ADD_FAILURE() << "no node " << name;
  return Eigen::Affine3d::Identity();
}

}  // namespace capfit::exports

#endif  // CAPFIT_TESTS_CORE_EXPORT_RIGGED_SAMPLE_H_
