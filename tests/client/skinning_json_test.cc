#include "client/skinning_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "client/result_json.h"

namespace capfit::client {
namespace {

using nlohmann::json;
using testing::HasSubstr;

pipeline::FitResult Sample() {
  pipeline::FitResult result;
  for (int j = 0; j < 2; ++j) {
    formats::NamedJoint joint;
    joint.name = j == 0 ? "hips" : "spine";
    joint.parent = j - 1;
    joint.to_mesh.col(3) = Eigen::Vector3d(0.1, j, 1.0 / 3.0);
    result.joints.push_back(joint);
  }
  result.sphere_joints = {1, 0};
  result.sphere_joint_drift_m = {0.0, 0.02};
  result.capsule_joints = {1};
  result.sparse_weights = {9, {2, 3}, {4, 8, 0}, {0.1F, 0.9F, 1.0F}};
  result.bone_weights = {
      2, {2, 3}, {0, 1, 1}, {0.25F, 0.75F, 1.0F}, {{0.1, 2, 3}, {1.0 / 3.0, 5, 6}, {7, 8, 9}}};
  return result;
}

TEST(SkinningJson, WhatIsWrittenIsReadBitForBit) {
  const pipeline::FitResult sent = Sample();
  const auto got = ParseSkinning(FormatResult(sent));
  ASSERT_TRUE(got.ok()) << got.status();
  ASSERT_EQ(got->joints.size(), 2u);
  EXPECT_EQ(got->joints[1].name, "spine");
  EXPECT_EQ(got->joints[1].parent, 0);
  EXPECT_EQ(got->joints[0].parent, -1);
  EXPECT_EQ(got->joints[1].to_mesh, sent.joints[1].to_mesh);
  ASSERT_TRUE(got->sparse && got->bones);
  EXPECT_EQ(got->sparse->vertex_count, 9u);
  EXPECT_EQ(got->sparse->row_ends, sent.sparse_weights->row_ends);
  EXPECT_EQ(got->sparse->vertices, sent.sparse_weights->vertices);
  EXPECT_EQ(got->sparse->weights, sent.sparse_weights->weights);
  EXPECT_EQ(got->bones->joint_count, 2u);
  EXPECT_EQ(got->bones->row_ends, sent.bone_weights->row_ends);
  EXPECT_EQ(got->bones->joints, sent.bone_weights->joints);
  EXPECT_EQ(got->bones->weights, sent.bone_weights->weights);
  EXPECT_EQ(got->bones->offsets, sent.bone_weights->offsets);
}

TEST(SkinningJson, ResultsWithoutAnyHaveNoMembers) {
  const json root = json::parse(FormatResult({}));
  for (const char* const name : {"joints", "sphere_joints", "sphere_joint_drift_m",
                                 "capsule_joints", "sparse_weights", "bone_weights"}) {
    EXPECT_FALSE(root.contains(name)) << name;
  }
  const auto got = ParseSkinning(root.dump());
  ASSERT_TRUE(got.ok()) << got.status();
  EXPECT_FALSE(got->sparse || got->bones);
}

TEST(SkinningJson, NamesTheMemberThatIsWrong) {
  const auto error = [](const std::function<void(json&)>& breaking) {
    json root = json::parse(FormatResult(Sample()));
    breaking(root);
    return ParseSkinning(root.dump()).status().ToString();
  };
  EXPECT_THAT(ParseSkinning("[]").status().ToString(), HasSubstr("one JSON object"));
  EXPECT_THAT(error([](json& r) { r["joints"][1]["to_mesh"].erase(3); }),
              HasSubstr("joints[1].to_mesh has 11 entries, must have 12"));
  EXPECT_THAT(error([](json& r) { r["joints"][1]["parent"] = 2; }),
              HasSubstr("joints[1].parent must be a whole number below 2"));
  EXPECT_THAT(error([](json& r) { r["joints"][0] = 3; }), HasSubstr("joints[0].to_mesh"));
  EXPECT_THAT(error([](json& r) { r["sparse_weights"]["rows"][0]["vertices"][1] = 9; }),
              HasSubstr("sparse_weights.rows[0].vertices[1] must be a whole number below 9"));
  EXPECT_THAT(error([](json& r) { r["sparse_weights"]["rows"][0]["weights"].erase(0); }),
              HasSubstr("sparse_weights.rows[0].weights has 1 entries, must have 2"));
  EXPECT_THAT(error([](json& r) { r["sparse_weights"]["vertex_count"] = -1; }),
              HasSubstr("sparse_weights.vertex_count"));
  EXPECT_THAT(error([](json& r) { r["sparse_weights"] = 1; }), HasSubstr("sparse_weights.rows"));
  EXPECT_THAT(error([](json& r) { r["bone_weights"]["rows"][1]["joints"][0] = "x"; }),
              HasSubstr("bone_weights.rows[1].joints[0]"));
  EXPECT_THAT(error([](json& r) {
                r["bone_weights"]["rows"][1]["offsets"][0] = {1, 2};
              }),
              HasSubstr("bone_weights.rows[1].offsets[0] must be three numbers"));
  EXPECT_THAT(error([](json& r) { r["bone_weights"]["rows"][0]["weights"][0] = nullptr; }),
              HasSubstr("bone_weights.rows[0].weights[0] must be a finite number"));
}

}  // namespace
}  // namespace capfit::client
