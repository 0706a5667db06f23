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

formats::NamedJoint Joint(const std::string& name, const Eigen::Vector3d& position) {
  formats::NamedJoint joint;
  joint.name = name;
  joint.position = position;
  return joint;
}

struct NamedRig {
  std::string name;
  std::vector<std::string> bones;  // those of kJoints, in order
  std::vector<std::string> others;
  friend void PrintTo(const NamedRig& r, std::ostream* os) { *os << r.name; }
};
class SkeletonNames : public testing::TestWithParam<NamedRig> {};

TEST_P(SkeletonNames, LeadToTheJoints) {
  std::vector<formats::NamedJoint> joints;
  double x = 1.0;
  for (const std::string& name : GetParam().others) joints.push_back(Joint(name, {-x++, 0, 0}));
  for (std::size_t i = 0; i < kJoints.size(); ++i) {
    joints.push_back(Joint(GetParam().bones[i], {static_cast<double>(i), 1, 0}));
  }
  const auto landmarks = ReadRig(joints).landmarks;
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
        NamedRig{
            "Mixamo",
            {"mixamorig:LeftArm", "mixamorig:LeftForeArm", "mixamorig:LeftHand",
             "mixamorig:LeftUpLeg", "mixamorig:LeftLeg", "mixamorig:LeftFoot", "mixamorig:Neck"},
            {"mixamorig:Hips", "mixamorig:Spine", "mixamorig:LeftShoulder",
             "mixamorig:LeftHandThumb1", "mixamorig:LeftToeBase", "mixamorig:HeadTop_End"}},
        NamedRig{
            "MixamoNumbered",
            {"mixamorig1LeftArm", "mixamorig1LeftForeArm", "mixamorig1LeftHand",
             "mixamorig1LeftUpLeg", "mixamorig1LeftLeg", "mixamorig1LeftFoot", "mixamorig1Neck"},
            {"mixamorig1LeftShoulder"}},
        NamedRig{"Vrm",
                 {"leftUpperArm", "leftLowerArm", "leftHand", "leftUpperLeg", "leftLowerLeg",
                  "leftFoot", "neck"},
                 {"hips", "leftShoulder", "leftToes", "leftThumbProximal", "leftEye"}},
        NamedRig{"VRoid",
                 {"J_Bip_L_UpperArm", "J_Bip_L_LowerArm", "J_Bip_L_Hand", "J_Bip_L_UpperLeg",
                  "J_Bip_L_LowerLeg", "J_Bip_L_Foot", "J_Bip_C_Neck"},
                 {"J_Bip_C_Hips", "J_Bip_L_Shoulder", "J_Sec_Hair1_01", "J_Bip_L_Index1"}},
        NamedRig{
            "VRChat",
            {"Left arm", "Left elbow", "Left wrist", "Left leg", "Left knee", "Left ankle", "Neck"},
            {"Hips", "Left shoulder", "Left toe", "IndexFinger1_L"}},
        NamedRig{"MakeHuman",
                 {"upperarm01.L", "lowerarm01.L", "wrist.L", "upperleg01.L", "lowerleg01.L",
                  "foot.L", "neck01"},
                 {"root", "pelvis.L", "clavicle.L", "shoulder01.L", "upperarm02.L", "lowerarm02.L",
                  "neck02", "lowerleg02.L", "finger1-1.L"}},
        NamedRig{"Smpl",
                 {"L_Shoulder", "L_Elbow", "L_Wrist", "L_Hip", "L_Knee", "L_Ankle", "Neck"},
                 {"Pelvis", "L_Collar", "L_Hand", "L_Foot", "Spine1"}},
        NamedRig{"SmplPrefixed",
                 {"m_avg_L_Shoulder", "m_avg_L_Elbow", "m_avg_L_Wrist", "m_avg_L_Hip",
                  "m_avg_L_Knee", "m_avg_L_Ankle", "m_avg_Neck"},
                 {"m_avg_root", "m_avg_L_Collar", "m_avg_L_Hand"}},
        NamedRig{"SmplX",
                 {"left_shoulder", "left_elbow", "left_wrist", "left_hip", "left_knee",
                  "left_ankle", "neck"},
                 {"pelvis", "left_collar", "left_foot", "left_index1"}},
        NamedRig{"Unreal",
                 {"upperarm_l", "lowerarm_l", "hand_l", "thigh_l", "calf_l", "foot_l", "neck_01"},
                 {"pelvis", "clavicle_l", "ball_l", "upperarm_twist_01_l", "neck_02"}},
        NamedRig{"Biped",
                 {"Bip01 L UpperArm", "Bip01 L Forearm", "Bip01 L Hand", "Bip01 L Thigh",
                  "Bip01 L Calf", "Bip01 L Foot", "Bip01 Neck"},
                 {"Bip01 Pelvis", "Bip01 L Clavicle", "Bip01 L Toe0"}},
        NamedRig{"MikuMikuDance",
                 {"左腕", "左ひじ", "左手首", "左足", "左ひざ", "左足首", "首"},
                 {"全ての親", "センター", "上半身", "上半身2", "左肩", "左肩P", "左腕捩", "左手捩",
                  "左足ＩＫ", "左足IK", "左ひざD", "左つま先", "左足先EX", "左目", "左親指１"}},
        NamedRig{"MikuMikuDanceInBlender",
                 {"腕.L", "肘.L", "手首.L", "足.L", "膝.L", "足首.L", "首"},
                 {"センター", "肩.L", "腕捩.L", "足ＩＫ.L", "足D.L", "首の飾り"}},
        NamedRig{"Rigify",
                 {"DEF-upper_arm.L", "DEF-forearm.L", "DEF-hand.L", "DEF-thigh.L", "DEF-shin.L",
                  "DEF-foot.L", "neck"},
                 {"DEF-spine", "DEF-shoulder.L", "DEF-toe.L", "DEF-thumb.01.L"}},
        NamedRig{"RigifyForGames",
                 {"DEF-upper_arm.L", "DEF-forearm.L", "DEF-hand.L", "DEF-thigh.L", "DEF-shin.L",
                  "DEF-foot.L", "DEF-spine.004"},
                 {"DEF-spine", "DEF-spine.003", "DEF-spine.006", "DEF-shoulder.L"}},
        NamedRig{
            "ReadyPlayerMe",
            {"LeftArm", "LeftForeArm", "LeftHand", "LeftUpLeg", "LeftLeg", "LeftFoot", "Neck"},
            {"Hips", "Spine", "Spine1", "Spine2", "LeftShoulder", "LeftToeBase", "LeftToe_End"}},
        NamedRig{
            "CharacterCreator",
            {"CC_Base_L_Upperarm", "CC_Base_L_Forearm", "CC_Base_L_Hand", "CC_Base_L_Thigh",
             "CC_Base_L_Calf", "CC_Base_L_Foot", "CC_Base_NeckTwist01"},
            {"CC_Base_Hip", "CC_Base_Pelvis", "CC_Base_L_Clavicle", "CC_Base_L_UpperarmTwist01",
             "CC_Base_L_ElbowShareBone", "CC_Base_L_KneeShareBone", "CC_Base_NeckTwist02"}},
        NamedRig{
            "Daz",
            {"lShldrBend", "lForearmBend", "lHand", "lThighBend", "lShin", "lFoot", "neckLower"},
            {"hip", "pelvis", "lCollar", "lShldrTwist", "lThighTwist", "neckUpper", "lToe"}},
        NamedRig{"NamedAfterItsCharacter",
                 {"Bob_LeftArm", "Bob_LeftForeArm", "Bob_LeftHand", "Bob_LeftUpLeg", "Bob_LeftLeg",
                  "Bob_LeftFoot", "Bob_Neck"},
                 {"Bob_Hips", "Bob_Spine", "Bob_LeftShoulder", "Camera"}},
        NamedRig{"NumberedByAConverter",
                 {"mixamorig:LeftArm_09", "mixamorig:LeftForeArm_010", "mixamorig:LeftHand_011",
                  "mixamorig:LeftUpLeg_055", "mixamorig:LeftLeg_056", "mixamorig:LeftFoot_057",
                  "mixamorig:Neck_04"},
                 {"mixamorig:Hips_01", "mixamorig:Spine1_02", "mixamorig:LeftShoulder_08",
                  "mixamorig:LeftHandThumb1_012"}}),
    [](const auto& tested) { return tested.param.name; });

