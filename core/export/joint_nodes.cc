#include "core/export/joint_nodes.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/gltf_json.h"

namespace capfit::exports {
namespace {

// How far squared lengths may be from 1: the rounding of floats.
constexpr double kUnscaled = 1e-5;

}  // namespace

absl::StatusOr<JointNodes> JointNodes::Create(const ColliderSet& set, GltfDocument& document) {
  const std::size_t count = formats::ArrayAt(document.root(), "nodes").size();
  for (std::size_t j = 0; j < set.joints.size(); ++j) {
    const std::int32_t node = set.joints[j].node;
    if (node < 0 || std::cmp_greater_equal(node, count)) {
      return IndexOutOfRange(absl::StrCat("joints[", j, "].node"), node, count);
    }
  }
  JointNodes nodes(set, document);
  nodes.is_passed_over_.assign(set.joints.size(), 0);
  return nodes;
}

std::optional<std::size_t> JointNodes::NodeOf(std::int32_t joint) {
  if (joint < 0) return std::nullopt;
  const std::size_t own = set_.joints[joint].node;
  std::size_t node = own;
  while (node != formats::GltfNodes::kNone && !document_.HasInverse(node)) {
    node = document_.nodes().parent[node];
  }
  if (node != own) is_passed_over_[joint] = 1;
  if (node == formats::GltfNodes::kNone) return std::nullopt;
  return node;
}

std::size_t JointNodes::Root() {
  if (!root_.has_value()) root_ = document_.AddNode({{"name", "capfit_colliders"}}, std::nullopt);
  return *root_;
}

std::size_t JointNodes::AddNode(const std::string& name, const Eigen::Isometry3d& world,
                                std::int32_t joint) {
  const std::optional<std::size_t> node = NodeOf(joint);
  if (node.has_value()) return document_.AddPlacedNode(name, world, *node);
  return document_.AddPlacedNode(name, world, Root());
}

std::size_t JointNodes::UnscaledNodeOf(std::int32_t joint) {
  const std::optional<std::size_t> node = NodeOf(joint);
  if (!node.has_value()) return Root();
  const Eigen::Affine3d to_world = document_.ToWorld(*node);
  const Eigen::Matrix3d squared = to_world.linear().transpose() * to_world.linear();
  if (squared.isIdentity(kUnscaled)) return *node;
  const auto [found, is_new] = unscaled_.try_emplace(*node, 0);
  if (is_new) {
    const Eigen::Isometry3d moved(Eigen::Translation3d(to_world.translation()));
    found->second =
        document_.AddPlacedNode(absl::StrCat("capfit_", set_.joints[joint].name), moved, *node);
  }
  return found->second;
}

std::vector<Warning> JointNodes::TakeWarnings() && {
  const auto count = std::count(is_passed_over_.begin(), is_passed_over_.end(), 1);
  if (count == 0) return {};
  const auto first = std::find(is_passed_over_.begin(), is_passed_over_.end(), 1);
  const std::string name = set_.joints[first - is_passed_over_.begin()].name;
  return {{"JOINT_FLATTENS",
           absl::StrCat(count, " joints, the first '", name,
                        "', have a matrix without inverse (a scale of 0): their colliders hang on "
                        "the nearest node above that has one"),
           count}};
}

}  // namespace capfit::exports
