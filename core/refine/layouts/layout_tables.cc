#include <array>

#include "core/refine/layouts/layout.h"

namespace capfit::refine {
namespace {

// Found by the searches of core/refine/layouts/maker/make_layouts.cc on built-in mannequins of both
// sexes, slim and heavy, but for the smallest enclosing ones, which are by hand. A run gives tables
// as good, not the same digits: what counts is the topology; places and radii are rounded,
// everything is optimised for each body, and enclosing sets grow beyond these or from the smaller
// of them.

// 16 + 16 for the best fit, in one piece, without head, hands and feet.
constexpr auto kBest32Nodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.33, 0.0, -0.4}, 1.7, false},     // 0
    {BoneId::kUpperArm, {0.07, -0.0, -0.1}, 1.3, true},  // 1
    {BoneId::kForearm, {0.89, -0.1, -0.3}, 0.7, true},   // 2
    {BoneId::kThigh, {0.32, -0.0, 0.3}, 1.2, true},      // 3
    {BoneId::kShin, {0.91, -0.1, -0.2}, 0.7, true},      // 4
    {BoneId::kPelvis, {0.68, 0.4, 0.1}, 1.6, true},      // 5
    {BoneId::kChest, {0.79, 0.0, -0.4}, 1.0, false},     // 6
    {BoneId::kRibs, {1.12, 0.5, -0.1}, 1.3, true},       // 7
    {BoneId::kBelly, {1.02, 0.4, 0.1}, 0.9, true},       // 8
});
constexpr auto kBest32Edges = std::to_array<LayoutEdge>({{3, 4, false},
                                                         {1, 2, false},
                                                         {3, 5, false},
                                                         {1, 6, false},
                                                         {0, 1, false},
                                                         {0, 7, false},
                                                         {5, 8, false},
                                                         {7, 8, false}});

// 32 + 32 for the best fit, in one piece, without head, hands and feet.
constexpr auto kBest64Nodes = std::to_array<LayoutNode>({
    {BoneId::kRibs, {0.10, 0.0, 0.1}, 0.9, false},       // 0
    {BoneId::kBelly, {1.45, 0.0, 0.0}, 0.7, false},      // 1
    {BoneId::kChest, {0.80, 0.0, -0.3}, 1.0, false},     // 2
    {BoneId::kUpperArm, {-0.30, 0.1, -0.2}, 1.2, true},  // 3
    {BoneId::kForearm, {0.89, -0.1, -0.1}, 0.8, true},   // 4
    {BoneId::kThigh, {1.07, 0.0, 0.0}, 1.0, true},       // 5
    {BoneId::kShin, {0.90, -0.1, -0.2}, 0.7, true},      // 6
    {BoneId::kPelvis, {0.59, 0.4, 0.0}, 1.2, true},      // 7
    {BoneId::kRibs, {1.03, 0.6, -0.3}, 1.0, true},       // 8
    {BoneId::kRibs, {0.33, -0.3, 0.1}, 0.9, true},       // 9
    {BoneId::kRibs, {1.52, 0.7, -0.2}, 1.1, true},       // 10
    {BoneId::kUpperArm, {0.66, -0.0, -0.0}, 1.0, true},  // 11
    {BoneId::kForearm, {0.07, -0.0, -0.1}, 1.1, true},   // 12
    {BoneId::kChest, {0.21, 0.0, -0.3}, 1.8, false},     // 13
    {BoneId::kRibs, {0.96, 0.7, 0.5}, 0.9, true},        // 14
    {BoneId::kThigh, {-0.08, -0.2, -0.0}, 1.2, true},    // 15
    {BoneId::kShin, {0.26, -0.1, -0.2}, 1.1, true},      // 16
    {BoneId::kBelly, {0.78, 0.7, 0.1}, 0.9, true},       // 17
});
constexpr auto kBest64Edges = std::to_array<LayoutEdge>({{0, 1, false},
                                                         {2, 3, false},
                                                         {0, 7, false},
                                                         {0, 9, false},
                                                         {1, 10, false},
                                                         {8, 10, false},
                                                         {11, 12, false},
                                                         {4, 12, false},
                                                         {3, 11, false},
                                                         {1, 2, false},
                                                         {8, 13, false},
                                                         {10, 14, false},
                                                         {9, 15, true},
                                                         {5, 16, false},
                                                         {6, 16, false},
                                                         {5, 15, false},
                                                         {5, 17, false}});

