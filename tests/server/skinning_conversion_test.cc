#include "proto/wire/skinning_conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "proto/wire/result_conversion.h"
#include "server/response_sequence.h"
#include "tests/server/fake_fit.h"

namespace capfit::wire {
namespace {

using testing::HasSubstr;

// A result whose spheres hang on three joints.
pipeline::FitResult Rigged() {
  pipeline::FitResult result = server::HandMadeResult();
  for (int j = 0; j < 3; ++j) {
    formats::NamedJoint joint;
    joint.name = "joint " + std::to_string(j);
    joint.parent = j - 1;
    joint.human_bone = j == 1 ? "spine" : "";
    joint.to_mesh.col(3) = Eigen::Vector3d(j, 0.1, 1.0 / 3.0);
    joint.position = joint.to_mesh.col(3);
    joint.node = 7 + j;
    result.joints.push_back(joint);
  }
  for (std::size_t i = 0; i < result.primitives.spheres.size(); ++i) {
    result.sphere_joints.push_back(static_cast<std::int32_t>(i % 3));
    result.sphere_joint_drift_m.push_back(0.001 * static_cast<double>(i));
  }
  for (std::size_t i = 0; i < result.primitives.capsules.size(); ++i) {
    result.capsule_joints.push_back(static_cast<std::int32_t>((i + 1) % 3));
  }
  return result;
}

pipeline::FitResult WithSparse() {
  pipeline::FitResult result = Rigged();
  skinning::SparseWeights& weights = result.sparse_weights.emplace();
  weights.vertex_count = 100;
  for (std::uint32_t s = 0; s < result.primitives.spheres.size(); ++s) {
    for (std::uint32_t k = 0; k <= s % 3; ++k) {
      weights.vertices.push_back(10 * s % 70 + k);
      weights.weights.push_back(1.0F / (1.0F + static_cast<float>(s + k)));
    }
    weights.row_ends.push_back(static_cast<std::uint32_t>(weights.vertices.size()));
  }
  return result;
}

pipeline::FitResult WithBones() {
  pipeline::FitResult result = Rigged();
  skinning::BoneWeights& weights = result.bone_weights.emplace();
  weights.joint_count = 3;
  for (std::uint32_t s = 0; s < result.primitives.spheres.size(); ++s) {
    weights.joints.insert(weights.joints.end(), {0, 2});
    weights.weights.insert(weights.weights.end(), {0.3F, 0.7F});
    weights.offsets.insert(weights.offsets.end(),
                           {Eigen::Vector3d(s, 1.0 / 3.0, 2), Eigen::Vector3d(0.1, -2, s)});
    weights.row_ends.push_back(2 * (s + 1));
  }
  return result;
}

// Over the wire and back.
absl::StatusOr<pipeline::FitResult> Back(const v1::ApproximateBodyUnaryResponse& wire) {
  pipeline::FitResult got;
  if (absl::Status status = PrimitivesFromWire(wire.primitives(), got); !status.ok()) return status;
  if (absl::Status status = FewWeightsFromWire(wire.skinning(), got); !status.ok()) return status;
  return got;
}

TEST(SkinningConversion, SparseWeightsAndJointsComeBackBitForBit) {
  const pipeline::FitResult sent = WithSparse();
  const auto got = Back(ResultToWire(sent, ""));
  ASSERT_TRUE(got.ok()) << got.status();
  ASSERT_TRUE(got->sparse_weights.has_value());
  EXPECT_EQ(got->sparse_weights->vertex_count, 100u);
  EXPECT_EQ(got->sparse_weights->row_ends, sent.sparse_weights->row_ends);
  EXPECT_EQ(got->sparse_weights->vertices, sent.sparse_weights->vertices);
  EXPECT_EQ(got->sparse_weights->weights, sent.sparse_weights->weights);
  ASSERT_EQ(got->joints.size(), 3u);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_EQ(got->joints[j].name, sent.joints[j].name);
    EXPECT_EQ(got->joints[j].parent, sent.joints[j].parent);
    EXPECT_EQ(got->joints[j].human_bone, sent.joints[j].human_bone);
    EXPECT_EQ(got->joints[j].to_mesh, sent.joints[j].to_mesh);
    EXPECT_EQ(got->joints[j].position, sent.joints[j].position);
    EXPECT_EQ(got->joints[j].node, sent.joints[j].node);
  }
  EXPECT_EQ(got->sphere_joints, sent.sphere_joints);
  EXPECT_EQ(got->sphere_joint_drift_m, sent.sphere_joint_drift_m);
  EXPECT_EQ(got->capsule_joints, sent.capsule_joints);
}

TEST(SkinningConversion, BoneWeightsComeBackBitForBit) {
  const pipeline::FitResult sent = WithBones();
  const auto got = Back(ResultToWire(sent, ""));
  ASSERT_TRUE(got.ok()) << got.status();
  ASSERT_TRUE(got->bone_weights.has_value());
  EXPECT_EQ(got->bone_weights->joint_count, 3u);
  EXPECT_EQ(got->bone_weights->row_ends, sent.bone_weights->row_ends);
  EXPECT_EQ(got->bone_weights->joints, sent.bone_weights->joints);
  EXPECT_EQ(got->bone_weights->weights, sent.bone_weights->weights);
  EXPECT_EQ(got->bone_weights->offsets, sent.bone_weights->offsets);
}

TEST(SkinningConversion, TheStreamBringsOneBlockBetweenPrimitivesAndSummary) {
  for (const pipeline::FitResult& result : {WithSparse(), WithBones()}) {
    server::ResponseSequence sequence(result, "");
    v1::ApproximateBodyResponse response;
    std::vector<int> parts;
    while (sequence.Next(response)) {
      parts.push_back(response.part_case());
      if (!response.has_skinning()) continue;
      EXPECT_EQ(response.skinning().SerializeAsString(),
                ResultToWire(result, "").skinning().SerializeAsString());
    }
    EXPECT_EQ(std::count(parts.begin(), parts.end(), v1::ApproximateBodyResponse::kSkinning), 1);
  }
}

TEST(SkinningConversion, WithoutEitherThereIsNoBlock) {
  EXPECT_FALSE(ResultToWire(Rigged(), "").has_skinning());
}

TEST(SkinningConversion, NamesWhatDoesNotFitTogether) {
  using Break = std::function<void(v1::ApproximateBodyUnaryResponse&)>;
  const auto error = [](const pipeline::FitResult& result, const Break& breaking) {
    v1::ApproximateBodyUnaryResponse wire = ResultToWire(result, "");
    breaking(wire);
    return Back(wire).status().ToString();
  };
  const auto of_sparse = [&](const std::function<void(v1::SparseWeights&)>& breaking) {
    return error(WithSparse(), [&](auto& w) { breaking(*w.mutable_skinning()->mutable_sparse()); });
  };
  const auto of_bones = [&](const std::function<void(v1::BoneWeights&)>& breaking) {
    return error(WithBones(), [&](auto& w) { breaking(*w.mutable_skinning()->mutable_bones()); });
  };
  EXPECT_THAT(of_sparse([](auto& w) { w.set_vertex_steps(0, 100); }),
              HasSubstr("sparse.vertex_steps[0]"));
  EXPECT_THAT(of_sparse([](auto& w) { w.set_vertex_steps(0, -1); }),
              HasSubstr("sparse.vertex_steps[0]"));
  EXPECT_THAT(of_sparse([](auto& w) { w.set_vertex_steps(2, 0); }), HasSubstr("vertex_steps[2]"));
  EXPECT_THAT(of_sparse([](auto& w) { w.add_weights(1); }), HasSubstr("skinning.weights"));
  EXPECT_THAT(of_sparse([](auto& w) { w.add_row_sizes(0); }), HasSubstr("row_sizes"));
  EXPECT_THAT(of_sparse([](auto& w) { w.set_row_sizes(0, -1); }), HasSubstr("row_sizes[0]"));
  EXPECT_THAT(of_sparse([](auto& w) { w.set_row_sizes(0, 1 << 30); }), HasSubstr("row_sizes[0]"));
  EXPECT_THAT(of_bones([](auto& w) { w.set_joints(1, 3); }), HasSubstr("bones.joints[1]"));
  EXPECT_THAT(of_bones([](auto& w) { w.add_offsets(1); }), HasSubstr("bones.offsets"));
  EXPECT_THAT(error(WithBones(), [](auto& w) { w.mutable_skinning()->clear_bones(); }),
              HasSubstr("unknown form"));
  EXPECT_THAT(
      error(WithBones(), [](auto& w) { w.mutable_primitives()->mutable_spheres(1)->set_joint(3); }),
      HasSubstr("spheres[1].joint"));
  EXPECT_THAT(error(WithBones(),
                    [](auto& w) { w.mutable_primitives()->mutable_capsules(0)->set_joint(-1); }),
              HasSubstr("capsules[0].joint"));
  EXPECT_THAT(
      error(WithBones(), [](auto& w) { w.mutable_primitives()->mutable_joints(2)->set_parent(3); }),
      HasSubstr("joints[2].parent"));
  EXPECT_THAT(error(WithBones(),
                    [](auto& w) { w.mutable_primitives()->mutable_joints(2)->add_to_mesh(3); }),
              HasSubstr("joints[2].to_mesh"));
}

}  // namespace
}  // namespace capfit::wire
