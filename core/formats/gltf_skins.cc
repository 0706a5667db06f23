#include "core/formats/gltf_skins.h"

#include <Eigen/LU>  // determinant, inverse
#include <cmath>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/gltf_accessor.h"
#include "core/formats/gltf_json.h"

namespace capfit::formats {
namespace {

using nlohmann::json;

// A skeleton of a human has some 70 joints, with every finger and hair strand some hundred.
constexpr std::size_t kMostJoints = 4096;
// VRM files give each of some twenty meshes a skin that lists all joints again.
constexpr std::size_t kMostJointsOfSkins = 65'536;

// VRM's words for bones are short.
constexpr std::size_t kLongestBone = 64;

class SkeletonReader {
 public:
  SkeletonReader(GltfFile& file, const GltfNodes& nodes)
      : file_(file), nodes_(nodes), json_(ArrayAt(file.description(), "nodes")) {}

  absl::StatusOr<GltfSkeleton> Run() {
    const json& skins = ArrayAt(file_.description(), "skins");
    joint_of_node_.assign(json_.size(), -1);
    for (const std::size_t n : nodes_.drawn) {
      const std::optional<std::size_t> index = IndexAt(json_[n], "skin", skins.size());
      if (!index.has_value() || skeleton_.skins.contains(*index)) continue;
      const FilePlace place = AtElement(absl::StrCat("skin ", *index));
      CAPFIT_ASSIGN_OR_RETURN(GltfSkin skin, ReadSkin(skins[*index], place));
      skeleton_.skins.emplace(*index, std::move(skin));
    }
    CAPFIT_RETURN_IF_ERROR(AddHumanBones());
    if (!skeleton_.joints.empty()) FindParents();
    return std::move(skeleton_);
  }

 private:
  absl::StatusOr<GltfSkin> ReadSkin(const json& json_skin, const FilePlace& place) {
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<std::size_t> joint_nodes,
                            JointNodesOf(json_skin, place));
    GltfSkin skin;
    for (const std::size_t node : joint_nodes) {
      CAPFIT_ASSIGN_OR_RETURN(const std::int32_t joint, JointAt(node, place));
      skin.joints.push_back(static_cast<std::uint16_t>(joint));
      skin.placings.push_back(nodes_.to_world[node].topRows<3>());
    }
    const bool is_bound = json_skin.is_object() && json_skin.contains("inverseBindMatrices");
    if (is_bound) CAPFIT_RETURN_IF_ERROR(ApplyInverseBinds(json_skin, joint_nodes, skin, place));
    for (const Placing& placing : skin.placings) {
      skin.is_placing.push_back(IsPlacing(placing) ? 1 : 0);
      if (is_bound && skin.is_placing.back() && !skin.first_placing) skin.first_placing = placing;
    }
    return skin;
  }

  absl::StatusOr<std::vector<std::size_t>> JointNodesOf(const json& skin, const FilePlace& place) {
    const json& entries = ArrayAt(skin, "joints");
    if (entries.size() > kMostJoints) return TooManyJoints(entries.size(), kMostJoints, place);
    joints_of_skins_ += entries.size();
    if (joints_of_skins_ > kMostJointsOfSkins) {
      return FileTooLarge(place, joints_of_skins_, "joints of skins", kMostJointsOfSkins);
    }
    std::vector<std::size_t> nodes;
    for (const json& entry : entries) {
      if (!entry.is_number_unsigned()) {
        return FileError(ErrorReason::kMalformedFile, place, "it has a joint that is no index");
      }
      if (entry.get<std::uint64_t>() >= json_.size()) {
        return FileOutOfRange(place, "a joint", entry.get<std::uint64_t>(),
                              IndexRange(json_.size()));
      }
      nodes.push_back(entry.get<std::size_t>());
    }
    return nodes;
  }

  static absl::Status TooManyJoints(std::size_t count, std::size_t limit, const FilePlace& place) {
    return FileError(ErrorReason::kTooLarge, place,
                     absl::StrCat("it has ", count, " joints, must have at most ", limit),
                     ValueAndLimit(count, limit));
  }

  // The joint of a node; a new one at its first mention.
  absl::StatusOr<std::int32_t> JointAt(std::size_t node, const FilePlace& place) {
    std::int32_t& joint = joint_of_node_[node];
    if (joint >= 0) return joint;
    if (skeleton_.joints.size() >= kMostJoints) {
      return FileTooLarge(place, skeleton_.joints.size() + 1, "joints", kMostJoints);
    }
    const Placing to_mesh = nodes_.to_world[node].topRows<3>();
    const Eigen::Vector3d position = to_mesh.col(3);
    if (!IsPosition(position)) {
      return FileError(ErrorReason::kOutOfRange, place,
                       absl::StrCat("its joint node ", node, " stands nowhere"));
    }
    joint = static_cast<std::int32_t>(skeleton_.joints.size());
    skeleton_.joints.push_back({NameAt(json_[node], "name"),
                                position,
                                -1,
                                {},
                                to_mesh,
                                static_cast<std::int32_t>(node),
                                to_mesh});
    has_bind_.push_back(0);
    return joint;
  }

