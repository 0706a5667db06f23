#include <array>

#include "core/refine/layout.h"

namespace capfit::refine {
namespace {

// Rough on purpose: places to a twentieth of a bone's length and a tenth of its radius. What counts
// is the topology; everything else is optimised for each body.

// About 16 + 16 without head, hands and feet: one chain for each limb; pelvis and chest in pairs,
// the belly between them single.
constexpr auto kPlainNodes = std::to_array<LayoutNode>({
    {BoneId::kPelvis, {0.85, 0.0, 0.0}, 1.1, true},      // 0
    {BoneId::kBelly, {1.75, 0.0, 1.3}, 1.4, false},      // 1
    {BoneId::kShin, {0.75, 0.3, -0.4}, 0.6, true},       // 2
    {BoneId::kChest, {0.70, 0.0, 0.0}, 1.4, false},      // 3
    {BoneId::kThigh, {0.45, -0.1, 0.5}, 1.3, true},      // 4
    {BoneId::kForearm, {0.00, -0.1, 0.0}, 1.0, true},    // 5
    {BoneId::kClavicle, {1.10, -0.1, -0.2}, 0.9, true},  // 6
    {BoneId::kClavicle, {0.45, -1.2, 0.4}, 1.7, true},   // 7
    {BoneId::kForearm, {0.85, 0.0, -0.1}, 0.7, true},    // 8
});
constexpr auto kPlainEdges = std::to_array<LayoutEdge>({{0, 0, true},
                                                        {0, 1, false},
                                                        {0, 4, false},
                                                        {1, 3, false},
                                                        {1, 7, false},
                                                        {2, 4, false},
                                                        {3, 6, false},
                                                        {5, 6, false},
                                                        {5, 8, false}});

// About 16 + 16 with head, hands and feet, each the end of a chain.
constexpr auto kPlainFullNodes = std::to_array<LayoutNode>({
    {BoneId::kHead, {0.05, 0.0, 0.1}, 1.1, false},      // 0
    {BoneId::kUpperArm, {1.00, 0.1, -0.1}, 1.0, true},  // 1
    {BoneId::kHand, {0.50, 0.5, -0.5}, 0.6, true},      // 2
    {BoneId::kChest, {-0.45, 0.0, 1.6}, 1.3, false},    // 3
    {BoneId::kThigh, {0.40, -0.1, 0.5}, 1.3, true},     // 4
    {BoneId::kPelvis, {0.80, 0.0, 0.0}, 1.1, true},     // 5
    {BoneId::kHead, {0.70, 0.0, 0.5}, 1.8, false},      // 6
    {BoneId::kFoot, {0.55, 0.5, -0.7}, 1.2, true},      // 7
    {BoneId::kShin, {1.45, 0.3, -0.3}, 0.4, true},      // 8
    {BoneId::kRibs, {0.85, 0.0, 1.0}, 3.4, false},      // 9
});
constexpr auto kPlainFullEdges = std::to_array<LayoutEdge>({{0, 1, false},
                                                            {0, 3, false},
                                                            {0, 6, false},
                                                            {0, 9, false},
                                                            {1, 2, false},
                                                            {3, 5, false},
                                                            {4, 5, false},
                                                            {4, 8, false},
                                                            {5, 5, true},
                                                            {7, 8, false}});

// About 32 + 32 without head, hands and feet: two chains from chest to hip, bust and belly and
// buttock tied crosswise, two capsules side by side in the thigh.
constexpr auto kTwinNodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {-0.70, 1.3, 1.3}, 1.4, true},     // 0
    {BoneId::kChest, {1.10, 0.3, 0.4}, 0.8, true},      // 1
    {BoneId::kClavicle, {0.45, -0.9, 0.3}, 1.6, true},  // 2
    {BoneId::kThigh, {0.10, -0.2, 0.1}, 1.6, true},     // 3
    {BoneId::kThigh, {0.90, -0.2, 0.5}, 0.7, true},     // 4
    {BoneId::kThigh, {0.90, -0.1, 0.0}, 0.9, true},     // 5
    {BoneId::kBelly, {2.10, 0.6, 1.1}, 1.1, true},      // 6
    {BoneId::kClavicle, {1.00, 0.1, -0.1}, 0.9, true},  // 7
    {BoneId::kPelvis, {0.60, 0.0, -0.1}, 1.2, true},    // 8
    {BoneId::kForearm, {0.90, 0.0, -0.1}, 0.7, true},   // 9
    {BoneId::kThigh, {0.35, -0.1, 0.5}, 1.4, true},     // 10
    {BoneId::kBelly, {0.60, 0.5, 0.7}, 1.4, true},      // 11
    {BoneId::kClavicle, {0.40, 0.0, -0.3}, 1.2, true},  // 12
    {BoneId::kShin, {0.35, 0.3, -0.5}, 1.0, true},      // 13
    {BoneId::kUpperArm, {1.05, -0.1, 0.0}, 1.0, true},  // 14
    {BoneId::kShin, {0.90, 0.1, -0.1}, 0.5, true},      // 15
});
constexpr auto kTwinEdges = std::to_array<LayoutEdge>({{0, 7, true},
                                                       {0, 11, true},
                                                       {1, 12, true},
                                                       {2, 2, true},
                                                       {2, 6, false},
                                                       {2, 7, false},
                                                       {3, 6, false},
                                                       {3, 10, false},
                                                       {4, 10, false},
                                                       {5, 10, false},
                                                       {5, 13, false},
                                                       {7, 12, false},
                                                       {7, 14, false},
                                                       {8, 11, true},
                                                       {9, 14, false},
                                                       {11, 11, true},
                                                       {13, 15, false}});

