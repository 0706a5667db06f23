#include "client/skinning_json.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t kMostNodesOfFile = 100'000;
constexpr std::size_t kMostRows = 10'000;
constexpr std::size_t kMostJointsOfResult = 4096;
constexpr std::size_t kMostVerticesOfResult = 100'000'000;

absl::Status Malformed(const std::string& field, const std::string& problem) {
  return InvalidField(ErrorReason::kMalformedFile, field, problem);
}

ordered_json JointIndexJson(std::int32_t index) {
  return index < 0 ? ordered_json(nullptr) : ordered_json(index);
}

ordered_json JointJson(const formats::NamedJoint& joint) {
  ordered_json to_mesh = ordered_json::array();
  for (int i = 0; i < 12; ++i) to_mesh.push_back(joint.to_mesh(i / 4, i % 4));
  return {{"name", joint.name},
          {"parent", JointIndexJson(joint.parent)},
          {"human_bone", joint.human_bone},
          {"to_mesh", std::move(to_mesh)},
          {"node", JointIndexJson(joint.node)}};
}

// Some entries of a list.
template <typename Value>
ordered_json Piece(const std::vector<Value>& values, std::size_t begin, std::size_t end) {
  ordered_json piece = ordered_json::array();
  for (std::size_t i = begin; i < end; ++i) piece.push_back(values[i]);
  return piece;
}

ordered_json SparseJson(const skinning::SparseWeights& weights) {
  ordered_json rows = ordered_json::array();
  for (std::size_t s = 0; s < weights.sphere_count(); ++s) {
    rows.push_back({{"vertices", Piece(weights.vertices, weights.RowBegin(s), weights.row_ends[s])},
                    {"weights", Piece(weights.weights, weights.RowBegin(s), weights.row_ends[s])}});
  }
  return {{"vertex_count", weights.vertex_count}, {"rows", std::move(rows)}};
}

ordered_json BonesJson(const skinning::BoneWeights& weights) {
  ordered_json rows = ordered_json::array();
  for (std::size_t s = 0; s < weights.sphere_count(); ++s) {
    ordered_json offsets = ordered_json::array();
    for (std::size_t i = weights.RowBegin(s); i < weights.row_ends[s]; ++i) {
      const Eigen::Vector3d& offset = weights.offsets[i];
      offsets.push_back({offset.x(), offset.y(), offset.z()});
    }
    rows.push_back({{"joints", Piece(weights.joints, weights.RowBegin(s), weights.row_ends[s])},
                    {"weights", Piece(weights.weights, weights.RowBegin(s), weights.row_ends[s])},
                    {"offsets", std::move(offsets)}});
  }
  return {{"rows", std::move(rows)}};
}

// A member that must be a list of `least` to `most` entries.
absl::StatusOr<const json*> ListAt(const json& parent, const char* name, const std::string& field,
                                   std::size_t least, std::size_t most) {
  const std::string path = absl::StrCat(field, name);
  if (!parent.is_object() || !parent.contains(name) || !parent[name].is_array()) {
    return Malformed(path, "is missing, must be a list");
  }
  const json& list = parent[name];
  if (list.size() >= least && list.size() <= most) return &list;
  return Malformed(path, absl::StrCat("has ", list.size(), " entries, must have ", least,
                                      least == most ? "" : absl::StrCat(" to ", most)));
}

absl::StatusOr<double> FiniteNumber(const json& value, const std::string& field) {
  if (value.is_number() && std::isfinite(value.get<double>())) return value.get<double>();
  return Malformed(field, "must be a finite number");
}

absl::StatusOr<std::uint32_t> IndexBelow(const json& value, std::size_t end,
                                         const std::string& field) {
  if (value.is_number_unsigned() && value.get<std::uint64_t>() < end) {
    return value.get<std::uint32_t>();
  }
  return Malformed(field, absl::StrCat("must be a whole number below ", end));
}