  absl::Status ApplyInverseBinds(const json& json_skin, const std::vector<std::size_t>& nodes,
                                 GltfSkin& skin, const FilePlace& place) {
    const std::size_t accessors = ArrayAt(file_.description(), "accessors").size();
    const std::optional<std::size_t> index = IndexAt(json_skin, "inverseBindMatrices", accessors);
    if (!index.has_value()) return BadIndexAt(place, json_skin, "inverseBindMatrices", accessors);
    CAPFIT_ASSIGN_OR_RETURN(const GltfAccessor matrices,
                            GltfAccessor::Create(file_, *index, "MAT4"));
    if (matrices.count() < nodes.size()) {
      return FileError(ErrorReason::kCountMismatch, place,
                       absl::StrCat("it has ", nodes.size(), " joints with only ", matrices.count(),
                                    " matrices"),
                       ValueAndLimit(matrices.count(), nodes.size()));
    }
    std::vector<Eigen::Matrix4d> inverse_binds;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      Eigen::Matrix4d inverse_bind;
      for (Eigen::Index k = 0; k < 16; ++k) {
        inverse_bind(k % 4, k / 4) = matrices.At(j, k);
      }
      skin.placings[j] = (nodes_.to_world[nodes[j]] * inverse_bind).topRows<3>();
      inverse_binds.push_back(inverse_bind);
    }
    TakeBinds(skin, inverse_binds);
    return absl::OkStatus();
  }

  // Skins may have their vertices in different spaces: a joint that an earlier skin has told of
  // says how this one's lies in the first one's.
  void TakeBinds(const GltfSkin& skin, const std::vector<Eigen::Matrix4d>& inverse_binds) {
    Eigen::Matrix4d first_from_here = Eigen::Matrix4d::Identity();
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      if (has_bind_[skin.joints[j]] == 0 || !IsPlacing(inverse_binds[j].topRows<3>())) continue;
      first_from_here.topRows<3>() = skeleton_.joints[skin.joints[j]].bind * inverse_binds[j];
      break;
    }
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      if (has_bind_[skin.joints[j]] != 0 || !IsPlacing(inverse_binds[j].topRows<3>())) continue;
      has_bind_[skin.joints[j]] = 1;
      skeleton_.joints[skin.joints[j]].bind =
          (first_from_here * inverse_binds[j].inverse()).topRows<3>();
    }
  }

  absl::Status AddHumanBones() {
    for (const json& bone :
         ArrayAt(ValueAt(ExtensionAt(file_.description(), "VRM"), "humanoid"), "humanBones")) {
      CAPFIT_RETURN_IF_ERROR(AddHumanBone(bone, NameAt(bone, "bone")));
    }
    const json& bones =
        ValueAt(ValueAt(ExtensionAt(file_.description(), "VRMC_vrm"), "humanoid"), "humanBones");
    if (!bones.is_object()) return absl::OkStatus();
    for (const auto& [name, bone] : bones.items()) {
      CAPFIT_RETURN_IF_ERROR(AddHumanBone(bone, name));
    }
    return absl::OkStatus();
  }

  absl::Status AddHumanBone(const json& bone, const std::string& name) {
    const std::optional<std::size_t> node = IndexAt(bone, "node", json_.size());
    if (!node.has_value() || name.empty() || name.size() > kLongestBone) return absl::OkStatus();
    const FilePlace place = AtElement(absl::StrCat("human bone ", Printable(name)));
    CAPFIT_ASSIGN_OR_RETURN(const std::int32_t joint, JointAt(*node, place));
    skeleton_.joints[joint].human_bone = name;
    return absl::OkStatus();
  }

  // One pass from the roots down, so that no depth of the tree costs more.
  void FindParents() {
    skeleton_.nearest_joint.assign(json_.size(), -1);
    for (const std::size_t n : nodes_.order) {
      const std::int32_t above =
          nodes_.parent[n] == GltfNodes::kNone ? -1 : skeleton_.nearest_joint[nodes_.parent[n]];
      const std::int32_t joint = joint_of_node_[n];
      skeleton_.nearest_joint[n] = joint >= 0 ? joint : above;
      if (joint >= 0) skeleton_.joints[joint].parent = above;
    }
  }

  GltfFile& file_;
  const GltfNodes& nodes_;
  const json& json_;
  std::vector<std::int32_t> joint_of_node_;
  std::vector<char> has_bind_;  // of each joint, whether a skin told its bind
  std::size_t joints_of_skins_ = 0;
  GltfSkeleton skeleton_;
};

}  // namespace

bool IsPlacing(const Placing& placing) {
  return placing.allFinite() && std::abs(placing.leftCols<3>().determinant()) > 0.0;
}

absl::StatusOr<GltfSkeleton> ReadGltfSkeleton(GltfFile& file, const GltfNodes& nodes) {
  return SkeletonReader(file, nodes).Run();
}

}  // namespace capfit::formats
