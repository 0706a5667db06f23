// Avatars with a skeleton: a GLB of the built-in mannequin as each program writes it, through the
// reader and the whole fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "core/formats/read_mesh.h"
#include "core/mannequin/mannequin.h"
#include "core/pipeline/fit.h"
#include "tests/core/pipeline/glb_bytes.h"

namespace capfit::pipeline {
namespace {

using body::LandmarkId;
using body::LandmarkMethod;
using Eigen::Affine3d;
using Eigen::Vector3d;
using nlohmann::json;

// Those that a skeleton gives, the left of each pair.
constexpr std::array<LandmarkId, 7> kRigLandmarks = {
    LandmarkId::kNeck,    LandmarkId::kLeftShoulder, LandmarkId::kLeftElbow, LandmarkId::kLeftWrist,
    LandmarkId::kLeftHip, LandmarkId::kLeftKnee,     LandmarkId::kLeftAnkle};

struct Bone {
  std::string name;
  Vector3d at = Vector3d::Zero();  // in the mannequin's frame: metres, Y up
};

// How a program names bones and how it stores and places mesh and skeleton.
struct AvatarStyle {
  std::string name;
  std::vector<std::string> left;   // those of kRigLandmarks, in order
  std::vector<std::string> right;  // without the neck
  std::vector<std::string> more;   // bones that say nothing
  double stored_per_metre = 1.0;
  bool z_up = false;          // as stored; the armature's node turns it up
  double facing_rad = 0.0;    // the scene's root turns the body about the vertical
  bool turned_bones = false;  // each bone has axes of its own
  friend void PrintTo(const AvatarStyle& s, std::ostream* os) { *os << s.name; }
};

std::vector<AvatarStyle> Styles() {
  return {{"Mixamo",
           {"mixamorig:Neck", "mixamorig:LeftArm", "mixamorig:LeftForeArm", "mixamorig:LeftHand",
            "mixamorig:LeftUpLeg", "mixamorig:LeftLeg", "mixamorig:LeftFoot"},
           {"mixamorig:RightArm", "mixamorig:RightForeArm", "mixamorig:RightHand",
            "mixamorig:RightUpLeg", "mixamorig:RightLeg", "mixamorig:RightFoot"},
           {"mixamorig:Hips", "mixamorig:Spine", "mixamorig:LeftShoulder", "mixamorig:LeftToeBase"},
           100.0,
           true,
           0.0,
           true},
          {"Vrm",
           {"J_Bip_C_Neck", "J_Bip_L_UpperArm", "J_Bip_L_LowerArm", "J_Bip_L_Hand",
            "J_Bip_L_UpperLeg", "J_Bip_L_LowerLeg", "J_Bip_L_Foot"},
           {"J_Bip_R_UpperArm", "J_Bip_R_LowerArm", "J_Bip_R_Hand", "J_Bip_R_UpperLeg",
            "J_Bip_R_LowerLeg", "J_Bip_R_Foot"},
           {"Root", "J_Bip_C_Hips", "J_Bip_L_Shoulder", "J_Sec_Hair1_01"},
           1.0,
           false,
           std::numbers::pi,
           false},
          {"MakeHuman",
           {"neck01", "upperarm01.L", "lowerarm01.L", "wrist.L", "upperleg01.L", "lowerleg01.L",
            "foot.L"},
           {"upperarm01.R", "lowerarm01.R", "wrist.R", "upperleg01.R", "lowerleg01.R", "foot.R"},
           {"root", "spine05", "clavicle.L", "upperarm02.L", "lowerleg02.R", "finger1-1.L"},
           10.0,
           true,
           0.5 * std::numbers::pi,
           true},
          {"Smpl",
           {"Neck", "L_Shoulder", "L_Elbow", "L_Wrist", "L_Hip", "L_Knee", "L_Ankle"},
           {"R_Shoulder", "R_Elbow", "R_Wrist", "R_Hip", "R_Knee", "R_Ankle"},
           {"Pelvis", "Spine1", "L_Collar", "L_Hand", "L_Foot", "Head"},
           1.0,
           false,
           0.7,
           true}};
}

// The mannequin and where its joints are, both in its own frame.
struct Model {
  formats::PolygonSoup soup;
  std::map<LandmarkId, Vector3d> measured;
};

FitResult FitOf(const formats::PolygonSoup& soup) {
  const ThreadPool pool(1);
  NullObserver observer;
  FitOptions options;
  options.max_primitives = 32;
  auto result = Fit(soup, options, pool, observer);
  EXPECT_TRUE(result.ok()) << result.status();
  return result.ok() ? *std::move(result) : FitResult();
}

const LandmarkResult* FindLandmark(const FitResult& result, LandmarkId id) {
  const auto found = std::find_if(
      result.landmarks.begin(), result.landmarks.end(),
      [&](const LandmarkResult& l) { return l.name == std::string(body::LandmarkName(id)); });
  return found == result.landmarks.end() ? nullptr : &*found;
}

const Model& TheModel() {
  static const Model& kModel = *[] {
    auto* const model = new Model;
    mannequin::MannequinOptions options;
    options.faces = 3000;
    options.quads = false;
    model->soup = *mannequin::MakeMannequin(options);
    const FitResult result = FitOf(model->soup);
    for (const LandmarkId left : kRigLandmarks) {
      for (const LandmarkId id : {left, body::MirrorLandmark(left)}) {
        model->measured[id] = FindLandmark(result, id)->position;
      }
    }
    return model;
  }();
  return kModel;
}

// A rigger sets joints by eye: a centimetre higher and half a centimetre farther back.
const Vector3d kByEye(0.0, 0.01, -0.005);

std::vector<Bone> BonesOf(const AvatarStyle& style) {
  const Model& model = TheModel();
  std::vector<Bone> bones;
  for (const std::string& name : style.more) bones.push_back({name, Vector3d(0.0, 0.9, 0.0)});
  for (std::size_t i = 0; i < kRigLandmarks.size(); ++i) {
    bones.push_back({style.left[i], model.measured.at(kRigLandmarks[i]) + kByEye});
    if (i == 0) continue;
    const LandmarkId right = body::MirrorLandmark(kRigLandmarks[i]);
    bones.push_back({style.right[i - 1], model.measured.at(right) + kByEye});
  }
  return bones;
}

json MatrixJson(const Affine3d& transform) {
  const Eigen::Matrix4d& m = transform.matrix();
  return std::vector<double>(m.data(), m.data() + 16);
}

// Nodes: 0 the scene's root, 1 the armature, 2 the skinned mesh, 3 and on the bones, each a child
// of the one before.
class AvatarFile {
 public:
  AvatarFile(const AvatarStyle& style, const std::vector<Bone>& bones)
      : style_(style), bones_(bones) {
    stored_from_model_.scale(style.stored_per_metre);
    if (style.z_up) {
      stored_from_model_.rotate(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX()));
    }
    world_from_model_.rotate(Eigen::AngleAxisd(style.facing_rad, Vector3d::UnitY()));
  }

