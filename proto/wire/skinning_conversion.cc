#include "proto/wire/skinning_conversion.h"

#include <cmath>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/plain_text.h"
#include "core/base/status.h"

namespace capfit::wire {
namespace {

constexpr int kPlacingNumbers = 12;

absl::Status Bad(const std::string& field, const std::string& problem) {
  return InvalidField(ErrorReason::kOutOfRange, field, problem);
}

template <typename Weights>
v1::SkinningChunk ChunkOf(const Weights& weights, std::size_t vertex_count) {
  v1::SkinningChunk wire;
  wire.set_total_sphere_count(static_cast<std::int32_t>(weights.sphere_count()));
  wire.set_total_vertex_count(static_cast<std::int64_t>(vertex_count));
  wire.set_sphere_count(static_cast<std::int32_t>(weights.sphere_count()));
  return wire;
}

template <typename Weights, typename Wire>
void RowsToWire(const Weights& weights, Wire& wire) {
  for (std::size_t s = 0; s < weights.sphere_count(); ++s) {
    wire.add_row_sizes(static_cast<std::int32_t>(weights.row_ends[s] - weights.RowBegin(s)));
  }
  wire.mutable_weights()->Add(weights.weights.begin(), weights.weights.end());
}

// Row ends and weights; `indices` are those of the wire, of which there must be as many.
template <typename Wire, typename Weights>
absl::Status RowsFromWire(const Wire& wire, std::size_t sphere_count, int indices,
                          Weights& weights) {
  if (static_cast<std::size_t>(wire.row_sizes_size()) != sphere_count) {
    return Bad("skinning.row_sizes",
               absl::StrCat("has ", wire.row_sizes_size(), " entries, must have ", sphere_count));
  }
  std::int64_t end = 0;
  for (int s = 0; s < wire.row_sizes_size(); ++s) {
    end += wire.row_sizes(s);
    if (wire.row_sizes(s) < 0 || end > wire.weights_size()) {
      return Bad(
          absl::StrCat("skinning.row_sizes[", s, "]"),
          absl::StrCat("is ", wire.row_sizes(s), ", beyond the ", wire.weights_size(), " weights"));
    }
    weights.row_ends.push_back(static_cast<std::uint32_t>(end));
  }
  if (end != wire.weights_size() || indices != wire.weights_size()) {
    return Bad("skinning.weights", absl::StrCat("has ", wire.weights_size(), " entries for ",
                                                indices, " indices in rows of ", end));
  }
  weights.weights.assign(wire.weights().begin(), wire.weights().end());
  return absl::OkStatus();
}

absl::StatusOr<skinning::SparseWeights> SparseFromWire(const v1::SkinningChunk& chunk,
                                                       std::size_t sphere_count) {
  const v1::SparseWeights& wire = chunk.sparse();
  skinning::SparseWeights weights;
  if (chunk.total_vertex_count() < 0) {
    return Bad("skinning.total_vertex_count", "must not be negative");
  }
  weights.vertex_count = static_cast<std::size_t>(chunk.total_vertex_count());
  CAPFIT_RETURN_IF_ERROR(RowsFromWire(wire, sphere_count, wire.vertex_steps_size(), weights));
  int i = 0;
  for (const std::uint32_t end : weights.row_ends) {
    std::int64_t vertex = 0;
    for (bool is_first = true; i < static_cast<int>(end); ++i, is_first = false) {
      const std::int64_t step = wire.vertex_steps(i);
      vertex += step;
      if (step < (is_first ? 0 : 1) || vertex >= chunk.total_vertex_count()) {
        return IndexOutOfRange(absl::StrCat("skinning.sparse.vertex_steps[", i, "]"), step,
                               chunk.total_vertex_count());
      }
      weights.vertices.push_back(static_cast<std::uint32_t>(vertex));
    }
  }
  return weights;
}

absl::StatusOr<skinning::BoneWeights> BonesFromWire(const v1::SkinningChunk& chunk,
                                                    std::size_t sphere_count,
                                                    std::size_t joint_count) {
  const v1::BoneWeights& wire = chunk.bones();
  skinning::BoneWeights weights;
  weights.joint_count = joint_count;
  CAPFIT_RETURN_IF_ERROR(RowsFromWire(wire, sphere_count, wire.joints_size(), weights));
  if (wire.offsets_size() != 3 * wire.joints_size()) {
    return Bad(
        "skinning.bones.offsets",
        absl::StrCat("has ", wire.offsets_size(), " numbers, must have ", 3 * wire.joints_size()));
  }
  for (int i = 0; i < wire.joints_size(); ++i) {
    if (wire.joints(i) < 0 || static_cast<std::size_t>(wire.joints(i)) >= joint_count) {
      return IndexOutOfRange(absl::StrCat("skinning.bones.joints[", i, "]"), wire.joints(i),
                             joint_count);
    }
    weights.joints.push_back(static_cast<std::uint16_t>(wire.joints(i)));
    weights.offsets.emplace_back(wire.offsets(3 * i), wire.offsets(3 * i + 1),
                                 wire.offsets(3 * i + 2));
  }
  return weights;
}

absl::StatusOr<formats::NamedJoint> JointFromWire(const v1::Joint& wire, int joint_count,
                                                  const std::string& field) {
  if (wire.to_mesh_size() != kPlacingNumbers) {
    return Bad(field + ".to_mesh",
               absl::StrCat("has ", wire.to_mesh_size(), " numbers, must have ", kPlacingNumbers));
  }
  if (wire.has_parent() && (wire.parent() < 0 || wire.parent() >= joint_count)) {
    return IndexOutOfRange(field + ".parent", wire.parent(), joint_count);
  }
  formats::NamedJoint joint;
  joint.name = wire.name();
  joint.human_bone = wire.human_bone();
  joint.parent = wire.has_parent() ? wire.parent() : -1;
  joint.node = wire.has_node() ? wire.node() : -1;
  for (int i = 0; i < kPlacingNumbers; ++i) joint.to_mesh(i / 4, i % 4) = wire.to_mesh(i);
  joint.position = joint.to_mesh.col(3);
  joint.bind = joint.to_mesh;
  return joint;
}

absl::Status CheckJoint(const std::string& field, int joint, std::size_t joint_count) {
  if (joint >= 0 && static_cast<std::size_t>(joint) < joint_count) return absl::OkStatus();
  return IndexOutOfRange(field + ".joint", joint, joint_count);
}

}  // namespace

std::optional<v1::SkinningChunk> FewWeightsToWire(const pipeline::FitResult& result) {
  if (result.sparse_weights) {
    const skinning::SparseWeights& weights = *result.sparse_weights;
    v1::SkinningChunk wire = ChunkOf(weights, weights.vertex_count);
    RowsToWire(weights, *wire.mutable_sparse());
    for (std::size_t s = 0; s < weights.sphere_count(); ++s) {
      std::uint32_t before = 0;
      for (std::size_t i = weights.RowBegin(s); i < weights.row_ends[s]; ++i) {
        const std::uint32_t step = weights.vertices[i] - before;
        wire.mutable_sparse()->add_vertex_steps(static_cast<std::int32_t>(step));
        before = weights.vertices[i];
      }
    }
    return wire;
  }
  if (!result.bone_weights) return std::nullopt;
  const skinning::BoneWeights& weights = *result.bone_weights;
  v1::SkinningChunk wire = ChunkOf(weights, static_cast<std::size_t>(result.body.vertex_count));
  RowsToWire(weights, *wire.mutable_bones());
  wire.mutable_bones()->mutable_joints()->Add(weights.joints.begin(), weights.joints.end());
  for (const Eigen::Vector3d& offset : weights.offsets) {
    for (const double number : offset) wire.mutable_bones()->add_offsets(number);
  }
  return wire;
}

absl::Status FewWeightsFromWire(const v1::SkinningChunk& wire, pipeline::FitResult& result) {
  const std::size_t sphere_count = result.primitives.spheres.size();
  if (wire.has_sparse()) {
    CAPFIT_ASSIGN_OR_RETURN(result.sparse_weights, SparseFromWire(wire, sphere_count));
    return absl::OkStatus();
  }
  if (wire.has_bones()) {
    CAPFIT_ASSIGN_OR_RETURN(result.bone_weights,
                            BonesFromWire(wire, sphere_count, result.joints.size()));
    return absl::OkStatus();
  }
  return Bad("skinning.weights", "is of an unknown form");
}

void JointsToWire(const pipeline::FitResult& result, v1::PrimitiveSet& wire) {
  for (const formats::NamedJoint& joint : result.joints) {
    v1::Joint& one = *wire.add_joints();
    one.set_name(PlainText(joint.name));
    if (joint.parent >= 0) one.set_parent(joint.parent);
    one.set_human_bone(PlainText(joint.human_bone));
    for (int i = 0; i < kPlacingNumbers; ++i) one.add_to_mesh(joint.to_mesh(i / 4, i % 4));
    if (joint.node >= 0) one.set_node(joint.node);
  }
  for (std::size_t i = 0; i < result.sphere_joints.size(); ++i) {
    v1::Sphere& sphere = *wire.mutable_spheres(static_cast<int>(i));
    sphere.set_joint(result.sphere_joints[i]);
    sphere.set_joint_drift_m(result.sphere_joint_drift_m[i]);
  }
  for (std::size_t i = 0; i < result.capsule_joints.size(); ++i) {
    wire.mutable_capsules(static_cast<int>(i))->set_joint(result.capsule_joints[i]);
  }
}

absl::Status JointsFromWire(const v1::PrimitiveSet& wire, pipeline::FitResult& result) {
  for (int i = 0; i < wire.joints_size(); ++i) {
    CAPFIT_ASSIGN_OR_RETURN(formats::NamedJoint joint,
                            JointFromWire(wire.joints(i), wire.joints_size(),
                                          absl::StrCat("primitives.joints[", i, "]")));
    result.joints.push_back(std::move(joint));
  }
  const bool is_hung = wire.spheres_size() > 0 && wire.spheres(0).has_joint();
  if (!is_hung) return absl::OkStatus();
  for (int i = 0; i < wire.spheres_size(); ++i) {
    CAPFIT_RETURN_IF_ERROR(CheckJoint(absl::StrCat("primitives.spheres[", i, "]"),
                                      wire.spheres(i).joint(), result.joints.size()));
    result.sphere_joints.push_back(wire.spheres(i).joint());
    result.sphere_joint_drift_m.push_back(wire.spheres(i).joint_drift_m());
  }
  for (int i = 0; i < wire.capsules_size(); ++i) {
    CAPFIT_RETURN_IF_ERROR(CheckJoint(absl::StrCat("primitives.capsules[", i, "]"),
                                      wire.capsules(i).joint(), result.joints.size()));
    result.capsule_joints.push_back(wire.capsules(i).joint());
  }
  return absl::OkStatus();
}

}  // namespace capfit::wire