// 16 + 16 for the best fit, in one piece, with head, hands and feet.
constexpr auto kBestFull32Nodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.40, 0.0, 0.6}, 0.9, false},      // 0
    {BoneId::kRibs, {1.05, 0.0, -0.1}, 1.6, false},      // 1
    {BoneId::kChest, {0.99, 0.0, -0.1}, 0.7, false},     // 2
    {BoneId::kClavicle, {0.85, -0.1, -0.1}, 1.0, true},  // 3
    {BoneId::kPelvis, {0.71, 0.3, 0.1}, 1.5, true},      // 4
    {BoneId::kThigh, {0.38, -0.1, 0.3}, 1.2, true},      // 5
    {BoneId::kShin, {1.72, -0.0, -0.1}, 0.5, true},      // 6
    {BoneId::kHead, {0.68, 0.0, 0.3}, 1.5, false},       // 7
    {BoneId::kHand, {0.92, -0.2, -0.4}, 0.4, true},      // 8
    {BoneId::kFoot, {0.83, -0.1, 0.3}, 1.2, true},       // 9
});
constexpr auto kBestFull32Edges = std::to_array<LayoutEdge>({{0, 1, false},
                                                             {1, 2, false},
                                                             {2, 3, false},
                                                             {0, 4, false},
                                                             {4, 5, false},
                                                             {5, 6, false},
                                                             {2, 7, false},
                                                             {3, 8, false},
                                                             {6, 9, false},
                                                             {4, 4, true}});

// 32 + 32 for the best fit, in one piece, with head, hands and feet.
constexpr auto kBestFull64Nodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.25, 0.0, 0.7}, 0.7, false},      // 0
    {BoneId::kChest, {0.93, 0.0, -0.3}, 0.8, false},     // 1
    {BoneId::kUpperArm, {0.86, -0.0, -0.1}, 0.9, true},  // 2
    {BoneId::kPelvis, {0.70, 0.4, 0.1}, 1.6, true},      // 3
    {BoneId::kThigh, {0.95, -0.0, 0.0}, 0.9, true},      // 4
    {BoneId::kShin, {1.73, -0.0, -0.1}, 0.5, true},      // 5
    {BoneId::kHand, {0.89, -0.3, -0.0}, 0.6, true},      // 6
    {BoneId::kFoot, {0.93, -0.8, 0.5}, 0.8, true},       // 7
    {BoneId::kBelly, {0.21, 0.4, 0.4}, 0.6, true},       // 8
    {BoneId::kHead, {0.19, 0.0, 0.3}, 0.9, false},       // 9
    {BoneId::kHead, {0.70, 0.0, 0.5}, 1.3, false},       // 10
    {BoneId::kHead, {0.38, 0.0, 1.2}, 0.9, false},       // 11
    {BoneId::kShin, {0.46, -0.0, -0.5}, 0.7, true},      // 12
    {BoneId::kClavicle, {0.36, -0.7, -0.0}, 1.5, true},  // 13
    {BoneId::kThigh, {0.29, -0.1, 0.3}, 1.3, true},      // 14
    {BoneId::kHead, {0.70, 0.0, -0.2}, 1.3, false},      // 15
    {BoneId::kUpperArm, {0.08, -0.1, -0.0}, 1.3, true},  // 16
    {BoneId::kRibs, {0.75, 0.6, 0.5}, 0.8, true},        // 17
    {BoneId::kFoot, {0.94, 0.8, 0.4}, 0.8, true},        // 18
});
constexpr auto kBestFull64Edges = std::to_array<LayoutEdge>({{0, 3, false},
                                                             {5, 7, false},
                                                             {2, 6, false},
                                                             {1, 9, false},
                                                             {4, 5, false},
                                                             {0, 1, false},
                                                             {10, 11, false},
                                                             {9, 10, false},
                                                             {4, 12, false},
                                                             {1, 13, false},
                                                             {8, 13, false},
                                                             {3, 14, false},
                                                             {4, 14, false},
                                                             {9, 15, false},
                                                             {1, 16, false},
                                                             {2, 16, false},
                                                             {13, 17, false},
                                                             {5, 18, false},
                                                             {13, 13, true}});