  [[nodiscard]] const Affine3d& world_from_model() const { return world_from_model_; }

  std::string Bytes() {
    AddMesh();
    AddSkeleton();
    gltf_["asset"]["version"] = "2.0";
    gltf_["scene"] = 0;
    gltf_["scenes"] = {{{"nodes", {0}}}};
    gltf_["nodes"][0] = {
        {"name", "Scene root"}, {"matrix", MatrixJson(world_from_model_)}, {"children", {1}}};
    gltf_["nodes"][1] = {{"name", "Armature"},
                         {"matrix", MatrixJson(stored_from_model_.inverse())},
                         {"children", {2, 3}}};
    // A skinned mesh follows its bones: where its node stands must not count.
    gltf_["nodes"][2] = {{"name", "Body"}, {"mesh", 0}, {"skin", 0}, {"translation", {7, 8, 9}}};
    gltf_["buffers"] = {{{"byteLength", binary_.size()}}};
    return GlbBytes(gltf_, binary_);
  }

 private:
  void AddView(const std::string& bytes, int component_type, std::size_t count, const char* type) {
    gltf_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
    gltf_["accessors"].push_back({{"bufferView", gltf_["bufferViews"].size() - 1},
                                  {"componentType", component_type},
                                  {"count", count},
                                  {"type", type}});
    binary_ += bytes;
  }