TEST(SkeletonNames, TellLeftFromRightAndLeaveTheUnknownAlone) {
  const auto landmarks = ReadRig({Joint("RightForeArm", {1, 2, 3}), Joint("LeftForeArm", {4, 5, 6}),
                                  Joint("Tail", {7, 8, 9}), Joint("", Eigen::Vector3d::Zero())})
                             .landmarks;
  ASSERT_EQ(landmarks.size(), 2u);
  EXPECT_EQ(landmarks.at(LandmarkId::kRightElbow), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(landmarks.at(LandmarkId::kLeftElbow), Eigen::Vector3d(4, 5, 6));
}

// What the file says of a joint counts before its name, and names fill what it leaves open.
TEST(SkeletonNames, TheFilesOwnWordComesFirst) {
  std::vector<formats::NamedJoint> joints = {
      Joint("LeftForeArm", {1, 0, 0}), Joint("Knochen 7", {2, 0, 0}), Joint("LeftHand", {3, 0, 0}),
      Joint("Kopf", {4, 0, 0}), Joint("head", {5, 0, 0})};
  joints[1].human_bone = "leftLowerArm";
  joints[3].human_bone = "head";
  const Rig rig = ReadRig(joints);
  EXPECT_EQ(rig.at(LandmarkId::kLeftElbow), Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(rig.at(LandmarkId::kLeftWrist), Eigen::Vector3d(3, 0, 0));
  EXPECT_EQ(rig.head, Eigen::Vector3d(4, 0, 0));
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
  options.skeleton = {Joint("mixamorig:LeftForeArm", at(LandmarkId::kLeftElbow) + shift),
                      Joint("mixamorig:RightLeg", at(LandmarkId::kRightHip)),  // no knee's place
                      Joint("mixamorig:LeftFoot", 100.0 * at(LandmarkId::kLeftAnkle)),
                      Joint("mixamorig:LeftHand", at(LandmarkId::kLeftWrist) + shift)};
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