absl::StatusOr<formats::NamedJoint> ParseJoint(const json& value, std::size_t joint_count,
                                               const std::string& field) {
  formats::NamedJoint joint;
  CAPFIT_ASSIGN_OR_RETURN(const json* const to_mesh, ListAt(value, "to_mesh", field + ".", 12, 12));
  for (int i = 0; i < 12; ++i) {
    CAPFIT_ASSIGN_OR_RETURN(joint.to_mesh(i / 4, i % 4),
                            FiniteNumber((*to_mesh)[i], absl::StrCat(field, ".to_mesh[", i, "]")));
  }
  joint.position = joint.to_mesh.col(3);
  joint.bind = joint.to_mesh;
  const json name = value.value("name", json(""));
  if (name.is_string()) joint.name = name.get<std::string>();
  const json human_bone = value.value("human_bone", json(""));
  if (human_bone.is_string()) joint.human_bone = human_bone.get<std::string>();
  const json node = value.value("node", json());
  if (!node.is_null()) {
    CAPFIT_ASSIGN_OR_RETURN(const std::uint32_t index,
                            IndexBelow(node, kMostNodesOfFile, field + ".node"));
    joint.node = static_cast<std::int32_t>(index);
  }
  const json parent = value.value("parent", json());
  if (parent.is_null()) return joint;
  CAPFIT_ASSIGN_OR_RETURN(const std::uint32_t index,
                          IndexBelow(parent, joint_count, field + ".parent"));
  joint.parent = static_cast<std::int32_t>(index);
  return joint;
}

// A joint for each entry; nothing where the list is not there.
absl::Status ParseJoints(const json& root, const char* name, std::size_t joint_count,
                         std::vector<std::int32_t>& joints) {
  if (!root.contains(name)) return absl::OkStatus();
  CAPFIT_ASSIGN_OR_RETURN(const json* const list, ListAt(root, name, "", 0, kMostRows));
  for (std::size_t i = 0; i < list->size(); ++i) {
    CAPFIT_ASSIGN_OR_RETURN(const std::uint32_t joint,
                            IndexBelow((*list)[i], joint_count, absl::StrCat(name, "[", i, "]")));
    joints.push_back(static_cast<std::int32_t>(joint));
  }
  return absl::OkStatus();
}

// Weights and what they are for, of one row. Adds to `indices` and `weights`.
template <typename Index>
absl::Status ParseRow(const json& row, const char* name, std::size_t end, const std::string& field,
                      std::vector<Index>& indices, std::vector<float>& weights) {
  CAPFIT_ASSIGN_OR_RETURN(const json* const entries,
                          ListAt(row, name, field + ".", 1, kMostVerticesOfResult));
  CAPFIT_ASSIGN_OR_RETURN(const json* const numbers,
                          ListAt(row, "weights", field + ".", entries->size(), entries->size()));
  for (std::size_t i = 0; i < entries->size(); ++i) {
    CAPFIT_ASSIGN_OR_RETURN(
        const std::uint32_t index,
        IndexBelow((*entries)[i], end, absl::StrCat(field, ".", name, "[", i, "]")));
    CAPFIT_ASSIGN_OR_RETURN(const double weight,
                            FiniteNumber((*numbers)[i], absl::StrCat(field, ".weights[", i, "]")));
    indices.push_back(static_cast<Index>(index));
    weights.push_back(static_cast<float>(weight));
  }
  return absl::OkStatus();
}

absl::StatusOr<skinning::SparseWeights> ParseSparse(const json& value) {
  skinning::SparseWeights weights;
  CAPFIT_ASSIGN_OR_RETURN(const json* const rows,
                          ListAt(value, "rows", "sparse_weights.", 0, kMostRows));
  CAPFIT_ASSIGN_OR_RETURN(weights.vertex_count,
                          IndexBelow(value.value("vertex_count", json()), kMostVerticesOfResult,
                                     "sparse_weights.vertex_count"));
  for (std::size_t s = 0; s < rows->size(); ++s) {
    CAPFIT_RETURN_IF_ERROR(ParseRow((*rows)[s], "vertices", weights.vertex_count,
                                    absl::StrCat("sparse_weights.rows[", s, "]"), weights.vertices,
                                    weights.weights));
    weights.row_ends.push_back(static_cast<std::uint32_t>(weights.vertices.size()));
  }
  return weights;
}