  void AddMesh() {
    const formats::PolygonSoup& soup = TheModel().soup;
    std::string positions;
    for (const Vector3d& p : soup.positions) {
      const Vector3d stored = stored_from_model_ * p;
      for (const double x : stored) AppendValue(static_cast<float>(x), positions);
    }
    std::string indices;
    for (const std::uint32_t v : soup.face_vertices) AppendValue(v, indices);
    AddView(positions, 5126, soup.positions.size(), "VEC3");
    AddView(indices, 5125, soup.face_vertices.size(), "SCALAR");
    gltf_["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
  }

  void AddSkeleton() {
    std::string inverse_binds;
    Affine3d parent = Affine3d::Identity();
    for (std::size_t i = 0; i < bones_.size(); ++i) {
      Affine3d in_armature = Affine3d::Identity();
      in_armature.translate(Vector3d(stored_from_model_ * bones_[i].at));
      if (style_.turned_bones) {
        in_armature.rotate(
            Eigen::AngleAxisd(0.3 + static_cast<double>(i), Vector3d(1, 2, 3).normalized()));
      }
      json& node = gltf_["nodes"][3 + i];
      node = {{"name", bones_[i].name}, {"matrix", MatrixJson(parent.inverse() * in_armature)}};
      if (i + 1 < bones_.size()) node["children"] = {4 + i};
      gltf_["skins"][0]["joints"].push_back(3 + i);
      const Eigen::Matrix4d inverse_bind = in_armature.inverse().matrix();
      for (int k = 0; k < 16; ++k) {
        AppendValue(static_cast<float>(inverse_bind(k % 4, k / 4)), inverse_binds);
      }
      parent = in_armature;
    }
    AddView(inverse_binds, 5126, bones_.size(), "MAT4");
    gltf_["skins"][0]["inverseBindMatrices"] = 2;
  }

  const AvatarStyle& style_;
  const std::vector<Bone>& bones_;
  Affine3d stored_from_model_ = Affine3d::Identity();
  Affine3d world_from_model_ = Affine3d::Identity();
  std::string binary_;
  json gltf_;
};

formats::PolygonSoup ReadAvatar(const std::string& bytes) {
  auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)));
  EXPECT_TRUE(soup.ok()) << soup.status();
  return soup.ok() ? *std::move(soup) : formats::PolygonSoup();
}

std::int64_t IgnoredBones(const FitResult& result) {
  return std::count_if(result.warnings.begin(), result.warnings.end(),
                       [](const Warning& w) { return w.code == "SKELETON_IGNORED"; });
}

class SkinnedGlb : public testing::TestWithParam<AvatarStyle> {};

