#include "core/export/vrm_springs.h"

#include <cmath>
#include <optional>

#include "core/formats/gltf_json.h"

namespace capfit::exports {
namespace {

using nlohmann::json;

// What VRM 0 adds to a chain's last bone.
constexpr double kLastBoneM = 0.07;

double RadiusAt(const json& owner) {
  const json& radius = formats::ValueAt(owner, "hitRadius");
  if (!radius.is_number()) return 0.0;
  const double value = radius.get<double>();
  return std::isfinite(value) && value > 0.0 ? value : 0.0;
}

Eigen::Vector3d PositionOf(const GltfDocument& document, std::size_t node) {
  return document.ToWorld(node).translation();
}

Eigen::Vector3d PastTheEnd(const GltfDocument& document, std::size_t node) {
  const Eigen::Vector3d at = PositionOf(document, node);
  const std::size_t parent = document.nodes().parent[node];
  if (parent == formats::GltfNodes::kNone) return at;
  return at + kLastBoneM * (at - PositionOf(document, parent)).normalized();
}

}  // namespace

std::vector<SpringPoint> SpringPoints(const GltfDocument& document, const json& spring) {
  const std::size_t count = document.nodes().parent.size();
  std::vector<SpringPoint> points;
  double radius = -1.0;  // none before the first
  for (const json& joint : formats::ArrayAt(spring, "joints")) {
    const std::optional<std::size_t> node = formats::IndexAt(joint, "node", count);
    if (node.has_value() && radius >= 0.0) {
      points.push_back({PositionOf(document, *node), radius});
    }
    radius = RadiusAt(joint);
  }
  return points;
}

std::vector<SpringPoint> BoneGroupPoints(const GltfDocument& document, const json& bone_group) {
  const std::size_t count = document.nodes().parent.size();
  const json& nodes = formats::ArrayAt(document.root(), "nodes");
  const double radius = RadiusAt(bone_group);
  std::vector<SpringPoint> points;
  std::vector<char> is_seen(count, 0);
  std::vector<std::size_t> open = formats::IndicesAt(bone_group, "bones", count);
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    if (is_seen[node] != 0) continue;
    is_seen[node] = 1;
    const std::vector<std::size_t> children = formats::IndicesAt(nodes[node], "children", count);
    points.push_back(
        {children.empty() ? PastTheEnd(document, node) : PositionOf(document, children.front()),
         radius});
    open.insert(open.end(), children.begin(), children.end());
  }
  return points;
}

}  // namespace capfit::exports