// About 32 + 32 with head, hands and feet.
constexpr auto kTwinFullNodes = std::to_array<LayoutNode>({
    {BoneId::kHead, {0.05, 0.0, 0.0}, 0.8, false},       // 0
    {BoneId::kUpperArm, {1.00, -0.1, -0.1}, 0.9, true},  // 1
    {BoneId::kHand, {0.65, 0.7, -0.5}, 0.4, true},       // 2
    {BoneId::kChest, {-1.15, 0.0, 1.1}, 1.5, false},     // 3
    {BoneId::kPelvis, {0.55, 0.1, 0.0}, 1.2, true},      // 4
    {BoneId::kHead, {0.70, 0.0, 0.3}, 1.8, false},       // 5
    {BoneId::kFoot, {0.50, 0.7, -0.7}, 1.2, true},       // 6
    {BoneId::kChest, {-0.95, 0.8, 0.7}, 1.9, true},      // 7
    {BoneId::kForearm, {0.45, 0.0, -0.1}, 0.9, true},    // 8
    {BoneId::kShin, {0.30, 0.2, -0.5}, 0.9, true},       // 9
    {BoneId::kThigh, {0.95, -0.2, 0.1}, 0.9, true},      // 10
    {BoneId::kThigh, {0.35, -0.1, 0.5}, 1.4, true},      // 11
    {BoneId::kClavicle, {1.00, 0.1, -0.1}, 0.9, true},   // 12
    {BoneId::kShin, {1.55, 0.1, 0.0}, 0.4, true},        // 13
    {BoneId::kHand, {0.25, 0.2, 1.1}, 0.8, true},        // 14
    {BoneId::kHead, {0.45, 0.0, 1.4}, 1.3, false},       // 15
    {BoneId::kThigh, {0.10, -0.2, 0.1}, 1.6, true},      // 16
    {BoneId::kClavicle, {0.60, 0.0, -0.2}, 1.2, true},   // 17
});
constexpr auto kTwinFullEdges = std::to_array<LayoutEdge>({{0, 3, false},
                                                           {0, 7, false},
                                                           {0, 15, false},
                                                           {1, 8, false},
                                                           {1, 12, false},
                                                           {2, 8, false},
                                                           {2, 14, false},
                                                           {3, 12, false},
                                                           {3, 16, false},
                                                           {4, 16, false},
                                                           {5, 15, false},
                                                           {6, 13, false},
                                                           {7, 17, false},
                                                           {9, 10, false},
                                                           {9, 13, false},
                                                           {10, 11, false},
                                                           {11, 16, false},
                                                           {17, 17, true}});