TEST_P(SkinnedGlb, LandmarksFollowItsBones) {
  const std::vector<Bone> bones = BonesOf(GetParam());
  AvatarFile file(GetParam(), bones);
  const FitResult result = FitOf(ReadAvatar(file.Bytes()));
  EXPECT_EQ(IgnoredBones(result), 0);
  for (const LandmarkId left : kRigLandmarks) {
    for (const LandmarkId id : {left, body::MirrorLandmark(left)}) {
      const LandmarkResult* const landmark = FindLandmark(result, id);
      ASSERT_NE(landmark, nullptr) << body::LandmarkName(id);
      EXPECT_EQ(landmark->method, LandmarkMethod::kSkeleton) << landmark->name;
      const Vector3d wanted = file.world_from_model() * (TheModel().measured.at(id) + kByEye);
      EXPECT_LE((landmark->position - wanted).norm(), 1e-4) << landmark->name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Styles, SkinnedGlb, testing::ValuesIn(Styles()),
                         [](const auto& tested) { return tested.param.name; });

// Bones that contradict the surface do not count; each of them is told of.
struct BadSkeleton {
  std::string name;
  std::function<void(std::vector<Bone>& bones)> spoil;
  std::vector<LandmarkId> from_bones;  // landmarks that still come from it
  std::int64_t least_ignored = 0;
  friend void PrintTo(const BadSkeleton& s, std::ostream* os) { *os << s.name; }
};

std::vector<LandmarkId> Sides(bool left, bool right) {
  std::vector<LandmarkId> ids;
  for (const LandmarkId id : kRigLandmarks) {
    if (id == LandmarkId::kNeck) continue;
    if (left) ids.push_back(id);
    if (right) ids.push_back(body::MirrorLandmark(id));
  }
  return ids;
}

bool IsRight(const Bone& bone) { return bone.name.find("R_") == 0; }

std::vector<BadSkeleton> BadSkeletons() {
  const auto move_all = [](const Vector3d& by, double factor) {
    return [=](std::vector<Bone>& bones) {
      for (Bone& bone : bones) bone.at = factor * bone.at + by;
    };
  };
  return {{"OutsideTheBody", move_all(Vector3d(5.0, 0.0, 0.0), 1.0), {}, 13},
          {"InAnotherUnit", move_all(Vector3d::Zero(), 100.0), {}, 13},
          {"AllInOnePlace", move_all(Vector3d(0.0, 1.2, 0.0), 0.0), {}, 13},
          {"RightHalfMissing",
           [](std::vector<Bone>& bones) {
             bones.erase(std::remove_if(bones.begin(), bones.end(), IsRight), bones.end());
           },
           Sides(true, false), 0},
          {"RightHalfElsewhere",
           [](std::vector<Bone>& bones) {
             for (Bone& bone : bones) {
               if (IsRight(bone)) bone.at += Vector3d(0.0, 0.8, 0.6);
             }
           },
           Sides(true, false), 6},
          {"NamesRepeated",
           [](std::vector<Bone>& bones) {
             const std::vector<Bone> first = bones;
             for (Bone bone : first) bones.push_back({bone.name, Vector3d(0.0, 0.0, 3.0)});
           },
           Sides(true, true), 0}};
}

class BadSkinnedGlb : public testing::TestWithParam<BadSkeleton> {};

TEST_P(BadSkinnedGlb, TheSurfaceTakesOver) {
  const AvatarStyle style = Styles().back();
  std::vector<Bone> bones = BonesOf(style);
  GetParam().spoil(bones);
  AvatarFile file(style, bones);
  const FitResult result = FitOf(ReadAvatar(file.Bytes()));
  EXPECT_GE(IgnoredBones(result), GetParam().least_ignored);
  for (const LandmarkId id : Sides(true, true)) {
    const LandmarkResult* const landmark = FindLandmark(result, id);
    ASSERT_NE(landmark, nullptr) << body::LandmarkName(id);
    const bool is_from_bones = std::find(GetParam().from_bones.begin(), GetParam().from_bones.end(),
                                         id) != GetParam().from_bones.end();
    EXPECT_EQ(landmark->method == LandmarkMethod::kSkeleton, is_from_bones) << landmark->name;
    const Vector3d wanted = file.world_from_model() * TheModel().measured.at(id);
    EXPECT_LE((landmark->position - wanted).norm(), 0.02) << landmark->name;
  }
}

INSTANTIATE_TEST_SUITE_P(Spoilt, BadSkinnedGlb, testing::ValuesIn(BadSkeletons()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace capfit::pipeline