// The fewest that enclose: 10 + 5, a capsule each for trunk and limbs. By hand.
constexpr auto kPlainestNodes = std::to_array<LayoutNode>({
    {BoneId::kBelly, {0.30, 0.0, 0.0}, 1.5, false},
    {BoneId::kChest, {0.60, 0.0, 0.0}, 1.2, false},
    {BoneId::kClavicle, {0.90, 0.0, 0.0}, 1.2, true},
    {BoneId::kForearm, {0.90, 0.0, 0.0}, 1.0, true},
    {BoneId::kThigh, {0.10, 0.0, 0.0}, 1.7, true},
    {BoneId::kShin, {0.90, 0.0, 0.0}, 1.0, true},
});
constexpr auto kPlainestEdges =
    std::to_array<LayoutEdge>({{0, 1, false}, {2, 3, false}, {4, 5, false}});

// 18 + 14 for enclosing, without head, hands and feet.
constexpr auto kShell32Nodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.27, 0.0, 0.0}, 1.4, false},    // 0
    {BoneId::kRibs, {0.95, 0.4, 0.0}, 1.6, true},      // 1
    {BoneId::kChest, {0.79, 0.0, -0.2}, 1.3, false},   // 2
    {BoneId::kClavicle, {0.80, 0.1, 0.0}, 1.2, true},  // 3
    {BoneId::kForearm, {0.98, 0.0, 0.0}, 0.9, true},   // 4
    {BoneId::kThigh, {0.99, 0.0, 0.0}, 0.9, true},     // 5
    {BoneId::kShin, {0.97, -0.1, -0.2}, 0.7, true},    // 6
    {BoneId::kPelvis, {0.60, 0.1, 0.2}, 1.8, true},    // 7
    {BoneId::kThigh, {0.27, -0.1, 0.2}, 1.4, true},    // 8
    {BoneId::kShin, {0.49, 0.0, -0.2}, 1.1, true},     // 9
});
constexpr auto kShell32Edges = std::to_array<LayoutEdge>({{0, 7, false},
                                                          {5, 8, false},
                                                          {2, 3, false},
                                                          {3, 4, false},
                                                          {5, 9, false},
                                                          {6, 9, false},
                                                          {1, 3, false}});

// 32 + 32 for enclosing, without head, hands and feet.
constexpr auto kShell64Nodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.32, 0.0, 0.7}, 0.9, false},     // 0
    {BoneId::kRibs, {0.97, 0.5, 0.3}, 1.2, true},       // 1
    {BoneId::kForearm, {0.90, 0.0, -0.1}, 1.0, true},   // 2
    {BoneId::kPelvis, {0.72, 0.4, 0.0}, 1.7, true},     // 3
    {BoneId::kShin, {0.01, 0.0, 0.0}, 1.2, true},       // 4
    {BoneId::kShin, {0.95, 0.0, 0.1}, 0.7, true},       // 5
    {BoneId::kRibs, {1.43, 0.5, -0.2}, 1.3, true},      // 6
    {BoneId::kBelly, {0.24, 0.0, 0.2}, 1.1, false},     // 7
    {BoneId::kThigh, {0.41, 0.0, 0.2}, 1.3, true},      // 8
    {BoneId::kUpperArm, {0.01, -0.1, 0.0}, 1.4, true},  // 9
    {BoneId::kClavicle, {0.38, 0.2, -0.4}, 1.3, true},  // 10
    {BoneId::kRibs, {0.11, 0.0, 0.0}, 1.0, false},      // 11
    {BoneId::kUpperArm, {1.05, 0.0, 0.0}, 0.9, true},   // 12
    {BoneId::kRibs, {1.44, 0.9, -0.2}, 0.9, true},      // 13
    {BoneId::kThigh, {0.16, -0.2, 0.2}, 1.4, true},     // 14
    {BoneId::kShin, {0.48, 0.0, -0.2}, 1.1, true},      // 15
    {BoneId::kChest, {0.87, 0.0, -0.2}, 1.0, false},    // 16
    {BoneId::kChest, {0.72, 0.4, -0.4}, 1.1, true},     // 17
});
constexpr auto kShell64Edges = std::to_array<LayoutEdge>({{0, 3, false},
                                                          {4, 8, false},
                                                          {10, 11, false},
                                                          {9, 10, false},
                                                          {9, 12, false},
                                                          {7, 13, false},
                                                          {9, 13, false},
                                                          {8, 14, false},
                                                          {4, 15, false},
                                                          {5, 15, false},
                                                          {3, 14, false},
                                                          {6, 10, true},
                                                          {2, 12, false},
                                                          {7, 14, false},
                                                          {10, 17, false},
                                                          {16, 17, false}});