absl::StatusOr<skinning::BoneWeights> ParseBones(const json& value, std::size_t joint_count) {
  skinning::BoneWeights weights;
  weights.joint_count = joint_count;
  CAPFIT_ASSIGN_OR_RETURN(const json* const rows,
                          ListAt(value, "rows", "bone_weights.", 0, kMostRows));
  for (std::size_t s = 0; s < rows->size(); ++s) {
    const std::string field = absl::StrCat("bone_weights.rows[", s, "]");
    CAPFIT_RETURN_IF_ERROR(
        ParseRow((*rows)[s], "joints", joint_count, field, weights.joints, weights.weights));
    const std::size_t count = weights.joints.size() - weights.offsets.size();
    CAPFIT_ASSIGN_OR_RETURN(const json* const offsets,
                            ListAt((*rows)[s], "offsets", field + ".", count, count));
    for (std::size_t i = 0; i < count; ++i) {
      const std::string path = absl::StrCat(field, ".offsets[", i, "]");
      if (!(*offsets)[i].is_array() || (*offsets)[i].size() != 3) {
        return Malformed(path, "must be three numbers");
      }
      Eigen::Vector3d offset;
      for (int axis = 0; axis < 3; ++axis) {
        CAPFIT_ASSIGN_OR_RETURN(offset[axis], FiniteNumber((*offsets)[i][axis], path));
      }
      weights.offsets.push_back(offset);
    }
    weights.row_ends.push_back(static_cast<std::uint32_t>(weights.joints.size()));
  }
  return weights;
}

}  // namespace

void AddSkinning(const pipeline::FitResult& result, ordered_json& root) {
  if (!result.joints.empty()) {
    ordered_json& joints = root["joints"] = ordered_json::array();
    for (const formats::NamedJoint& joint : result.joints) joints.push_back(JointJson(joint));
  }
  if (!result.sphere_joints.empty()) {
    root["sphere_joints"] = result.sphere_joints;
    root["sphere_joint_drift_m"] = result.sphere_joint_drift_m;
    root["capsule_joints"] = result.capsule_joints;
  }
  if (result.sparse_weights) root["sparse_weights"] = SparseJson(*result.sparse_weights);
  if (result.bone_weights) root["bone_weights"] = BonesJson(*result.bone_weights);
}

absl::StatusOr<ResultSkinning> ParseSkinning(const std::string& result_text) {
  const json root = json::parse(result_text, nullptr, /*allow_exceptions=*/false);
  if (!root.is_object()) return Malformed("RESULT", "must be one JSON object");
  ResultSkinning skinning;
  if (root.contains("joints")) {
    CAPFIT_ASSIGN_OR_RETURN(const json* const joints,
                            ListAt(root, "joints", "", 0, kMostJointsOfResult));
    for (std::size_t i = 0; i < joints->size(); ++i) {
      CAPFIT_ASSIGN_OR_RETURN(
          formats::NamedJoint joint,
          ParseJoint((*joints)[i], joints->size(), absl::StrCat("joints[", i, "]")));
      skinning.joints.push_back(std::move(joint));
    }
  }
  const std::size_t joint_count = skinning.joints.size();
  CAPFIT_RETURN_IF_ERROR(ParseJoints(root, "sphere_joints", joint_count, skinning.sphere_joints));
  CAPFIT_RETURN_IF_ERROR(ParseJoints(root, "capsule_joints", joint_count, skinning.capsule_joints));
  if (root.contains("sparse_weights")) {
    CAPFIT_ASSIGN_OR_RETURN(skinning.sparse, ParseSparse(root["sparse_weights"]));
  }
  if (root.contains("bone_weights")) {
    CAPFIT_ASSIGN_OR_RETURN(skinning.bones, ParseBones(root["bone_weights"], joint_count));
  }
  return skinning;
}

}  // namespace capfit::client
