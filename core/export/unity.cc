#include "core/export/unity.h"

#include <Eigen/LU>
#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/export/ball_warnings.h"
#include "core/export/file_text.h"
#include "core/export/frame.h"
#include "core/export/joint_frame.h"
#include "core/export/json_text.h"
#include "core/export/solids.h"
#include "core/export/unity_script.h"

namespace capfit::exports {
namespace {

using UnityJson = nlohmann::ordered_json;

constexpr char kUnityAxis[] =
    "pairs are convex hulls of two spheres; capsules along +up, their start sphere at +up";
constexpr std::size_t kClothLimit = 32;
constexpr int kDirectionY = 1;

UnityJson Components(const Eigen::Vector3d& v) {
  return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}};
}

class UnityWriter {
 public:
  explicit UnityWriter(const ColliderSet& set) : upright_(Upright(set)) {
    for (const formats::NamedJoint& joint : upright_.joints) {
      bone_from_model_.push_back(BoneFromModel(joint));
    }
  }

  UnityJson Run() {
    UnityJson root = StatementJson(StatementOf(upright_, "capfit-unity", UnityFrame(), kUnityAxis));
    root["bones"] = Bones();
    root["spheres"] = Spheres();
    root["pairs"] = Pairs();
    root["loneSpheres"] = LoneSpheres(upright_);
    root["capsules"] = UnityJson::array();
    root["magicaSpheres"] = UnityJson::array();
    for (const Solid& solid : SolidsOf(upright_)) {
      if (solid.IsBall()) {
        root["magicaSpheres"].push_back(Ball(solid.name, solid.joint, solid.ball()));
      } else {
        root["capsules"].push_back(Capsule(solid));
      }
    }
    return root;
  }

 private:
  // A joint without an inverse (a scale of 0) takes the way without scale.
  Eigen::Affine3d BoneFromModel(const formats::NamedJoint& joint) const {
    Eigen::Affine3d model_from_bone = Eigen::Affine3d::Identity();
    model_from_bone.affine() = joint.to_mesh;
    const Eigen::FullPivLU<Eigen::Matrix3d> lu(model_from_bone.linear());
    if (lu.isInvertible()) return model_from_bone.inverse(Eigen::Affine);
    const auto index = static_cast<std::int32_t>(bone_from_model_.size());
    return Eigen::Affine3d(JointFrame(upright_, index).inverse());
  }

  static UnityJson Point(const Eigen::Vector3d& upright) {
    return Components(UnityFrame().Point(upright));
  }

  UnityJson BonePoint(std::int32_t joint, const Eigen::Vector3d& upright) const {
    if (joint < 0) return Point(upright);
    return Point(bone_from_model_[joint] * upright);
  }

  UnityJson BoneDirection(std::int32_t joint, const Eigen::Vector3d& upright) const {
    if (joint < 0) return Point(upright);
    return Point((bone_from_model_[joint].linear() * upright).normalized());
  }

  UnityJson Bones() const {
    UnityJson bones = UnityJson::array();
    for (const formats::NamedJoint& joint : upright_.joints) {
      bones.push_back(
          {{"name", joint.name}, {"parent", joint.parent}, {"position", Point(joint.position)}});
    }
    return bones;
  }

  UnityJson Ball(const std::string& name, std::int32_t joint, const geometry::Sphere& ball) const {
    return {{"name", name},
            {"bone", joint},
            {"position", Point(ball.center_m)},
            {"bonePosition", BonePoint(joint, ball.center_m)},
            {"radius", ball.radius_m}};
  }

  UnityJson Spheres() const {
    UnityJson spheres = UnityJson::array();
    for (std::size_t i = 0; i < upright_.sphere_count(); ++i) {
      const std::int32_t joint = upright_.sphere_joints.empty() ? -1 : upright_.sphere_joints[i];
      spheres.push_back(Ball(upright_.sphere_names[i], joint, upright_.primitives.spheres[i]));
    }
    return spheres;
  }

  UnityJson Pairs() const {
    const std::vector<std::string> names = CapsuleNames(upright_);
    UnityJson pairs = UnityJson::array();
    for (std::size_t k = 0; k < names.size(); ++k) {
      const capsule::CapsuleEnds& ends = upright_.primitives.capsules[k];
      pairs.push_back({{"name", names[k]}, {"first", ends[0]}, {"second", ends[1]}});
    }
    return pairs;
  }

  // Magica Cloth 2 measures from tip to tip and puts the middle of the tips at the centre.
  UnityJson Capsule(const Solid& solid) const {
    const geometry::Sphere& start = solid.hull.a();
    const geometry::Sphere& end = solid.hull.b();
    const Eigen::Vector3d up = -solid.hull.axis();
    const Eigen::Vector3d middle =
        0.5 * (start.center_m + end.center_m) + 0.5 * (start.radius_m - end.radius_m) * up;
    return {{"name", solid.name},
            {"bone", solid.joint},
            {"position", Point(middle)},
            {"bonePosition", BonePoint(solid.joint, middle)},
            {"up", Point(up)},
            {"boneUp", BoneDirection(solid.joint, up)},
            {"startRadius", start.radius_m},
            {"endRadius", end.radius_m},
            {"length", solid.hull.length_m() + start.radius_m + end.radius_m},
            {"direction", kDirectionY},
            {"reverseDirection", false},
            {"alignedOnCenter", true},
            {"radiusSeparation", true}};
  }

  const ColliderSet upright_;
  std::vector<Eigen::Affine3d> bone_from_model_;
};

void WarnOfClothLimit(const std::string& what, std::size_t count, std::vector<Warning>& warnings) {
  if (count <= kClothLimit) return;
  warnings.push_back({"COLLIDER_LIMIT",
                      absl::StrCat(count, " ", what, ", but Unity Cloth takes ", kClothLimit,
                                   " and ignores the rest: fit again with engine unity_cloth"),
                      static_cast<std::int64_t>(count)});
}

}  // namespace

Exported WriteUnity(const ColliderSet& set) {
  const std::string script = absl::StrCat(
      "// Colliders of a body on the bones of its character.\n//\n",
      StatementLines(StatementOf(set, "capfit-unity", UnityFrame(), kUnityAxis), "//   ", ""));
  Exported exported;
  exported.files = {{"unity_colliders.json", JsonText(UnityWriter(set).Run())},
                    {"CapfitColliders.cs", script + std::string(UnityScript())}};
  WarnOfClothLimit("spheres", set.sphere_count(), exported.warnings);
  WarnOfClothLimit("pairs", set.capsule_count(), exported.warnings);
  Append(BallWarnings(SolidsOf(set), "Magica Cloth 2"), exported.warnings);
  return exported;
}

}  // namespace capfit::exports
