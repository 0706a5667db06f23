// Joints, sparse weights and bone weights as members of RESULT.json (docs/result.schema.json), both
// ways.
#ifndef CAPFIT_CLIENT_SKINNING_JSON_H_
#define CAPFIT_CLIENT_SKINNING_JSON_H_

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/formats/polygon_soup.h"
#include "core/pipeline/fit.h"

namespace capfit::client {

// Adds "joints", "sphere_joints", "sphere_joint_drift_m" and "capsule_joints" where the mesh came
// with a skeleton, "sparse_weights" or "bone_weights" where they were asked for.
void AddSkinning(const pipeline::FitResult& result, nlohmann::ordered_json& root);

// What carries the spheres of a RESULT.json, as far as the file itself has it.
struct ResultSkinning {
  std::vector<formats::NamedJoint> joints;
  // Of each sphere and capsule the joint that it hangs on; empty where the file does not say.
  std::vector<std::int32_t> sphere_joints;
  std::vector<std::int32_t> capsule_joints;
  std::optional<skinning::SparseWeights> sparse;
  std::optional<skinning::BoneWeights> bones;
};

// INVALID_ARGUMENT names the member that is missing, of the wrong kind or out of range.
[[nodiscard]] absl::StatusOr<ResultSkinning> ParseSkinning(const std::string& result_text);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_SKINNING_JSON_H_
