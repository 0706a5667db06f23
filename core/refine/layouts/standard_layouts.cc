#include "core/refine/layouts/standard_layouts.h"

#include <algorithm>
#include <array>

namespace capfit::refine {
namespace {

using body::Part;

struct Row {
  const char* name;
  Part part;
  int mirror;
  BoneId bone;
  Side side;
  BonePlace place;
  double radius;
};

// Made by maker/make_standard_layout.cc.
constexpr auto kStandard32Spheres = std::to_array<Row>({
    {"chest_left_1", Part::kTorso, 1, BoneId::kRibs, Side::kLeft, {1.03, 0.79, 0.79}, 0.75},    // 0
    {"chest_right_1", Part::kTorso, 0, BoneId::kRibs, Side::kLeft, {1.03, -0.79, 0.79}, 0.75},  // 1
    {"chest_left_2", Part::kTorso, 3, BoneId::kChest, Side::kLeft, {0.24, 0.54, -0.13}, 1.47},  // 2
    {"chest_right_2",
     Part::kTorso,
     2,
     BoneId::kChest,
     Side::kLeft,
     {0.24, -0.54, -0.13},
     1.47},                                                                               // 3
    {"neck_1", Part::kTorso, 4, BoneId::kChest, Side::kLeft, {0.98, 0.00, -0.07}, 1.19},  // 4
    {"neck_2", Part::kTorso, 5, BoneId::kChest, Side::kLeft, {2.50, 0.00, 1.24}, 1.20},   // 5
    {"pelvis_left_1",
     Part::kTorso,
     7,
     BoneId::kPelvis,
     Side::kLeft,
     {0.69, 0.48, 0.12},
     1.85},  // 6
    {"pelvis_right_1",
     Part::kTorso,
     6,
     BoneId::kPelvis,
     Side::kRight,
     {0.69, 0.48, 0.12},
     1.86},                                                                                   // 7
    {"shoulder_1", Part::kTorso, 8, BoneId::kChest, Side::kLeft, {0.47, 0.00, -0.28}, 1.41},  // 8
    {"shoulder_left_1",
     Part::kTorso,
     10,
     BoneId::kClavicle,
     Side::kLeft,
     {0.39, -0.21, -0.22},
     1.32},  // 9
    {"shoulder_right_1",
     Part::kTorso,
     9,
     BoneId::kClavicle,
     Side::kRight,
     {0.39, -0.21, -0.22},
     1.33},  // 10
    {"waist_left_1",
     Part::kTorso,
     12,
     BoneId::kBelly,
     Side::kLeft,
     {0.93, 0.42, 0.09},
     0.98},  // 11
    {"waist_right_1",
     Part::kTorso,
     11,
     BoneId::kBelly,
     Side::kLeft,
     {0.93, -0.42, 0.09},
     0.98},                                                                             // 12
    {"head_1", Part::kHead, 13, BoneId::kHead, Side::kLeft, {0.60, 0.00, 0.11}, 1.90},  // 13
    {"left_upper_arm_1",
     Part::kLeftArm,
     15,
     BoneId::kUpperArm,
     Side::kLeft,
     {-0.60, -0.08, -0.02},
     1.59},  // 14
    {"right_upper_arm_1",
     Part::kRightArm,
     14,
     BoneId::kUpperArm,
     Side::kRight,
     {-0.59, -0.08, -0.02},
     1.58},  // 15
    {"left_upper_arm_2",
     Part::kLeftArm,
     17,
     BoneId::kUpperArm,
     Side::kLeft,
     {0.93, -0.03, -0.04},
     0.92},  // 16
    {"right_upper_arm_2",
     Part::kRightArm,
     16,
     BoneId::kUpperArm,
     Side::kRight,
     {0.93, -0.03, -0.04},
     0.91},  // 17
    {"left_hand_1",
     Part::kLeftHand,
     19,
     BoneId::kHand,
     Side::kLeft,
     {0.19, -0.04, -0.15},
     1.20},  // 18
    {"right_hand_1",
     Part::kRightHand,
     18,
     BoneId::kHand,
     Side::kRight,
     {0.19, -0.04, -0.15},
     1.20},  // 19
    {"left_hand_2",
     Part::kLeftHand,
     21,
     BoneId::kHand,
     Side::kLeft,
     {0.72, -0.35, 0.71},
     2.25},  // 20
    {"right_hand_2",
     Part::kRightHand,
     20,
     BoneId::kHand,
     Side::kRight,
     {0.72, -0.35, 0.71},
     2.25},  // 21
    {"left_calf_1",
     Part::kLeftLeg,
     23,
     BoneId::kShin,
     Side::kLeft,
     {0.28, 0.00, -0.21},
     0.99},  // 22
    {"right_calf_1",
     Part::kRightLeg,
     22,
     BoneId::kShin,
     Side::kRight,
     {0.28, 0.00, -0.21},
     0.99},  // 23
    {"left_thigh_1",
     Part::kLeftLeg,
     25,
     BoneId::kThigh,
     Side::kLeft,
     {0.27, -0.20, 0.27},
     1.45},  // 24
    {"right_thigh_1",
     Part::kRightLeg,
     24,
     BoneId::kThigh,
     Side::kRight,
     {0.27, -0.20, 0.27},
     1.45},  // 25
    {"left_thigh_2",
     Part::kLeftLeg,
     27,
     BoneId::kThigh,
     Side::kLeft,
     {0.95, 0.02, 0.06},
     0.96},  // 26
    {"right_thigh_2",
     Part::kRightLeg,
     26,
     BoneId::kThigh,
     Side::kRight,
     {0.95, 0.02, 0.06},
     0.96},  // 27
    {"left_foot_1",
     Part::kLeftFoot,
     29,
     BoneId::kHeel,
     Side::kLeft,
     {0.42, 0.01, -0.94},
     2.09},  // 28
    {"right_foot_1",
     Part::kRightFoot,
     28,
     BoneId::kHeel,
     Side::kRight,
     {0.42, 0.01, -0.95},
     2.10},  // 29
    {"left_foot_2",
     Part::kLeftFoot,
     31,
     BoneId::kFoot,
     Side::kLeft,
     {0.89, 0.01, 0.38},
     1.68},  // 30
    {"right_foot_2",
     Part::kRightFoot,
     30,
     BoneId::kFoot,
     Side::kRight,
     {0.89, 0.01, 0.38},
     1.68},  // 31
});
constexpr auto kStandard32Capsules = std::to_array<capsule::CapsuleEnds>({
    {0, 2},   {1, 3},   {2, 9},   {2, 11},  {2, 14},  {3, 10},  {3, 12},  {3, 15},
    {4, 14},  {4, 15},  {5, 13},  {6, 7},   {6, 11},  {6, 12},  {6, 24},  {7, 11},
    {7, 12},  {7, 25},  {14, 16}, {15, 17}, {16, 18}, {17, 19}, {18, 20}, {19, 21},
    {22, 26}, {22, 28}, {23, 27}, {23, 29}, {24, 26}, {25, 27}, {28, 30}, {29, 31},
});

KeptLayout Make(const char* name, std::span<const Row> rows,
                std::span<const capsule::CapsuleEnds> capsules) {
  KeptLayout layout;
  layout.name = name;
  for (const Row& row : rows) {
    layout.spheres.push_back(
        {row.name, row.part, row.mirror, BodyPlace{row.bone, row.side, row.place, row.radius}});
  }
  layout.capsules.assign(capsules.begin(), capsules.end());
  return layout;
}

}  // namespace

std::span<const KeptLayout> StandardLayouts() {
  static const std::array<KeptLayout, 1> layouts = {
      Make("standard-32", kStandard32Spheres, kStandard32Capsules)};
  return layouts;
}

const KeptLayout* FindStandardLayout(std::string_view name) {
  for (const KeptLayout& layout : StandardLayouts()) {
    if (layout.name == name) return &layout;
  }
  return nullptr;
}

std::string StandardLayoutNames() {
  std::string names;
  for (const KeptLayout& layout : StandardLayouts()) {
    names += (names.empty() ? "" : ", ") + layout.name;
  }
  return names;
}

}  // namespace capfit::refine