// The fewest that enclose: 10 + 5, a capsule each for trunk and limbs. By hand.
constexpr auto kPlainestFullNodes = std::to_array<LayoutNode>({
    {BoneId::kBelly, {0.30, 0.0, 0.0}, 1.5, false},
    {BoneId::kHead, {0.60, 0.0, 0.3}, 1.8, false},
    {BoneId::kUpperArm, {0.00, 0.0, 0.0}, 1.2, true},
    {BoneId::kHand, {0.50, 0.0, 0.0}, 2.5, true},
    {BoneId::kThigh, {0.10, 0.0, 0.0}, 1.7, true},
    {BoneId::kFoot, {0.30, 0.0, 0.0}, 1.7, true},
});
constexpr auto kPlainestFullEdges =
    std::to_array<LayoutEdge>({{0, 1, false}, {2, 3, false}, {4, 5, false}});

// 20 + 12 for enclosing, with head, hands and feet.
constexpr auto kShellFull32Nodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.35, 0.4, 0.4}, 1.0, true},       // 0
    {BoneId::kRibs, {0.99, 0.0, -0.1}, 1.9, false},      // 1
    {BoneId::kChest, {0.80, 0.0, -0.2}, 1.5, false},     // 2
    {BoneId::kUpperArm, {0.06, -0.1, -0.1}, 1.4, true},  // 3
    {BoneId::kHand, {0.42, -0.1, -0.2}, 1.2, true},      // 4
    {BoneId::kBelly, {0.26, 0.5, 0.0}, 1.4, true},       // 5
    {BoneId::kThigh, {0.66, 0.0, 0.2}, 1.1, true},       // 6
    {BoneId::kHeel, {0.40, 0.0, -0.5}, 2.1, true},       // 7
    {BoneId::kHand, {0.65, -0.2, 0.4}, 2.5, true},       // 8
    {BoneId::kHead, {0.63, 0.0, 0.2}, 1.8, false},       // 9
    {BoneId::kHead, {0.45, 0.0, 1.2}, 1.2, false},       // 10
    {BoneId::kFoot, {0.90, 0.0, 0.3}, 1.7, true},        // 11
});
constexpr auto kShellFull32Edges = std::to_array<LayoutEdge>(
    {{5, 6, false}, {6, 7, false}, {3, 4, false}, {7, 11, false}, {0, 5, false}, {2, 3, false}});

// 32 + 31 for enclosing, with head, hands and feet.
constexpr auto kShellFull64Nodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.42, 0.0, 0.0}, 1.1, false},     // 0
    {BoneId::kChest, {0.15, 0.5, -0.1}, 1.7, true},     // 1
    {BoneId::kChest, {0.87, 0.0, -0.5}, 0.8, false},    // 2
    {BoneId::kClavicle, {0.84, 0.1, -0.1}, 1.1, true},  // 3
    {BoneId::kHand, {0.15, -0.1, -0.2}, 1.2, true},     // 4
    {BoneId::kPelvis, {0.69, 0.5, 0.1}, 1.9, true},     // 5
    {BoneId::kThigh, {0.90, 0.0, 0.1}, 1.0, true},      // 6
    {BoneId::kShin, {1.69, -0.1, 0.0}, 0.9, true},      // 7
    {BoneId::kHand, {0.71, -0.4, 0.6}, 2.3, true},      // 8
    {BoneId::kFoot, {0.90, 0.0, 0.3}, 1.7, true},       // 9
    {BoneId::kShin, {0.36, 0.0, -0.2}, 1.0, true},      // 10
    {BoneId::kHead, {0.41, 0.0, 0.6}, 1.1, true},       // 11
    {BoneId::kRibs, {0.72, 0.0, 0.1}, 1.1, false},      // 12
    {BoneId::kThigh, {0.37, -0.1, 0.2}, 1.4, true},     // 13
    {BoneId::kHead, {0.62, 0.0, 0.1}, 1.8, false},      // 14
    {BoneId::kBelly, {1.06, 0.5, 0.1}, 1.0, true},      // 15
    {BoneId::kUpperArm, {0.84, 0.0, 0.0}, 1.0, true},   // 16
    {BoneId::kShin, {0.77, 0.0, 0.0}, 0.7, true},       // 17
});
constexpr auto kShellFull64Edges = std::to_array<LayoutEdge>({{4, 8, false},
                                                              {6, 10, false},
                                                              {2, 11, false},
                                                              {7, 9, false},
                                                              {6, 13, false},
                                                              {1, 3, false},
                                                              {2, 3, false},
                                                              {5, 15, false},
                                                              {5, 13, false},
                                                              {3, 16, false},
                                                              {4, 16, false},
                                                              {1, 15, false},
                                                              {7, 17, false},
                                                              {10, 17, false},
                                                              {5, 15, true},
                                                              {5, 5, true}});

