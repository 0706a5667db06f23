#include "core/formats/gltf_nodes.h"

#include <Eigen/Geometry>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/file_error.h"
#include "core/formats/gltf_json.h"

namespace capfit::formats {
namespace {

using nlohmann::json;

// A scene has some thousand; keeps hostile files cheap.
constexpr std::size_t kMostNodes = 100'000;

// The numbers of json[key] if it is an array of `count` numbers, else nothing.
std::optional<std::vector<double>> NumbersAt(const json& parent, const char* key,
                                             std::size_t count) {
  const json& array = ArrayAt(parent, key);
  if (array.size() != count) return std::nullopt;
  std::vector<double> numbers;
  for (const json& number : array) {
    if (!number.is_number()) return std::nullopt;
    numbers.push_back(number.get<double>());
  }
  return numbers;
}

class NodeTree {
 public:
  explicit NodeTree(const json& gltf) : gltf_(gltf), nodes_(ArrayAt(gltf, "nodes")) {}

  absl::StatusOr<GltfNodes> Run() {
    if (nodes_.size() > kMostNodes) return FileTooLarge({}, nodes_.size(), "nodes", kMostNodes);
    CAPFIT_RETURN_IF_ERROR(FindChildren());
    result_.to_world.assign(nodes_.size(), Eigen::Matrix4d::Identity());
    // What stays unplaced hangs on a ring of nodes.
    const std::vector<std::size_t> placed = Walk(roots_, true);
    if (placed.size() != nodes_.size()) {
      return FileError(ErrorReason::kMalformedFile, {}, "has nodes that are their own ancestors");
    }
    result_.order = placed;
    const json& scenes = ArrayAt(gltf_, "scenes");
    if (scenes.empty()) {
      result_.drawn = placed;
      return std::move(result_);
    }
    const json& scene = scenes[IndexAt(gltf_, "scene", scenes.size()).value_or(0)];
    result_.drawn = Walk(IndicesAt(scene, "nodes", nodes_.size()), false);
    return std::move(result_);
  }

 private:
  absl::Status FindChildren() {
    children_.resize(nodes_.size());
    result_.parent.assign(nodes_.size(), GltfNodes::kNone);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      children_[n] = IndicesAt(nodes_[n], "children", nodes_.size());
      for (const std::size_t child : children_[n]) {
        if (result_.parent[child] != GltfNodes::kNone) {
          return FileError(ErrorReason::kMalformedFile, AtElement(absl::StrCat("node ", child)),
                           "it has two parents");
        }
        result_.parent[child] = n;
      }
    }
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (result_.parent[n] == GltfNodes::kNone) roots_.push_back(n);
    }
    return absl::OkStatus();
  }

  // The nodes below `roots`, each once, in the order of the file's lists.
  std::vector<std::size_t> Walk(const std::vector<std::size_t>& roots, bool place) {
    std::vector<std::size_t> order;
    std::vector<bool> seen(nodes_.size(), false);
    std::vector<std::size_t> stack(roots.rbegin(), roots.rend());
    while (!stack.empty()) {
      const std::size_t node = stack.back();
      stack.pop_back();
      if (seen[node]) continue;
      seen[node] = true;
      order.push_back(node);
      if (place) result_.to_world[node] *= PlaceOf(nodes_[node]).ToParent();
      for (std::size_t k = children_[node].size(); k-- > 0;) {
        const std::size_t child = children_[node][k];
        if (place) result_.to_world[child] = result_.to_world[node];
        stack.push_back(child);
      }
    }
    return order;
  }

  const json& gltf_;
  const json& nodes_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<std::size_t> roots_;
  GltfNodes result_;
};

}  // namespace

Eigen::Matrix4d GltfNodePlace::ToParent() const {
  if (matrix) return *matrix;
  Eigen::Affine3d to_parent = Eigen::Affine3d::Identity();
  to_parent.translate(translation);
  to_parent.rotate(rotation);
  to_parent.scale(scale);
  return to_parent.matrix();
}

GltfNodePlace PlaceOf(const json& node) {
  GltfNodePlace place;
  if (const auto m = NumbersAt(node, "matrix", 16)) {
    place.matrix = Eigen::Map<const Eigen::Matrix4d>(m->data());  // both are column by column
    return place;
  }
  if (const auto t = NumbersAt(node, "translation", 3)) {
    place.translation = {(*t)[0], (*t)[1], (*t)[2]};
  }
  if (const auto r = NumbersAt(node, "rotation", 4)) {
    place.rotation = Eigen::Quaterniond((*r)[3], (*r)[0], (*r)[1], (*r)[2]).normalized();
  }
  if (const auto s = NumbersAt(node, "scale", 3)) place.scale = {(*s)[0], (*s)[1], (*s)[2]};
  return place;
}

absl::StatusOr<GltfNodes> ReadGltfNodes(const json& gltf) { return NodeTree(gltf).Run(); }

}  // namespace capfit::formats