// About 32 + 32 that enclose a body without head, hands and feet: a big sphere in each buttock tied
// to the waist straight and crosswise, a capsule in each breast, shoulder and chest and shoulder
// blade as a star.
constexpr auto kShellNodes = std::to_array<LayoutNode>({
    {BoneId::kShin, {0.90, 0.1, 0.2}, 0.4, true},       // 0
    {BoneId::kClavicle, {0.60, -2.0, 1.9}, 0.9, true},  // 1
    {BoneId::kClavicle, {0.45, 0.1, -0.3}, 1.2, true},  // 2
    {BoneId::kChest, {1.30, 0.0, 0.5}, 1.1, false},     // 3
    {BoneId::kUpperArm, {1.05, -0.1, 0.0}, 1.1, true},  // 4
    {BoneId::kChest, {-0.65, 0.8, 0.6}, 2.0, true},     // 5
    {BoneId::kChest, {-0.10, 1.1, 0.5}, 1.9, true},     // 6
    {BoneId::kChest, {0.85, 0.0, 0.0}, 1.1, false},     // 7
    {BoneId::kBelly, {2.00, 0.4, 1.2}, 1.4, true},      // 8
    {BoneId::kForearm, {0.95, 0.0, -0.1}, 0.9, true},   // 9
    {BoneId::kShin, {0.90, 0.1, -0.2}, 0.6, true},      // 10
    {BoneId::kClavicle, {1.00, 0.0, -0.2}, 1.0, true},  // 11
    {BoneId::kThigh, {0.10, -0.2, 0.1}, 1.7, true},     // 12
    {BoneId::kThigh, {0.40, -0.1, 0.5}, 1.5, true},     // 13
    {BoneId::kPelvis, {0.65, -0.1, 0.0}, 1.3, true},    // 14
    {BoneId::kShin, {0.35, 0.3, -0.5}, 1.0, true},      // 15
    {BoneId::kThigh, {0.90, -0.2, 0.2}, 1.1, true},     // 16
});
constexpr auto kShellEdges = std::to_array<LayoutEdge>({{1, 6, false},
                                                        {2, 6, false},
                                                        {2, 7, false},
                                                        {2, 11, false},
                                                        {3, 7, false},
                                                        {4, 9, false},
                                                        {4, 11, false},
                                                        {5, 7, false},
                                                        {5, 8, false},
                                                        {6, 11, false},
                                                        {8, 8, true},
                                                        {8, 14, false},
                                                        {8, 14, true},
                                                        {10, 15, false},
                                                        {12, 13, false},
                                                        {13, 16, false},
                                                        {15, 16, false}});

// About 31 + 32 that enclose a whole body.
constexpr auto kShellFullNodes = std::to_array<LayoutNode>({
    {BoneId::kClavicle, {0.65, -1.8, 1.7}, 0.9, true},  // 0
    {BoneId::kHead, {0.65, 0.0, 0.4}, 2.1, false},      // 1
    {BoneId::kUpperArm, {1.05, -0.1, 0.0}, 1.1, true},  // 2
    {BoneId::kClavicle, {0.40, -0.7, 0.3}, 1.7, true},  // 3
    {BoneId::kChest, {0.70, 0.0, -0.5}, 1.3, false},    // 4
    {BoneId::kBelly, {2.10, 0.3, 1.3}, 1.5, true},      // 5
    {BoneId::kForearm, {1.00, -0.1, -0.1}, 0.8, true},  // 6
    {BoneId::kShin, {1.50, 0.1, -0.1}, 0.8, true},      // 7
    {BoneId::kClavicle, {1.00, 0.0, -0.2}, 1.0, true},  // 8
    {BoneId::kThigh, {0.10, -0.3, 0.0}, 1.8, true},     // 9
    {BoneId::kThigh, {0.40, -0.1, 0.5}, 1.5, true},     // 10
    {BoneId::kPelvis, {0.60, -0.1, 0.0}, 1.3, true},    // 11
    {BoneId::kShin, {0.30, 0.3, -0.4}, 1.0, true},      // 12
    {BoneId::kHand, {0.65, -0.2, 0.6}, 2.7, true},      // 13
    {BoneId::kFoot, {0.80, 1.0, -0.2}, 1.7, true},      // 14
    {BoneId::kThigh, {0.90, -0.2, 0.2}, 1.0, true},     // 15
    {BoneId::kHead, {0.45, 0.0, 1.6}, 1.4, false},      // 16
});
constexpr auto kShellFullEdges = std::to_array<LayoutEdge>({{0, 0, true},
                                                            {0, 8, false},
                                                            {1, 16, false},
                                                            {2, 6, false},
                                                            {2, 8, false},
                                                            {3, 3, true},
                                                            {3, 5, false},
                                                            {3, 8, false},
                                                            {4, 8, false},
                                                            {4, 16, false},
                                                            {5, 9, false},
                                                            {5, 11, true},
                                                            {6, 13, false},
                                                            {7, 12, false},
                                                            {7, 14, false},
                                                            {9, 10, false},
                                                            {10, 15, false},
                                                            {12, 15, false}});

}  // namespace

std::span<const NamedLayout> Layouts() {
  static constexpr std::array<NamedLayout, 6> kLayouts = {{
      {"plain", Guise::kBestFit, false, {kPlainNodes, kPlainEdges}},
      {"plain, full", Guise::kBestFit, true, {kPlainFullNodes, kPlainFullEdges}},
      {"twin", Guise::kBestFit, false, {kTwinNodes, kTwinEdges}},
      {"twin, full", Guise::kBestFit, true, {kTwinFullNodes, kTwinFullEdges}},
      {"shell", Guise::kEnclose, false, {kShellNodes, kShellEdges}},
      {"shell, full", Guise::kEnclose, true, {kShellFullNodes, kShellFullEdges}},
  }};
  return kLayouts;
}

}  // namespace capfit::refine
