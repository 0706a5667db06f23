#include "core/body/skeleton_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/body/find_body.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/core/body/body_files.h"

namespace capfit::body {
namespace {

constexpr std::array<LandmarkId, 7> kJoints = {
    LandmarkId::kLeftShoulder, LandmarkId::kLeftElbow, LandmarkId::kLeftWrist, LandmarkId::kLeftHip,
    LandmarkId::kLeftKnee,     LandmarkId::kLeftAnkle, LandmarkId::kNeck};

struct Rig {
  std::string name;
  std::vector<std::string> bones;  // those of kJoints, in order
  std::vector<std::string> others;
  friend void PrintTo(const Rig& r, std::ostream* os) { *os << r.name; }
};
class SkeletonNames : public testing::TestWithParam<Rig> {};

TEST_P(SkeletonNames, LeadToTheJoints) {
  std::vector<formats::NamedJoint> joints;
  double x = 1.0;
  for (const std::string& name : GetParam().others) joints.push_back({name, {-x++, 0, 0}});
  for (std::size_t i = 0; i < kJoints.size(); ++i) {
    joints.push_back({GetParam().bones[i], {static_cast<double>(i), 1, 0}});
  }
  const auto landmarks = LandmarksFromSkeleton(joints);
  EXPECT_EQ(landmarks.size(), kJoints.size());
  for (std::size_t i = 0; i < kJoints.size(); ++i) {
    ASSERT_TRUE(landmarks.contains(kJoints[i])) << GetParam().bones[i];
    EXPECT_EQ(landmarks.at(kJoints[i]), Eigen::Vector3d(static_cast<double>(i), 1, 0))
        << GetParam().bones[i];
  }
}

INSTANTIATE_TEST_SUITE_P(
    Rigs, SkeletonNames,
    testing::Values(
        Rig{"Mixamo",
            {"mixamorig:LeftArm", "mixamorig:LeftForeArm", "mixamorig:LeftHand",
             "mixamorig:LeftUpLeg", "mixamorig:LeftLeg", "mixamorig:LeftFoot", "mixamorig:Neck"},
            {"mixamorig:Hips", "mixamorig:Spine", "mixamorig:LeftShoulder",
             "mixamorig:LeftHandThumb1", "mixamorig:LeftToeBase", "mixamorig:HeadTop_End"}},
        Rig{"MixamoNumbered",
            {"mixamorig1LeftArm", "mixamorig1LeftForeArm", "mixamorig1LeftHand",
             "mixamorig1LeftUpLeg", "mixamorig1LeftLeg", "mixamorig1LeftFoot", "mixamorig1Neck"},
            {"mixamorig1LeftShoulder"}},
        Rig{"Vrm",
            {"leftUpperArm", "leftLowerArm", "leftHand", "leftUpperLeg", "leftLowerLeg", "leftFoot",
             "neck"},
            {"hips", "leftShoulder", "leftToes", "leftThumbProximal", "leftEye"}},
        Rig{"VRoid",
            {"J_Bip_L_UpperArm", "J_Bip_L_LowerArm", "J_Bip_L_Hand", "J_Bip_L_UpperLeg",
             "J_Bip_L_LowerLeg", "J_Bip_L_Foot", "J_Bip_C_Neck"},
            {"J_Bip_C_Hips", "J_Bip_L_Shoulder", "J_Sec_Hair1_01", "J_Bip_L_Index1"}},
        Rig{"VRChat",
            {"Left arm", "Left elbow", "Left wrist", "Left leg", "Left knee", "Left ankle", "Neck"},
            {"Hips", "Left shoulder", "Left toe", "IndexFinger1_L"}},
        Rig{"MakeHuman",
            {"upperarm01.L", "lowerarm01.L", "wrist.L", "upperleg01.L", "lowerleg01.L", "foot.L",
             "neck01"},
            {"root", "pelvis.L", "clavicle.L", "shoulder01.L", "upperarm02.L", "lowerarm02.L",
             "neck02", "lowerleg02.L", "finger1-1.L"}},
        Rig{"Smpl",
            {"L_Shoulder", "L_Elbow", "L_Wrist", "L_Hip", "L_Knee", "L_Ankle", "Neck"},
            {"Pelvis", "L_Collar", "L_Hand", "L_Foot", "Spine1"}},
        Rig{"SmplPrefixed",
            {"m_avg_L_Shoulder", "m_avg_L_Elbow", "m_avg_L_Wrist", "m_avg_L_Hip", "m_avg_L_Knee",
             "m_avg_L_Ankle", "m_avg_Neck"},
            {"m_avg_root", "m_avg_L_Collar", "m_avg_L_Hand"}},
        Rig{"SmplX",
            {"left_shoulder", "left_elbow", "left_wrist", "left_hip", "left_knee", "left_ankle",
             "neck"},
            {"pelvis", "left_collar", "left_foot", "left_index1"}},
        Rig{"Unreal",
            {"upperarm_l", "lowerarm_l", "hand_l", "thigh_l", "calf_l", "foot_l", "neck_01"},
            {"pelvis", "clavicle_l", "ball_l", "upperarm_twist_01_l", "neck_02"}},
        Rig{"Biped",
            {"Bip01 L UpperArm", "Bip01 L Forearm", "Bip01 L Hand", "Bip01 L Thigh", "Bip01 L Calf",
             "Bip01 L Foot", "Bip01 Neck"},
            {"Bip01 Pelvis", "Bip01 L Clavicle", "Bip01 L Toe0"}},
        Rig{"Rigify",
            {"DEF-upper_arm.L", "DEF-forearm.L", "DEF-hand.L", "DEF-thigh.L", "DEF-shin.L",
             "DEF-foot.L", "neck"},
            {"DEF-spine", "DEF-shoulder.L", "DEF-toe.L", "DEF-thumb.01.L"}}),
    [](const auto& tested) { return tested.param.name; });

TEST(SkeletonNames, TellLeftFromRightAndLeaveTheUnknownAlone) {
  const auto landmarks = LandmarksFromSkeleton(
      {{"RightForeArm", {1, 2, 3}}, {"LeftForeArm", {4, 5, 6}}, {"Tail", {7, 8, 9}}, {"", {}}});
  ASSERT_EQ(landmarks.size(), 2u);
  EXPECT_EQ(landmarks.at(LandmarkId::kRightElbow), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(landmarks.at(LandmarkId::kLeftElbow), Eigen::Vector3d(4, 5, 6));
}

TEST(Skeleton, ReplacesWhatWasMeasuredWhereItIsCredible) {
  mannequin::MannequinOptions made;
  made.faces = 4000;
  const auto prepared = mesh::PrepareMesh(*mannequin::MakeMannequin(made));
  const auto measured = Find(prepared->mesh);
  ASSERT_TRUE(measured.ok());
  const auto at = [&](LandmarkId id) {
    return measured->body_from_caller.Inverse().Apply(measured->landmark(id)->position_m);
  };
  const Eigen::Vector3d shift(0.01, 0.02, 0.0);
  BodyOptions options;
  options.skeleton = {{"mixamorig:LeftForeArm", at(LandmarkId::kLeftElbow) + shift},
                      {"mixamorig:RightLeg", at(LandmarkId::kRightHip)},  // not a knee's place
                      {"mixamorig:LeftFoot", 100.0 * at(LandmarkId::kLeftAnkle)},
                      {"mixamorig:LeftHand", at(LandmarkId::kLeftWrist) + shift}};
  options.landmarks[LandmarkId::kLeftWrist] = at(LandmarkId::kLeftWrist) - shift;
  const auto body = Find(prepared->mesh, options);
  ASSERT_TRUE(body.ok()) << body.status();
  EXPECT_EQ(body->landmark(LandmarkId::kLeftElbow)->method, LandmarkMethod::kSkeleton);
  EXPECT_EQ(body->landmark(LandmarkId::kLeftWrist)->method, LandmarkMethod::kCaller);
  EXPECT_EQ(body->landmark(LandmarkId::kRightKnee)->method, LandmarkMethod::kMeasured);
  EXPECT_EQ(body->landmark(LandmarkId::kLeftAnkle)->method, LandmarkMethod::kMeasured);
  EXPECT_EQ(std::count_if(body->warnings.begin(), body->warnings.end(),
                          [](const Warning& w) { return w.code == "SKELETON_IGNORED"; }),
            2);
  EXPECT_LE(
      (body->body_from_caller.Inverse().Apply(body->landmark(LandmarkId::kLeftWrist)->position_m) -
       options.landmarks[LandmarkId::kLeftWrist])
          .norm(),
      1e-9);
}

}  // namespace
}  // namespace capfit::body