// 32 + 32 for enclosing, without head, hands and feet.
constexpr auto kShell64BustNodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.35, 0.0, 0.7}, 0.8, false},     // 0
    {BoneId::kRibs, {1.06, 0.7, 0.7}, 0.8, true},       // 1
    {BoneId::kForearm, {0.95, 0.0, 0.0}, 0.7, true},    // 2
    {BoneId::kPelvis, {0.74, 0.4, 0.1}, 1.7, true},     // 3
    {BoneId::kShin, {0.02, 0.0, 0.0}, 1.2, true},       // 4
    {BoneId::kShin, {0.95, -0.1, 0.2}, 0.7, true},      // 5
    {BoneId::kChest, {0.24, 0.8, -0.3}, 1.9, true},     // 6
    {BoneId::kBelly, {0.29, 0.0, 0.3}, 1.0, false},     // 7
    {BoneId::kThigh, {0.40, 0.0, 0.2}, 1.3, true},      // 8
    {BoneId::kUpperArm, {0.07, -0.1, 0.0}, 1.4, true},  // 9
    {BoneId::kClavicle, {0.33, 0.6, -0.5}, 1.1, true},  // 10
    {BoneId::kBelly, {0.64, 0.0, 0.3}, 0.8, false},     // 11
    {BoneId::kUpperArm, {1.08, 0.0, 0.0}, 0.9, true},   // 12
    {BoneId::kForearm, {0.51, 0.0, -0.1}, 1.0, true},   // 13
    {BoneId::kClavicle, {0.55, -0.6, 0.0}, 1.4, true},  // 14
    {BoneId::kShin, {0.48, 0.0, -0.2}, 1.1, true},      // 15
    {BoneId::kChest, {0.86, 0.0, -0.2}, 1.0, false},    // 16
    {BoneId::kThigh, {0.21, -0.2, 0.2}, 1.3, true},     // 17
});
constexpr auto kShell64BustEdges = std::to_array<LayoutEdge>({{0, 3, false},
                                                              {4, 8, false},
                                                              {9, 10, false},
                                                              {3, 3, true},
                                                              {9, 12, false},
                                                              {2, 13, false},
                                                              {12, 13, false},
                                                              {7, 14, false},
                                                              {9, 14, false},
                                                              {4, 15, false},
                                                              {5, 15, false},
                                                              {10, 10, true},
                                                              {6, 10, true},
                                                              {6, 14, true},
                                                              {6, 11, false},
                                                              {3, 17, false},
                                                              {8, 17, false}});

}  // namespace

std::span<const NamedLayout> Layouts() {
  static constexpr std::array<NamedLayout, 11> kLayouts = {{
      {"best fit, 32", FitKind::kBestFit, 32, false, {kBest32Nodes, kBest32Edges}},
      {"best fit, 64", FitKind::kBestFit, 64, false, {kBest64Nodes, kBest64Edges}},
      {"best fit, whole body, 32",
       FitKind::kBestFit,
       32,
       true,
       {kBestFull32Nodes, kBestFull32Edges}},
      {"best fit, whole body, 64",
       FitKind::kBestFit,
       64,
       true,
       {kBestFull64Nodes, kBestFull64Edges}},
      {"shell, 15", FitKind::kEnclose, 15, false, {kPlainestNodes, kPlainestEdges}},
      {"shell, 32", FitKind::kEnclose, 32, false, {kShell32Nodes, kShell32Edges}},
      {"shell, 64", FitKind::kEnclose, 64, false, {kShell64Nodes, kShell64Edges}},
      {"shell, bust, 64", FitKind::kEnclose, 64, false, {kShell64BustNodes, kShell64BustEdges}},
      {"shell, whole body, 15",
       FitKind::kEnclose,
       15,
       true,
       {kPlainestFullNodes, kPlainestFullEdges}},
      {"shell, whole body, 32",
       FitKind::kEnclose,
       32,
       true,
       {kShellFull32Nodes, kShellFull32Edges}},
      {"shell, whole body, 64",
       FitKind::kEnclose,
       64,
       true,
       {kShellFull64Nodes, kShellFull64Edges}},
  }};
  return kLayouts;
}

}  // namespace capfit::refine
