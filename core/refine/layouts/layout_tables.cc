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

// 128 for the best fit, with head, hands and feet.
constexpr auto kBestFull128Nodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.19, 0.0, 0.6}, 0.8, false},      // 0
    {BoneId::kChest, {0.96, 0.0, -0.3}, 0.7, false},     // 1
    {BoneId::kUpperArm, {0.89, 0.0, -0.0}, 0.9, true},   // 2
    {BoneId::kBelly, {0.97, 0.8, -0.1}, 0.9, true},      // 3
    {BoneId::kThigh, {0.95, -0.0, 0.0}, 0.8, true},      // 4
    {BoneId::kShin, {1.82, 0.0, 0.0}, 0.5, true},        // 5
    {BoneId::kHand, {0.95, -0.3, 0.3}, 0.4, true},       // 6
    {BoneId::kFoot, {0.96, -1.0, 0.4}, 0.6, true},       // 7
    {BoneId::kBelly, {0.18, 0.2, 0.5}, 0.7, true},       // 8
    {BoneId::kHead, {0.20, 0.0, 0.3}, 0.9, false},       // 9
    {BoneId::kHead, {0.70, 0.0, 0.1}, 1.4, false},       // 10
    {BoneId::kShin, {0.35, -0.0, -0.4}, 0.8, true},      // 11
    {BoneId::kClavicle, {0.44, -0.4, -0.1}, 1.4, true},  // 12
    {BoneId::kThigh, {0.28, -0.1, 0.3}, 1.2, true},      // 13
    {BoneId::kHead, {0.70, 0.0, -0.4}, 1.2, false},      // 14
    {BoneId::kUpperArm, {0.11, -0.1, -0.0}, 1.3, true},  // 15
    {BoneId::kRibs, {0.99, 0.7, 0.5}, 0.9, true},        // 16
    {BoneId::kHeel, {0.53, 0.0, -0.6}, 1.4, true},       // 17
    {BoneId::kHand, {0.36, -0.1, 1.1}, 0.6, true},       // 18
    {BoneId::kFoot, {0.19, -0.1, -0.0}, 1.1, true},      // 19
    {BoneId::kThigh, {0.46, -0.1, 0.3}, 1.2, true},      // 20
    {BoneId::kPelvis, {0.77, -0.1, -0.4}, 1.0, true},    // 21
    {BoneId::kShin, {0.05, 0.0, 0.3}, 0.8, true},        // 22
    {BoneId::kPelvis, {0.66, 0.4, -0.1}, 1.4, true},     // 23
    {BoneId::kShin, {2.06, 0.0, -0.1}, 0.1, true},       // 24
    {BoneId::kBelly, {0.21, 0.4, -0.1}, 1.2, true},      // 25
    {BoneId::kHand, {0.16, -0.1, -0.6}, 0.7, true},      // 26
    {BoneId::kHand, {0.87, -0.3, -0.6}, 0.5, true},      // 27
    {BoneId::kThigh, {0.29, -0.1, 0.1}, 1.2, true},      // 28
    {BoneId::kFoot, {0.98, -0.0, 0.6}, 0.7, true},       // 29
    {BoneId::kThigh, {0.30, -0.2, 0.8}, 0.7, true},      // 30
    {BoneId::kBelly, {0.44, 0.8, -0.0}, 1.0, true},      // 31
    {BoneId::kHead, {0.71, 0.0, 0.6}, 1.2, false},       // 32
    {BoneId::kForearm, {0.35, -0.0, -0.1}, 1.0, true},   // 33
    {BoneId::kChest, {0.64, 0.5, -0.3}, 1.0, true},      // 34
    {BoneId::kHead, {0.38, 0.0, 1.2}, 0.9, false},       // 35
    {BoneId::kHand, {0.62, -0.4, 2.6}, 0.3, true},       // 36
    {BoneId::kFoot, {0.97, 1.0, 0.4}, 0.6, true},        // 37
});
constexpr auto kBestFull128Edges = std::to_array<LayoutEdge>({
    {0, 3, false},  {4, 5, false},   {0, 1, false},   {4, 11, false},  {1, 12, false},
    {8, 12, false}, {3, 13, false},  {1, 15, false},  {2, 15, false},  {12, 16, false},
    {7, 17, false}, {6, 18, false},  {13, 20, false}, {20, 22, false}, {13, 21, false},
    {0, 25, false}, {26, 27, false}, {11, 24, false}, {17, 29, false}, {8, 30, false},
    {4, 28, false}, {30, 31, false}, {10, 32, false}, {2, 33, false},  {6, 33, false},
    {1, 9, false},  {12, 12, true},  {9, 10, false},  {8, 34, false},  {32, 35, false},
    {9, 14, false}, {18, 36, false}, {17, 37, false},
});

// 128 for the best fit.
constexpr auto kBest128Nodes = std::to_array<LayoutNode>({
    {BoneId::kRibs, {0.37, 0.0, 0.0}, 0.9, false},       // 0
    {BoneId::kChest, {0.08, 0.0, -0.2}, 1.3, false},     // 1
    {BoneId::kChest, {0.80, 0.0, -0.5}, 0.8, false},     // 2
    {BoneId::kUpperArm, {0.19, 0.2, 0.0}, 1.0, true},    // 3
    {BoneId::kForearm, {0.90, -0.1, -0.1}, 0.7, true},   // 4
    {BoneId::kShin, {0.12, -0.0, 0.2}, 0.9, true},       // 5
    {BoneId::kShin, {0.92, -0.1, -0.0}, 0.6, true},      // 6
    {BoneId::kPelvis, {0.66, 0.2, -0.0}, 1.4, true},     // 7
    {BoneId::kBelly, {0.90, 0.6, -0.0}, 0.7, true},      // 8
    {BoneId::kRibs, {1.00, 0.2, 0.2}, 0.8, true},        // 9
    {BoneId::kClavicle, {0.35, -0.9, -0.2}, 1.7, true},  // 10
    {BoneId::kUpperArm, {1.05, -0.0, -0.0}, 0.8, true},  // 11
    {BoneId::kRibs, {1.10, 0.5, -0.1}, 1.2, true},       // 12
    {BoneId::kRibs, {1.02, 0.8, 0.6}, 0.7, true},        // 13
    {BoneId::kPelvis, {0.93, 0.3, 0.2}, 1.2, true},      // 14
    {BoneId::kThigh, {0.62, -0.0, 0.3}, 0.8, true},      // 15
    {BoneId::kThigh, {0.37, -0.1, 0.3}, 1.2, true},      // 16
    {BoneId::kShin, {0.51, -0.1, -0.6}, 0.8, true},      // 17
    {BoneId::kShin, {0.44, -0.1, -0.6}, 0.9, true},      // 18
    {BoneId::kThigh, {0.41, -0.0, 0.1}, 1.1, true},      // 19
    {BoneId::kBelly, {0.10, 0.3, 0.4}, 0.8, true},       // 20
    {BoneId::kChest, {0.82, 0.3, -0.3}, 0.9, true},      // 21
    {BoneId::kThigh, {0.18, -0.4, 0.6}, 0.8, true},      // 22
    {BoneId::kPelvis, {0.95, 0.6, -0.3}, 1.0, true},     // 23
    {BoneId::kPelvis, {0.80, 0.4, -0.0}, 1.4, true},     // 24
    {BoneId::kPelvis, {0.84, 0.5, 0.1}, 1.2, true},      // 25
    {BoneId::kForearm, {0.46, -0.0, -0.1}, 1.0, true},   // 26
    {BoneId::kBelly, {0.62, 0.4, 0.1}, 1.0, true},       // 27
    {BoneId::kClavicle, {1.08, -0.6, 0.1}, 1.1, true},   // 28
    {BoneId::kClavicle, {0.48, 0.4, -0.4}, 1.0, true},   // 29
    {BoneId::kUpperArm, {0.15, -0.0, -0.1}, 1.2, true},  // 30
    {BoneId::kShin, {0.19, -0.0, -0.0}, 1.0, true},      // 31
    {BoneId::kShin, {0.48, -0.1, -0.2}, 1.0, true},      // 32
    {BoneId::kChest, {0.37, 0.0, -0.3}, 1.5, false},     // 33
    {BoneId::kClavicle, {0.43, -0.4, -0.3}, 1.2, true},  // 34
    {BoneId::kShin, {0.93, -0.1, -0.3}, 0.5, true},      // 35
});
constexpr auto kBest128Edges = std::to_array<LayoutEdge>({
    {0, 1, false},   {0, 9, false},   {10, 13, false}, {9, 14, false},  {5, 16, false},
    {6, 17, false},  {15, 18, false}, {0, 20, false},  {14, 23, false}, {19, 23, false},
    {0, 25, false},  {4, 26, false},  {11, 26, false}, {7, 27, false},  {8, 12, false},
    {2, 29, false},  {3, 29, false},  {2, 10, false},  {24, 27, true},  {11, 30, false},
    {19, 31, false}, {6, 32, false},  {15, 32, false}, {27, 27, true},  {10, 33, false},
    {8, 24, false},  {14, 16, false}, {28, 34, false}, {29, 34, false}, {3, 11, false},
    {17, 35, false},
});

// 131 + 119 for the best fit, with head, hands and feet. Only ever spared from.
constexpr auto kBestFull250Nodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.22, 0.1, 0.6}, 0.7, true},       // 0
    {BoneId::kChest, {1.05, 0.0, -0.3}, 0.6, false},     // 1
    {BoneId::kUpperArm, {0.92, 0.0, -0.0}, 0.8, true},   // 2
    {BoneId::kRibs, {0.80, 0.6, -0.2}, 0.8, true},       // 3
    {BoneId::kThigh, {0.96, -0.0, -0.0}, 0.8, true},     // 4
    {BoneId::kShin, {1.72, 0.0, 0.5}, 0.5, true},        // 5
    {BoneId::kHand, {0.91, -0.3, -0.2}, 0.5, true},      // 6
    {BoneId::kFoot, {0.96, -0.9, 0.5}, 0.6, true},       // 7
    {BoneId::kBelly, {0.28, 0.5, 0.5}, 0.5, true},       // 8
    {BoneId::kHead, {0.11, 0.0, 0.1}, 0.8, false},       // 9
    {BoneId::kHead, {0.60, 0.0, 0.1}, 1.2, false},       // 10
    {BoneId::kShin, {0.34, -0.0, -0.5}, 0.8, true},      // 11
    {BoneId::kClavicle, {0.43, -0.4, -0.1}, 1.4, true},  // 12
    {BoneId::kThigh, {0.27, -0.1, 0.0}, 1.0, true},      // 13
    {BoneId::kHead, {0.69, 0.0, -0.3}, 1.0, false},      // 14
    {BoneId::kUpperArm, {0.13, -0.0, -0.0}, 1.3, true},  // 15
    {BoneId::kRibs, {0.98, 0.7, 0.4}, 0.9, true},        // 16
    {BoneId::kHeel, {0.63, 0.1, -0.6}, 1.2, true},       // 17
    {BoneId::kHand, {0.23, -0.1, 0.4}, 0.7, true},       // 18
    {BoneId::kThigh, {0.43, -0.1, 0.3}, 1.2, true},      // 19
    {BoneId::kPelvis, {0.71, 0.2, -0.4}, 1.2, true},     // 20
    {BoneId::kShin, {0.07, 0.0, 0.2}, 0.8, true},        // 21
    {BoneId::kPelvis, {0.67, 0.6, -0.0}, 1.4, true},     // 22
    {BoneId::kShin, {1.92, 0.0, 0.1}, 0.3, true},        // 23
    {BoneId::kBelly, {0.28, 0.3, -0.0}, 1.2, true},      // 24
    {BoneId::kHand, {0.22, -0.1, -0.7}, 0.6, true},      // 25
    {BoneId::kHand, {0.82, -0.3, -1.0}, 0.4, true},      // 26
    {BoneId::kThigh, {0.30, -0.1, 0.1}, 1.2, true},      // 27
    {BoneId::kFoot, {1.03, 0.2, 0.5}, 0.6, true},        // 28
    {BoneId::kThigh, {0.33, -0.1, 0.3}, 1.2, true},      // 29
    {BoneId::kThigh, {-0.44, -0.2, 0.2}, 1.3, true},     // 30
    {BoneId::kHead, {0.66, 0.0, 0.6}, 1.2, false},       // 31
    {BoneId::kForearm, {0.37, -0.0, -0.0}, 1.0, true},   // 32
    {BoneId::kHead, {0.35, 0.0, 1.2}, 0.8, false},       // 33
    {BoneId::kHand, {0.46, -0.2, 1.6}, 0.4, true},       // 34
    {BoneId::kFoot, {0.95, 1.1, 0.4}, 0.6, true},        // 35
    {BoneId::kShin, {0.83, 0.0, -0.0}, 0.5, true},       // 36
    {BoneId::kBelly, {0.84, 0.5, 0.0}, 0.8, true},       // 37
    {BoneId::kClavicle, {0.86, -0.4, 0.0}, 0.7, true},   // 38
    {BoneId::kHead, {0.47, 0.0, 2.0}, 0.3, false},       // 39
    {BoneId::kClavicle, {0.46, 0.2, -0.3}, 0.7, true},   // 40
    {BoneId::kClavicle, {0.51, 0.3, -0.7}, 0.7, true},   // 41
    {BoneId::kHand, {0.92, -0.2, 0.5}, 0.4, true},       // 42
    {BoneId::kFoot, {0.58, -0.1, -0.2}, 0.3, true},      // 43
    {BoneId::kShin, {0.38, 0.0, -0.1}, 0.9, true},       // 44
    {BoneId::kShin, {0.90, 0.0, 0.2}, 0.5, true},        // 45
    {BoneId::kHead, {0.73, 0.0, 0.9}, 0.9, false},       // 46
    {BoneId::kFoot, {0.93, -0.6, 0.4}, 0.2, true},       // 47
    {BoneId::kFoot, {0.28, -0.1, -0.7}, 1.3, true},      // 48
    {BoneId::kPelvis, {0.90, 0.7, 0.2}, 1.4, true},      // 49
    {BoneId::kBelly, {0.20, 0.0, 0.5}, 0.7, true},       // 50
    {BoneId::kHand, {0.43, -0.1, 0.6}, 0.3, true},       // 51
    {BoneId::kForearm, {0.90, -0.0, -0.2}, 0.5, true},   // 52
    {BoneId::kHand, {0.56, -0.1, 1.0}, 0.5, true},       // 53
    {BoneId::kClavicle, {0.34, -0.5, -0.1}, 1.3, true},  // 54
    {BoneId::kRibs, {0.67, 0.0, -0.1}, 0.6, false},      // 55
    {BoneId::kRibs, {0.68, 0.4, -0.1}, 1.0, true},       // 56
    {BoneId::kForearm, {1.28, 0.1, 0.2}, 0.2, true},     // 57
    {BoneId::kBelly, {-0.07, 0.5, 0.5}, 0.4, true},      // 58
    {BoneId::kHand, {0.60, -0.5, 2.6}, 0.3, true},       // 59
    {BoneId::kRibs, {0.04, 0.2, 0.1}, 0.7, true},        // 60
    {BoneId::kHead, {0.52, 0.0, -0.2}, 0.9, false},      // 61
    {BoneId::kPelvis, {0.73, 0.0, 0.3}, 1.0, true},      // 62
    {BoneId::kFoot, {0.37, -0.7, -1.0}, 0.9, true},      // 63
    {BoneId::kBelly, {0.88, 0.6, 0.0}, 0.9, true},       // 64
    {BoneId::kHead, {0.69, 0.0, -0.1}, 1.1, false},      // 65
    {BoneId::kHead, {0.65, 0.0, 0.2}, 1.0, false},       // 66
    {BoneId::kHead, {0.46, 0.0, 1.9}, 0.2, false},       // 67
    {BoneId::kChest, {0.60, 0.0, -0.3}, 0.9, false},     // 68
    {BoneId::kRibs, {0.89, 0.4, -0.1}, 1.1, true},       // 69
    {BoneId::kRibs, {0.04, 0.0, 0.1}, 0.7, false},       // 70
    {BoneId::kClavicle, {0.31, 0.1, 0.1}, 0.5, true},    // 71
    {BoneId::kHead, {0.49, 0.0, 1.9}, 0.1, false},       // 72
    {BoneId::kHead, {0.40, 0.0, 0.5}, 1.0, false},       // 73
});
constexpr auto kBestFull250Edges = std::to_array<LayoutEdge>({
    {4, 11, false},  {1, 12, false},  {8, 12, false},  {1, 15, false},  {2, 15, false},
    {12, 16, false}, {6, 18, false},  {13, 19, false}, {19, 21, false}, {13, 20, false},
    {25, 26, false}, {11, 23, false}, {8, 29, false},  {4, 27, false},  {29, 30, false},
    {2, 32, false},  {1, 9, false},   {12, 12, true},  {9, 10, false},  {31, 33, false},
    {17, 35, false}, {5, 36, false},  {33, 39, false}, {9, 41, false},  {17, 36, false},
    {4, 44, false},  {5, 45, false},  {44, 45, false}, {28, 48, false}, {32, 51, false},
    {6, 52, false},  {32, 52, false}, {18, 53, false}, {42, 53, false}, {39, 46, false},
    {18, 57, false}, {34, 57, false}, {54, 56, true},  {7, 28, false},  {34, 59, false},
    {54, 56, false}, {37, 55, false}, {0, 1, false},   {0, 24, false},  {14, 61, false},
    {13, 62, false}, {49, 62, false}, {7, 63, false},  {17, 63, false}, {8, 50, false},
    {50, 58, true},  {3, 64, false},  {49, 64, false}, {10, 65, false}, {14, 65, false},
    {10, 66, false}, {31, 66, false}, {3, 60, false},  {41, 68, false}, {12, 69, false},
    {37, 69, false}, {60, 70, false}, {54, 71, false}, {39, 72, false}, {67, 72, false},
    {9, 73, false},  {31, 73, false},
});

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
    {BoneId::kRibs, {1.20, 0.49, 0.18}, 0.91, true},        // 0
    {BoneId::kRibs, {1.02, 0.00, -0.04}, 1.84, false},      // 1
    {BoneId::kChest, {0.68, 0.00, -0.16}, 1.54, false},     // 2
    {BoneId::kUpperArm, {0.21, -0.05, -0.07}, 1.27, true},  // 3
    {BoneId::kHand, {0.92, -0.30, -0.40}, 1.11, true},      // 4
    {BoneId::kBelly, {0.26, 0.54, -0.05}, 1.35, true},      // 5
    {BoneId::kThigh, {0.50, -0.07, 0.20}, 1.24, true},      // 6
    {BoneId::kShin, {1.63, -0.00, -0.11}, 0.84, true},      // 7
    {BoneId::kHand, {0.56, -0.26, 1.35}, 1.58, true},       // 8
    {BoneId::kHead, {0.65, 0.00, 0.17}, 1.74, false},       // 9
    {BoneId::kHead, {0.46, 0.00, 0.55}, 1.76, false},       // 10
    {BoneId::kFoot, {0.91, -0.05, 0.31}, 1.50, true},       // 11
});
constexpr auto kShellFull32Edges = std::to_array<LayoutEdge>(
    {{6, 7, false}, {3, 4, false}, {7, 11, false}, {0, 5, false}, {5, 6, false}, {2, 3, false}});

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

// 68 + 60 for enclosing, with head, hands and feet.
constexpr auto kShellFull128Nodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.92, 0.00, -0.22}, 0.89, false},     // 0
    {BoneId::kClavicle, {0.28, -0.65, -0.13}, 1.31, true},  // 1
    {BoneId::kChest, {0.42, 0.00, -0.95}, 0.55, false},     // 2
    {BoneId::kClavicle, {1.04, 0.04, -0.11}, 0.89, true},   // 3
    {BoneId::kPelvis, {0.64, 0.47, 0.07}, 1.75, true},      // 4
    {BoneId::kShin, {0.83, 0.08, -0.18}, 0.42, true},       // 5
    {BoneId::kHand, {0.53, -0.04, -0.69}, 1.07, true},      // 6
    {BoneId::kFoot, {0.88, 0.16, 0.14}, 1.66, true},        // 7
    {BoneId::kShin, {0.35, 0.00, -0.25}, 1.06, true},       // 8
    {BoneId::kHead, {0.71, 0.00, -0.03}, 0.33, false},      // 9
    {BoneId::kShin, {0.40, 0.02, 0.19}, 0.70, true},        // 10
    {BoneId::kHead, {0.55, 0.00, -0.04}, 1.38, false},      // 11
    {BoneId::kBelly, {0.96, 0.31, 0.05}, 0.97, true},       // 12
    {BoneId::kUpperArm, {1.02, 0.01, -0.01}, 0.87, true},   // 13
    {BoneId::kRibs, {0.96, 0.68, 0.43}, 0.95, true},        // 14
    {BoneId::kClavicle, {0.42, -0.08, -0.21}, 1.34, true},  // 15
    {BoneId::kBelly, {0.25, 0.00, 0.02}, 1.28, false},      // 16
    {BoneId::kHead, {0.34, 0.00, 1.33}, 0.86, false},       // 17
    {BoneId::kHead, {0.64, 0.00, 2.01}, 0.13, false},       // 18
    {BoneId::kHand, {0.07, 0.01, 0.00}, 0.99, true},        // 19
    {BoneId::kHead, {0.71, 0.00, 0.54}, 1.28, false},       // 20
    {BoneId::kHand, {0.80, -0.14, -0.09}, 1.40, true},      // 21
    {BoneId::kHead, {0.70, 0.00, 0.11}, 1.35, false},       // 22
    {BoneId::kHead, {0.51, 0.00, 2.08}, 0.32, false},       // 23
    {BoneId::kHeel, {0.61, 0.08, -0.51}, 1.37, true},       // 24
    {BoneId::kPelvis, {0.81, 0.44, 0.20}, 1.51, true},      // 25
    {BoneId::kHead, {0.70, 0.00, -0.31}, 1.27, false},      // 26
    {BoneId::kThigh, {0.32, -0.11, 0.41}, 1.24, true},      // 27
    {BoneId::kHead, {0.47, 0.00, 0.45}, 1.18, false},       // 28
    {BoneId::kThigh, {0.96, -0.02, -0.04}, 0.85, true},     // 29
    {BoneId::kShin, {0.95, 0.01, 0.10}, 0.57, true},        // 30
    {BoneId::kFoot, {0.30, 0.01, -1.02}, 1.47, true},       // 31
    {BoneId::kForearm, {0.36, -0.00, -0.04}, 1.07, true},   // 32
    {BoneId::kThigh, {0.21, -0.27, 0.23}, 1.40, true},      // 33
    {BoneId::kRibs, {1.14, 0.56, -0.09}, 1.23, true},       // 34
    {BoneId::kThigh, {0.30, -0.12, 0.11}, 1.27, true},      // 35
    {BoneId::kBelly, {0.99, 0.58, -0.01}, 0.88, true},      // 36
    {BoneId::kUpperArm, {0.10, -0.12, -0.04}, 1.41, true},  // 37
    {BoneId::kHand, {0.63, -0.34, 2.30}, 0.63, true},       // 38
    {BoneId::kRibs, {1.31, 0.47, -0.17}, 1.25, true},       // 39
});
constexpr auto kShellFull128Edges = std::to_array<LayoutEdge>({
    {0, 3, false},   {1, 14, false},  {12, 16, false}, {6, 19, false},  {18, 20, false},
    {9, 17, false},  {5, 24, false},  {12, 25, false}, {22, 26, false}, {15, 15, true},
    {10, 27, false}, {2, 28, false},  {8, 29, false},  {8, 30, false},  {7, 31, false},
    {13, 32, false}, {19, 32, false}, {4, 33, false},  {10, 35, false}, {34, 36, false},
    {11, 26, false}, {19, 38, false}, {6, 38, false},  {30, 31, false}, {12, 34, true},
    {3, 39, false},  {15, 39, true},  {25, 36, false}, {24, 31, false}, {14, 39, false},
    {13, 37, false}, {4, 25, true},   {17, 20, false}, {17, 22, false},
});

// 91 + 88 for enclosing, with head, hands and feet.
constexpr auto kShellFull180Nodes = std::to_array<LayoutNode>({
    {BoneId::kRibs, {1.19, 0.55, -0.10}, 1.26, true},       // 0
    {BoneId::kChest, {0.92, 0.00, -0.26}, 0.89, false},     // 1
    {BoneId::kUpperArm, {0.09, 0.00, -0.05}, 1.25, true},   // 2
    {BoneId::kHeel, {0.64, 0.10, -0.43}, 1.30, true},       // 3
    {BoneId::kFoot, {1.08, 0.41, 0.67}, 0.70, true},        // 4
    {BoneId::kShin, {0.44, 0.01, -0.20}, 0.98, true},       // 5
    {BoneId::kThigh, {0.28, -0.12, 0.38}, 1.29, true},      // 6
    {BoneId::kRibs, {0.71, 0.00, 0.19}, 0.93, false},       // 7
    {BoneId::kShin, {0.89, 0.01, 0.04}, 0.63, true},        // 8
    {BoneId::kRibs, {0.96, 0.67, 0.44}, 0.95, true},        // 9
    {BoneId::kClavicle, {0.32, -0.65, -0.10}, 1.55, true},  // 10
    {BoneId::kHead, {0.59, 0.00, -0.48}, 1.02, false},      // 11
    {BoneId::kHead, {0.38, 0.00, 1.13}, 0.95, false},       // 12
    {BoneId::kHead, {0.28, 0.00, 0.29}, 1.01, false},       // 13
    {BoneId::kPelvis, {0.89, 0.66, 0.23}, 1.46, true},      // 14
    {BoneId::kHead, {0.71, 0.00, 0.56}, 1.26, false},       // 15
    {BoneId::kHead, {0.59, 0.00, 0.11}, 1.39, false},       // 16
    {BoneId::kBelly, {0.23, 0.24, -0.01}, 1.28, true},      // 17
    {BoneId::kFoot, {0.72, 0.07, 0.02}, 0.90, true},        // 18
    {BoneId::kHead, {0.51, 0.01, 2.22}, 0.17, true},        // 19
    {BoneId::kHead, {0.70, 0.00, -0.34}, 1.24, false},      // 20
    {BoneId::kShin, {1.84, -0.24, -0.07}, 0.46, true},      // 21
    {BoneId::kFoot, {0.14, -0.06, -0.40}, 1.24, true},      // 22
    {BoneId::kShin, {0.36, -0.01, -0.51}, 0.81, true},      // 23
    {BoneId::kForearm, {0.41, -0.01, -0.06}, 1.04, true},   // 24
    {BoneId::kThigh, {0.38, -0.08, 0.12}, 1.25, true},      // 25
    {BoneId::kBelly, {0.88, 0.67, -0.01}, 0.84, true},      // 26
    {BoneId::kFoot, {0.97, -0.86, 0.56}, 0.78, true},       // 27
    {BoneId::kHead, {0.30, 0.00, 1.83}, 0.34, false},       // 28
    {BoneId::kUpperArm, {0.14, -0.05, -0.00}, 1.31, true},  // 29
    {BoneId::kClavicle, {0.51, 0.07, -0.19}, 1.21, true},   // 30
    {BoneId::kFoot, {0.95, 1.28, 0.40}, 0.70, true},        // 31
    {BoneId::kUpperArm, {0.19, -0.01, -0.19}, 1.19, true},  // 32
    {BoneId::kRibs, {0.60, 0.28, 0.26}, 0.75, true},        // 33
    {BoneId::kHead, {0.72, 0.00, 0.12}, 1.33, false},       // 34
    {BoneId::kUpperArm, {1.00, 0.01, 0.18}, 0.69, true},    // 35
    {BoneId::kShin, {1.82, 0.08, -0.18}, 0.50, true},       // 36
    {BoneId::kPelvis, {0.65, 0.49, -0.04}, 1.65, true},     // 37
    {BoneId::kHand, {0.04, 0.05, -0.18}, 0.72, true},       // 38
    {BoneId::kHand, {1.01, -0.21, 0.10}, 0.71, true},       // 39
    {BoneId::kHand, {0.50, -0.06, 1.35}, 0.58, true},       // 40
    {BoneId::kHand, {0.63, -0.34, 2.46}, 0.53, true},       // 41
    {BoneId::kThigh, {0.95, -0.01, 0.18}, 0.82, true},      // 42
    {BoneId::kForearm, {0.31, 0.01, 0.29}, 0.79, true},     // 43
    {BoneId::kThigh, {0.20, -0.14, -0.45}, 0.76, true},     // 44
    {BoneId::kRibs, {0.29, 0.58, -0.03}, 0.97, true},       // 45
    {BoneId::kThigh, {0.29, -0.16, 1.18}, 0.34, true},      // 46
    {BoneId::kHand, {0.92, -0.23, -1.23}, 0.50, true},      // 47
    {BoneId::kThigh, {0.94, -0.01, -0.04}, 0.83, true},     // 48
    {BoneId::kHead, {0.58, 0.00, 0.86}, 0.86, false},       // 49
    {BoneId::kUpperArm, {0.74, -0.01, -0.12}, 0.91, true},  // 50
});
constexpr auto kShellFull180Edges = std::to_array<LayoutEdge>(
    {{1, 2, false},   {3, 8, false},   {0, 9, false},   {11, 13, false}, {7, 14, false},
     {21, 27, false}, {0, 2, true},    {1, 10, false},  {12, 28, false}, {10, 30, false},
     {0, 26, true},   {20, 34, false}, {29, 35, false}, {24, 38, false}, {21, 36, false},
     {31, 36, false}, {4, 36, false},  {18, 22, false}, {14, 25, false}, {39, 40, false},
     {10, 10, true},  {38, 41, false}, {5, 42, false},  {6, 42, false},  {39, 43, false},
     {25, 44, false}, {37, 44, false}, {0, 45, false},  {5, 8, false},   {9, 30, false},
     {43, 47, false}, {23, 48, false}, {25, 48, false}, {17, 33, false}, {1, 49, false},
     {26, 45, false}, {17, 46, false}, {15, 19, false}, {13, 34, false}, {19, 28, false},
     {8, 22, false},  {24, 50, false}, {32, 50, false}, {14, 26, false}, {2, 10, true},
     {12, 15, false}, {12, 16, false}, {20, 49, false}, {11, 16, false}});

// 101 + 138 for enclosing, with head, hands and feet. Made with more spheres in the hands, which on
// real fingers met in the air: these are those of the 64.
constexpr auto kShellFull250Nodes = std::to_array<LayoutNode>({
    {BoneId::kRibs, {1.24, 0.5, -0.1}, 1.3, true},       // 0
    {BoneId::kChest, {0.94, 0.0, -0.3}, 0.8, false},     // 1
    {BoneId::kUpperArm, {0.10, -0.0, -0.1}, 1.2, true},  // 2
    {BoneId::kBelly, {0.21, -0.2, -0.0}, 1.0, true},     // 3
    {BoneId::kThigh, {0.88, -0.0, 0.3}, 0.8, true},      // 4
    {BoneId::kHeel, {0.64, 0.1, -0.4}, 1.3, true},       // 5
    {BoneId::kFoot, {0.97, -0.8, 0.6}, 0.7, true},       // 6
    {BoneId::kShin, {0.44, 0.0, -0.2}, 1.0, true},       // 7
    {BoneId::kHead, {0.63, 0.5, 1.2}, 0.5, true},        // 8
    {BoneId::kThigh, {0.37, -0.1, 0.4}, 1.2, true},      // 9
    {BoneId::kHead, {0.71, 0.0, 0.2}, 1.3, false},       // 10
    {BoneId::kRibs, {0.10, 0.3, 0.1}, 0.9, true},        // 11
    {BoneId::kShin, {0.85, 0.0, 0.0}, 0.6, true},        // 12
    {BoneId::kRibs, {0.98, 0.7, 0.6}, 0.9, true},        // 13
    {BoneId::kClavicle, {0.32, -0.4, -0.2}, 1.5, true},  // 14
    {BoneId::kThigh, {0.18, -0.2, -0.0}, 1.2, true},     // 15
    {BoneId::kBelly, {0.22, 0.0, 0.2}, 1.1, false},      // 16
    {BoneId::kForearm, {1.24, 0.0, -0.4}, 0.5, true},    // 17
    {BoneId::kHead, {0.62, 0.0, -0.5}, 1.1, false},      // 18
    {BoneId::kHead, {0.40, 0.0, 1.0}, 1.0, false},       // 19
    {BoneId::kHead, {0.27, 0.0, 0.1}, 0.9, false},       // 20
    {BoneId::kPelvis, {0.90, 0.7, 0.2}, 1.3, true},      // 21
    {BoneId::kHead, {0.71, 0.0, 0.6}, 1.3, false},       // 22
    {BoneId::kHead, {0.59, 0.0, 0.1}, 1.4, false},       // 23
    {BoneId::kPelvis, {0.65, 0.4, -0.1}, 1.5, true},     // 24
    {BoneId::kFoot, {0.83, 0.1, 0.2}, 0.7, true},        // 25
    {BoneId::kHead, {0.51, 0.0, 2.3}, 0.1, false},       // 26
    {BoneId::kHead, {0.71, 0.0, -0.5}, 1.1, false},      // 27
    {BoneId::kThigh, {0.16, -0.4, 0.7}, 0.9, true},      // 28
    {BoneId::kShin, {1.81, -0.1, -0.2}, 0.6, true},      // 29
    {BoneId::kRibs, {0.25, 0.6, -0.0}, 0.9, true},       // 30
    {BoneId::kFoot, {0.13, -0.1, -0.4}, 1.2, true},      // 31
    {BoneId::kShin, {0.33, -0.0, -0.5}, 0.8, true},      // 32
    {BoneId::kForearm, {0.42, -0.0, -0.1}, 1.1, true},   // 33
    {BoneId::kThigh, {0.39, -0.1, 0.1}, 1.2, true},      // 34
    {BoneId::kBelly, {0.87, 0.7, -0.0}, 0.8, true},      // 35
    {BoneId::kThigh, {0.94, -0.0, -0.0}, 0.8, true},     // 36
    {BoneId::kThigh, {0.00, 0.0, 0.2}, 1.1, true},       // 37
    {BoneId::kFoot, {0.82, -0.9, 0.2}, 0.7, true},       // 38
    {BoneId::kHead, {0.29, 0.0, 1.7}, 0.4, false},       // 39
    {BoneId::kThigh, {0.33, -0.1, 0.3}, 1.2, true},      // 40
    {BoneId::kUpperArm, {0.17, -0.0, 0.0}, 1.3, true},   // 41
    {BoneId::kClavicle, {0.64, -0.0, -0.2}, 1.1, true},  // 42
    {BoneId::kFoot, {0.99, 1.1, 0.5}, 0.6, true},        // 43
    {BoneId::kUpperArm, {0.16, -0.0, -0.1}, 1.3, true},  // 44
    {BoneId::kBelly, {0.58, 0.4, 0.0}, 1.0, true},       // 45
    {BoneId::kHead, {0.72, 0.0, -0.1}, 1.3, false},      // 46
    {BoneId::kForearm, {0.06, 0.0, 0.1}, 0.9, true},     // 47
    {BoneId::kUpperArm, {0.77, -0.0, -0.2}, 0.8, true},  // 48
    {BoneId::kUpperArm, {0.67, -0.0, 0.1}, 0.9, true},   // 49
    {BoneId::kThigh, {-0.06, -0.2, 0.2}, 1.2, true},     // 50
    {BoneId::kFoot, {0.78, 1.2, 0.0}, 0.7, true},        // 51
    {BoneId::kPelvis, {0.79, -0.1, -0.3}, 1.1, true},    // 52
    {BoneId::kHead, {0.36, 0.0, 0.8}, 0.9, false},       // 53
    {BoneId::kThigh, {0.15, -0.1, 0.3}, 1.2, true},      // 54
    {BoneId::kHand, {0.15, -0.1, -0.2}, 1.2, true},      // 55
    {BoneId::kHand, {0.71, -0.4, 0.6}, 2.3, true},       // 56
});
constexpr auto kShellFull250Edges = std::to_array<LayoutEdge>(
    {{1, 8, false},   {1, 2, false},   {0, 11, false},  {5, 12, false},  {3, 11, false},
     {0, 13, false},  {0, 14, false},  {0, 11, true},   {18, 20, false}, {11, 21, false},
     {11, 16, false}, {19, 22, false}, {20, 23, false}, {5, 25, false},  {19, 26, false},
     {9, 28, false},  {3, 11, true},   {0, 30, false},  {12, 31, false}, {7, 32, false},
     {16, 30, false}, {22, 26, false}, {0, 14, true},   {32, 36, false}, {34, 36, false},
     {21, 37, false}, {29, 38, false}, {30, 35, false}, {0, 2, true},    {1, 14, false},
     {19, 39, false}, {2, 41, false},  {14, 42, false}, {6, 43, false},  {0, 42, false},
     {1, 42, false},  {0, 35, true},   {24, 45, true},  {10, 46, false}, {27, 46, false},
     {15, 34, false}, {36, 40, false}, {4, 9, false},   {9, 36, false},  {21, 35, false},
     {44, 47, false}, {24, 45, false}, {44, 48, false}, {17, 55, false}, {41, 49, false},
     {33, 55, false}, {3, 50, true},   {4, 7, false},   {29, 51, false}, {43, 51, false},
     {15, 52, false}, {24, 52, false}, {16, 28, false}, {33, 47, false}, {2, 44, false},
     {19, 53, false}, {23, 53, false}, {9, 50, false},  {40, 54, false}, {50, 54, false},
     {33, 48, false}, {7, 12, false},  {34, 37, false}, {6, 51, false},  {25, 31, false},
     {8, 19, false},  {55, 56, false}});

// 58 + 69 for enclosing, without head, hands and feet.
constexpr auto kShell128Nodes = std::to_array<LayoutNode>({
    {BoneId::kRibs, {0.96, 0.7, 0.6}, 0.9, true},        // 0
    {BoneId::kForearm, {0.94, -0.1, 0.0}, 0.8, true},    // 1
    {BoneId::kPelvis, {0.77, 0.5, 0.1}, 1.5, true},      // 2
    {BoneId::kShin, {0.05, -0.0, -0.1}, 1.1, true},      // 3
    {BoneId::kShin, {0.94, -0.1, -0.2}, 0.6, true},      // 4
    {BoneId::kRibs, {1.18, 0.5, -0.1}, 1.3, true},       // 5
    {BoneId::kBelly, {0.28, 0.0, 0.3}, 1.1, false},      // 6
    {BoneId::kThigh, {0.39, -0.0, 0.3}, 1.2, true},      // 7
    {BoneId::kUpperArm, {0.03, -0.1, -0.1}, 1.4, true},  // 8
    {BoneId::kClavicle, {0.26, 0.6, -0.4}, 1.1, true},   // 9
    {BoneId::kBelly, {0.71, 0.0, 0.2}, 0.8, false},      // 10
    {BoneId::kForearm, {0.53, -0.0, -0.3}, 0.9, true},   // 11
    {BoneId::kClavicle, {0.58, -0.6, -0.0}, 1.3, true},  // 12
    {BoneId::kShin, {0.35, -0.0, -0.2}, 1.1, true},      // 13
    {BoneId::kChest, {0.84, 0.0, -0.2}, 1.1, false},     // 14
    {BoneId::kThigh, {0.19, -0.2, 0.2}, 1.3, true},      // 15
    {BoneId::kBelly, {0.06, 0.7, 0.5}, 0.5, true},       // 16
    {BoneId::kRibs, {-0.00, 0.7, -0.0}, 0.8, true},      // 17
    {BoneId::kBelly, {0.21, 0.0, 0.0}, 1.3, false},      // 18
    {BoneId::kPelvis, {0.70, 0.3, -0.3}, 1.3, true},     // 19
    {BoneId::kClavicle, {0.37, -0.5, -0.2}, 1.7, true},  // 20
    {BoneId::kBelly, {0.51, 0.6, 0.1}, 1.1, true},       // 21
    {BoneId::kShin, {0.94, -0.1, 0.1}, 0.6, true},       // 22
    {BoneId::kShin, {0.50, -0.1, -0.5}, 0.8, true},      // 23
    {BoneId::kShin, {0.15, -0.0, 0.2}, 1.0, true},       // 24
    {BoneId::kForearm, {0.32, -0.0, 0.0}, 1.1, true},    // 25
    {BoneId::kUpperArm, {0.24, -0.1, 0.1}, 0.8, true},   // 26
    {BoneId::kForearm, {0.21, 0.0, 0.1}, 0.9, true},     // 27
    {BoneId::kBelly, {0.35, 0.7, -0.1}, 0.9, true},      // 28
    {BoneId::kChest, {0.21, 0.0, -0.2}, 1.8, false},     // 29
    {BoneId::kThigh, {0.31, -0.0, 0.1}, 1.2, true},      // 30
    {BoneId::kChest, {0.44, 0.0, -0.4}, 1.2, false},     // 31
});
constexpr auto kShell128Edges = std::to_array<LayoutEdge>({
    {8, 9, false},   {1, 11, false},  {6, 12, false},  {8, 12, false},  {5, 9, true},
    {5, 10, false},  {7, 15, false},  {2, 18, false},  {17, 18, false}, {0, 5, false},
    {15, 19, false}, {5, 20, false},  {2, 21, false},  {17, 21, false}, {2, 15, false},
    {13, 22, false}, {4, 23, false},  {3, 13, false},  {7, 24, false},  {1, 25, false},
    {11, 27, false}, {15, 28, false}, {20, 20, true},  {3, 30, false},  {9, 31, false},
    {8, 11, false},  {12, 20, false}, {2, 21, true},   {16, 21, true},  {0, 12, false},
    {16, 28, false}, {13, 24, false}, {13, 23, false}, {15, 21, true},  {17, 28, false},
});

// 87 + 92 for enclosing, without head, hands and feet.
constexpr auto kShell180Nodes = std::to_array<LayoutNode>({
    {BoneId::kRibs, {1.22, 0.55, -0.14}, 1.24, true},       // 0
    {BoneId::kForearm, {0.93, -0.08, -0.17}, 0.68, true},   // 1
    {BoneId::kPelvis, {0.64, 0.45, 0.01}, 1.65, true},      // 2
    {BoneId::kShin, {0.11, -0.01, 0.30}, 0.94, true},       // 3
    {BoneId::kShin, {0.96, -0.14, 0.15}, 0.61, true},       // 4
    {BoneId::kBelly, {0.25, 0.00, 0.01}, 1.27, false},      // 5
    {BoneId::kThigh, {0.39, -0.05, 0.21}, 1.22, true},      // 6
    {BoneId::kClavicle, {0.35, 0.65, -0.49}, 0.96, true},   // 7
    {BoneId::kClavicle, {0.41, -0.45, -0.25}, 1.57, true},  // 8
    {BoneId::kShin, {0.48, -0.07, -0.16}, 1.07, true},      // 9
    {BoneId::kChest, {0.93, 0.00, -0.53}, 0.73, false},     // 10
    {BoneId::kThigh, {0.28, -0.26, 1.14}, 0.35, true},      // 11
    {BoneId::kBelly, {0.43, 1.01, -0.06}, 0.53, true},      // 12
    {BoneId::kPelvis, {0.73, 0.34, 0.44}, 1.15, true},      // 13
    {BoneId::kRibs, {1.20, 0.79, 0.20}, 0.94, true},        // 14
    {BoneId::kThigh, {1.00, -0.01, 0.08}, 0.78, true},      // 15
    {BoneId::kThigh, {0.27, -0.07, 0.04}, 1.19, true},      // 16
    {BoneId::kShin, {0.04, -0.01, -0.09}, 1.10, true},      // 17
    {BoneId::kShin, {0.95, -0.13, -0.14}, 0.57, true},      // 18
    {BoneId::kPelvis, {0.87, 0.32, 0.25}, 0.62, true},      // 19
    {BoneId::kThigh, {0.38, -0.06, 0.33}, 1.19, true},      // 20
    {BoneId::kUpperArm, {0.16, -0.03, 0.08}, 1.23, true},   // 21
    {BoneId::kClavicle, {0.35, -0.86, -0.18}, 1.68, true},  // 22
    {BoneId::kChest, {0.87, 0.49, -0.22}, 0.81, true},      // 23
    {BoneId::kClavicle, {0.71, -0.11, -0.16}, 1.20, true},  // 24
    {BoneId::kForearm, {0.27, -0.02, -0.06}, 1.14, true},   // 25
    {BoneId::kChest, {0.90, 0.20, 0.83}, 0.13, true},       // 26
    {BoneId::kShin, {0.56, -0.08, -0.50}, 0.82, true},      // 27
    {BoneId::kForearm, {0.69, -0.08, -0.46}, 0.64, true},   // 28
    {BoneId::kShin, {0.41, -0.07, -0.53}, 0.88, true},      // 29
    {BoneId::kForearm, {0.94, -0.06, 0.28}, 0.63, true},    // 30
    {BoneId::kUpperArm, {0.87, -0.00, 0.19}, 0.72, true},   // 31
    {BoneId::kUpperArm, {0.15, -0.03, -0.14}, 1.25, true},  // 32
    {BoneId::kRibs, {0.98, 0.33, 0.23}, 0.75, true},        // 33
    {BoneId::kThigh, {0.12, -0.24, -0.29}, 1.02, true},     // 34
    {BoneId::kRibs, {0.02, 0.31, 0.04}, 0.98, true},        // 35
    {BoneId::kBelly, {0.37, 0.70, 0.03}, 1.07, true},       // 36
    {BoneId::kChest, {0.45, 0.00, -0.42}, 1.07, false},     // 37
    {BoneId::kThigh, {-0.61, -0.21, 0.28}, 1.30, true},     // 38
    {BoneId::kChest, {0.41, 0.00, -0.43}, 0.88, false},     // 39
    {BoneId::kRibs, {0.94, 0.58, 0.17}, 1.09, true},        // 40
    {BoneId::kRibs, {0.24, 0.63, -0.04}, 0.91, true},       // 41
    {BoneId::kBelly, {0.60, 0.00, 0.25}, 0.75, false},      // 42
    {BoneId::kUpperArm, {0.10, 0.02, -0.08}, 1.23, true},   // 43
    {BoneId::kBelly, {0.46, 0.27, 0.05}, 1.16, true},       // 44
    {BoneId::kRibs, {0.96, 0.78, 0.61}, 0.76, true},        // 45
});
constexpr auto kShell180Edges = std::to_array<LayoutEdge>(
    {{12, 13, false}, {9, 15, false},  {6, 17, false},  {16, 17, false}, {6, 19, false},
     {3, 20, false},  {1, 25, false},  {10, 26, false}, {23, 26, false}, {0, 24, false},
     {18, 27, false}, {10, 22, false}, {27, 29, false}, {25, 30, false}, {25, 31, false},
     {21, 28, false}, {4, 9, false},   {28, 32, false}, {0, 8, true},    {5, 11, false},
     {2, 34, false},  {0, 35, false},  {14, 39, false}, {35, 36, false}, {33, 38, false},
     {0, 41, false},  {12, 41, false}, {39, 42, false}, {7, 43, false},  {40, 43, true},
     {25, 28, false}, {14, 22, false}, {2, 44, false},  {36, 41, true},  {13, 20, false},
     {0, 35, true},   {23, 24, true},  {17, 29, false}, {6, 38, false},  {33, 44, true},
     {37, 40, false}, {8, 8, true},    {15, 17, false}, {7, 39, false},  {24, 37, false},
     {14, 45, false}, {7, 8, false}});

// 108 + 141 for enclosing, without head, hands and feet.
constexpr auto kShell250Nodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.36, 0.0, 0.1}, 1.1, false},      // 0
    {BoneId::kRibs, {1.14, 0.6, -0.1}, 1.2, true},       // 1
    {BoneId::kForearm, {0.94, -0.1, -0.2}, 0.6, true},   // 2
    {BoneId::kPelvis, {0.67, 0.4, -0.1}, 1.6, true},     // 3
    {BoneId::kShin, {0.07, -0.0, 0.2}, 1.0, true},       // 4
    {BoneId::kShin, {0.95, -0.1, 0.1}, 0.6, true},       // 5
    {BoneId::kClavicle, {0.33, -0.8, -0.2}, 1.7, true},  // 6
    {BoneId::kBelly, {0.24, 0.0, 0.1}, 1.2, false},      // 7
    {BoneId::kThigh, {0.33, -0.1, 0.3}, 1.2, true},      // 8
    {BoneId::kUpperArm, {0.03, -0.0, -0.1}, 1.2, true},  // 9
    {BoneId::kChest, {0.72, 0.5, -0.5}, 1.0, true},      // 10
    {BoneId::kBelly, {0.46, 0.0, 0.4}, 0.8, false},      // 11
    {BoneId::kClavicle, {0.52, -0.8, 0.1}, 1.4, true},   // 12
    {BoneId::kShin, {0.49, -0.1, -0.1}, 1.0, true},      // 13
    {BoneId::kChest, {1.46, 0.0, -0.6}, 0.2, false},     // 14
    {BoneId::kThigh, {0.30, -0.2, 0.6}, 0.9, true},      // 15
    {BoneId::kBelly, {-0.03, 0.4, 0.5}, 0.7, true},      // 16
    {BoneId::kBelly, {1.06, 0.6, 0.0}, 0.8, true},       // 17
    {BoneId::kBelly, {0.22, 0.0, -0.0}, 1.3, false},     // 18
    {BoneId::kBelly, {0.42, 0.7, 0.1}, 1.1, true},       // 19
    {BoneId::kRibs, {0.97, 0.7, 0.6}, 0.8, true},        // 20
    {BoneId::kShin, {0.13, -0.0, -0.3}, 1.0, true},      // 21
    {BoneId::kShin, {0.24, -0.0, -0.1}, 1.1, true},      // 22
    {BoneId::kThigh, {0.11, -0.1, -0.2}, 1.0, true},     // 23
    {BoneId::kThigh, {0.98, -0.0, -0.1}, 0.8, true},     // 24
    {BoneId::kBelly, {0.54, -0.1, 0.3}, 0.9, true},      // 25
    {BoneId::kThigh, {0.23, -0.1, 0.1}, 1.2, true},      // 26
    {BoneId::kThigh, {0.70, -0.0, 0.1}, 1.0, true},      // 27
    {BoneId::kBelly, {0.23, 0.6, 0.2}, 1.0, true},       // 28
    {BoneId::kShin, {0.95, -0.1, -0.2}, 0.6, true},      // 29
    {BoneId::kPelvis, {0.92, 0.1, 0.2}, 1.3, true},      // 30
    {BoneId::kThigh, {0.48, -0.0, 0.3}, 1.1, true},      // 31
    {BoneId::kUpperArm, {0.16, -0.0, 0.1}, 1.3, true},   // 32
    {BoneId::kClavicle, {0.58, -0.1, -0.1}, 1.2, true},  // 33
    {BoneId::kChest, {0.90, 0.4, -0.1}, 0.7, true},      // 34
    {BoneId::kClavicle, {0.80, 0.3, -0.3}, 0.9, true},   // 35
    {BoneId::kForearm, {0.40, -0.0, -0.1}, 1.1, true},   // 36
    {BoneId::kChest, {0.88, 0.1, 0.6}, 0.2, true},       // 37
    {BoneId::kClavicle, {0.67, -0.8, -0.2}, 0.7, true},  // 38
    {BoneId::kShin, {0.56, -0.1, -0.5}, 0.8, true},      // 39
    {BoneId::kForearm, {0.38, -0.0, -0.1}, 1.0, true},   // 40
    {BoneId::kUpperArm, {0.79, -0.0, -0.1}, 0.9, true},  // 41
    {BoneId::kShin, {0.43, -0.1, -0.5}, 0.9, true},      // 42
    {BoneId::kForearm, {0.96, -0.0, 0.2}, 0.6, true},    // 43
    {BoneId::kShin, {0.76, -0.1, -0.0}, 0.8, true},      // 44
    {BoneId::kBelly, {0.76, 0.3, -0.0}, 0.8, true},      // 45
    {BoneId::kChest, {0.32, 0.0, -0.4}, 1.7, false},     // 46
    {BoneId::kRibs, {0.95, 0.3, 0.4}, 0.7, true},        // 47
    {BoneId::kThigh, {0.08, -0.3, -0.4}, 0.9, true},     // 48
    {BoneId::kForearm, {0.11, -0.0, -0.1}, 1.0, true},   // 49
    {BoneId::kUpperArm, {0.81, -0.0, 0.1}, 0.9, true},   // 50
    {BoneId::kRibs, {0.81, 0.7, 0.3}, 0.7, true},        // 51
    {BoneId::kClavicle, {0.46, 0.0, -0.3}, 1.2, true},   // 52
    {BoneId::kShin, {0.37, -0.1, -0.5}, 0.9, true},      // 53
    {BoneId::kUpperArm, {0.22, -0.0, -0.2}, 1.2, true},  // 54
    {BoneId::kRibs, {0.18, 0.7, -0.1}, 0.8, true},       // 55
    {BoneId::kUpperArm, {0.46, -0.0, 0.1}, 1.0, true},   // 56
});
constexpr auto kShell250Edges = std::to_array<LayoutEdge>({
    {9, 12, false},  {6, 10, true},   {6, 11, false},  {6, 10, false},  {17, 18, false},
    {17, 19, false}, {1, 20, false},  {7, 19, false},  {6, 17, true},   {6, 20, false},
    {4, 22, false},  {13, 22, false}, {3, 23, false},  {8, 27, false},  {24, 27, false},
    {3, 28, false},  {19, 28, false}, {1, 12, false},  {3, 19, false},  {26, 27, false},
    {6, 17, false},  {15, 25, true},  {8, 30, false},  {28, 30, false}, {4, 31, false},
    {8, 31, false},  {9, 32, false},  {17, 28, false}, {9, 35, false},  {10, 35, false},
    {2, 36, false},  {14, 37, false}, {34, 37, false}, {1, 35, false},  {29, 39, false},
    {32, 41, false}, {0, 20, false},  {14, 33, false}, {39, 42, false}, {40, 41, false},
    {6, 35, false},  {36, 43, false}, {5, 44, false},  {13, 44, false}, {1, 45, false},
    {23, 24, false}, {22, 24, false}, {14, 46, false}, {19, 47, true},  {20, 47, false},
    {3, 48, false},  {26, 48, false}, {40, 50, false}, {36, 49, false}, {6, 52, false},
    {33, 52, false}, {21, 53, false}, {9, 54, false},  {41, 54, false}, {7, 55, false},
    {12, 55, false}, {22, 42, false}, {19, 45, false}, {19, 25, true},  {36, 40, false},
    {46, 51, false}, {18, 45, false}, {10, 46, false}, {32, 56, false}, {50, 56, false},
    {9, 52, false},
});

// 159 + 191 for enclosing, with head, hands and feet.
constexpr auto kShellFull350Nodes = std::to_array<LayoutNode>({
    {BoneId::kClavicle, {0.34, -0.47, -0.13}, 1.50, true},  // 0
    {BoneId::kHead, {0.07, 0.00, 0.03}, 0.91, false},       // 1
    {BoneId::kChest, {0.82, 0.57, -0.26}, 0.84, true},      // 2
    {BoneId::kHand, {0.38, -0.09, -0.25}, 0.43, true},      // 3
    {BoneId::kPelvis, {0.65, 0.44, -0.05}, 1.63, true},     // 4
    {BoneId::kShin, {0.08, 0.01, 0.00}, 0.91, true},        // 5
    {BoneId::kHeel, {0.60, 0.14, -0.14}, 1.13, true},       // 6
    {BoneId::kFoot, {0.98, 1.21, 0.49}, 0.55, true},        // 7
    {BoneId::kShin, {0.41, 0.00, -0.11}, 0.95, true},       // 8
    {BoneId::kHead, {0.71, 0.00, 0.69}, 1.19, false},       // 9
    {BoneId::kThigh, {0.35, -0.10, 0.09}, 1.23, true},      // 10
    {BoneId::kHead, {0.71, 0.00, 0.35}, 1.32, false},       // 11
    {BoneId::kRibs, {0.14, 0.16, 0.07}, 0.97, true},        // 12
    {BoneId::kRibs, {0.95, 0.74, 0.62}, 0.78, true},        // 13
    {BoneId::kRibs, {0.27, 0.17, 0.22}, 0.73, true},        // 14
    {BoneId::kBelly, {0.64, 0.00, 0.09}, 1.08, false},      // 15
    {BoneId::kBelly, {0.03, 0.65, 0.63}, 0.57, true},       // 16
    {BoneId::kFoot, {0.12, -0.02, 0.13}, 1.13, true},       // 17
    {BoneId::kHead, {0.39, 0.00, 0.09}, 1.06, false},       // 18
    {BoneId::kHead, {0.48, 0.00, 0.14}, 1.01, false},       // 19
    {BoneId::kHead, {0.40, 0.00, 1.08}, 0.96, false},       // 20
    {BoneId::kHead, {0.69, 0.00, 0.52}, 1.12, false},       // 21
    {BoneId::kHeel, {0.14, 0.02, -0.16}, 1.44, true},       // 22
    {BoneId::kHead, {0.52, 0.00, 2.36}, 0.10, false},       // 23
    {BoneId::kForearm, {0.38, -0.00, -0.17}, 0.95, true},   // 24
    {BoneId::kBelly, {0.36, 0.64, 0.02}, 1.11, true},       // 25
    {BoneId::kThigh, {0.38, -0.08, 0.18}, 1.23, true},      // 26
    {BoneId::kThigh, {0.36, -0.11, 0.35}, 1.25, true},      // 27
    {BoneId::kHead, {0.35, 0.00, 0.95}, 0.92, false},       // 28
    {BoneId::kHead, {0.28, 0.00, 1.81}, 0.36, false},       // 29
    {BoneId::kThigh, {0.97, 0.01, 0.29}, 0.70, true},       // 30
    {BoneId::kShin, {0.30, 0.00, -0.20}, 0.92, true},       // 31
    {BoneId::kFoot, {0.73, -0.87, -0.04}, 0.81, true},      // 32
    {BoneId::kThigh, {0.73, -0.06, -0.00}, 0.78, true},     // 33
    {BoneId::kBelly, {0.24, 0.00, 0.24}, 0.92, false},      // 34
    {BoneId::kFoot, {0.84, -0.86, 0.26}, 0.75, true},       // 35
    {BoneId::kClavicle, {0.67, 0.38, -0.25}, 0.90, true},   // 36
    {BoneId::kFoot, {1.00, -0.67, 0.53}, 0.61, true},       // 37
    {BoneId::kFoot, {0.86, 1.14, 0.27}, 0.80, true},        // 38
    {BoneId::kFoot, {1.05, 0.08, 0.59}, 0.56, true},        // 39
    {BoneId::kRibs, {0.96, 0.43, -0.05}, 1.22, true},       // 40
    {BoneId::kFoot, {0.63, 0.08, -0.17}, 1.07, true},       // 41
    {BoneId::kShin, {0.39, 0.00, -0.11}, 0.94, true},       // 42
    {BoneId::kShin, {0.29, -0.01, -0.50}, 0.80, true},      // 43
    {BoneId::kUpperArm, {0.15, -0.04, 0.08}, 1.24, true},   // 44
    {BoneId::kForearm, {0.43, 0.00, 0.06}, 0.96, true},     // 45
    {BoneId::kShin, {0.88, 0.01, 0.19}, 0.49, true},        // 46
    {BoneId::kShin, {0.41, -0.02, 0.06}, 0.63, true},       // 47
    {BoneId::kClavicle, {0.25, 0.08, -0.25}, 1.26, true},   // 48
    {BoneId::kFoot, {0.74, 1.17, -0.10}, 0.73, true},       // 49
    {BoneId::kShin, {0.81, 0.01, -0.21}, 0.46, true},       // 50
    {BoneId::kShin, {0.37, 0.01, -0.52}, 0.77, true},       // 51
    {BoneId::kUpperArm, {0.13, -0.02, -0.13}, 1.29, true},  // 52
    {BoneId::kThigh, {0.82, -0.04, 0.06}, 0.76, true},      // 53
    {BoneId::kRibs, {1.34, 0.74, -0.03}, 1.10, true},       // 54
    {BoneId::kChest, {0.24, 0.48, -0.16}, 1.50, true},      // 55
    {BoneId::kHead, {0.71, 0.00, -0.38}, 1.20, false},      // 56
    {BoneId::kHand, {0.13, -0.02, 0.36}, 0.55, true},       // 57
    {BoneId::kThigh, {0.27, -0.12, -0.01}, 1.15, true},     // 58
    {BoneId::kUpperArm, {0.06, 0.18, -0.11}, 1.08, true},   // 59
    {BoneId::kHeel, {0.62, 0.07, -0.63}, 1.39, true},       // 60
    {BoneId::kShin, {0.75, 0.00, -0.11}, 0.58, true},       // 61
    {BoneId::kHead, {0.60, 0.00, 0.12}, 1.41, false},       // 62
    {BoneId::kPelvis, {0.71, 0.36, 0.77}, 0.65, true},      // 63
    {BoneId::kRibs, {0.61, 0.44, -0.16}, 0.71, true},       // 64
    {BoneId::kThigh, {0.94, -0.02, 0.08}, 0.83, true},      // 65
    {BoneId::kThigh, {0.14, -0.28, -0.33}, 0.98, true},     // 66
    {BoneId::kShin, {0.96, 0.00, -0.11}, 0.53, true},       // 67
    {BoneId::kChest, {0.41, 0.00, -0.14}, 1.01, false},     // 68
    {BoneId::kForearm, {0.72, -0.01, 0.04}, 0.46, true},    // 69
    {BoneId::kHand, {1.71, -0.24, 0.47}, 0.17, true},       // 70
    {BoneId::kHand, {0.50, -0.08, 1.40}, 0.52, true},       // 71
    {BoneId::kHand, {0.62, -0.41, 2.53}, 0.46, true},       // 72
    {BoneId::kHand, {0.59, -0.15, -1.01}, 0.57, true},      // 73
    {BoneId::kHand, {0.49, -0.13, -0.86}, 0.72, true},      // 74
    {BoneId::kRibs, {0.19, 0.61, -0.03}, 0.93, true},       // 75
    {BoneId::kBelly, {0.83, 0.64, 0.01}, 0.89, true},       // 76
    {BoneId::kHand, {0.66, -0.13, 0.35}, 0.85, true},       // 77
    {BoneId::kRibs, {1.29, 0.65, -0.17}, 1.15, true},       // 78
    {BoneId::kPelvis, {0.97, 0.70, 0.23}, 1.36, true},      // 79
    {BoneId::kHead, {0.59, 0.00, -0.53}, 0.97, false},      // 80
    {BoneId::kHand, {0.26, 0.00, 0.77}, 0.59, true},        // 81
    {BoneId::kHand, {0.86, -0.21, -0.61}, 0.68, true},      // 82
    {BoneId::kRibs, {0.30, 0.32, 0.00}, 1.04, true},        // 83
    {BoneId::kHead, {0.59, 0.00, 0.69}, 1.18, false},       // 84
    {BoneId::kUpperArm, {0.94, -0.00, 0.07}, 0.82, true},   // 85
    {BoneId::kUpperArm, {0.78, -0.01, -0.15}, 0.86, true},  // 86
    {BoneId::kHead, {0.71, 0.00, -0.04}, 1.32, false},      // 87
    {BoneId::kBelly, {0.58, 0.00, 0.25}, 0.61, false},      // 88
});
constexpr auto kShellFull350Edges = std::to_array<LayoutEdge>(
    {{1, 2, false},   {0, 14, false},  {4, 15, false},  {12, 15, false}, {11, 19, false},
     {20, 23, false}, {3, 24, false},  {12, 25, false}, {16, 26, false}, {18, 28, false},
     {11, 23, false}, {20, 29, false}, {15, 16, false}, {30, 31, false}, {5, 10, false},
     {16, 34, false}, {7, 35, false},  {2, 36, false},  {11, 20, false}, {35, 37, false},
     {32, 38, false}, {7, 39, false},  {22, 41, false}, {3, 45, false},  {43, 47, false},
     {14, 48, false}, {5, 27, false},  {41, 49, false}, {42, 50, false}, {13, 54, false},
     {14, 55, false}, {31, 33, false}, {13, 40, false}, {27, 30, false}, {50, 51, false},
     {45, 57, false}, {36, 59, false}, {17, 61, false}, {43, 53, false}, {32, 60, false},
     {36, 48, false}, {26, 63, false}, {8, 43, false},  {49, 60, false}, {8, 65, false},
     {4, 66, false},  {6, 67, false},  {14, 68, false}, {70, 71, false}, {25, 58, false},
     {50, 67, false}, {42, 46, false}, {12, 40, false}, {69, 74, false}, {14, 64, false},
     {58, 63, false}, {4, 25, false},  {2, 2, true},    {9, 20, false},  {70, 77, false},
     {75, 78, false}, {76, 79, false}, {69, 81, false}, {72, 81, false}, {70, 82, false},
     {73, 82, false}, {69, 77, false}, {28, 62, false}, {0, 83, false},  {1, 84, false},
     {25, 76, false}, {4, 79, false},  {15, 34, false}, {76, 83, false}, {0, 36, false},
     {26, 79, false}, {48, 55, true},  {27, 79, false}, {14, 14, true},  {54, 64, false},
     {44, 85, false}, {45, 85, false}, {24, 86, false}, {52, 86, false}, {62, 87, false},
     {80, 87, false}, {40, 55, true},  {29, 62, false}, {6, 60, false},  {56, 80, false},
     {18, 80, false}, {48, 48, true},  {9, 80, false},  {9, 87, false},  {36, 64, false},
     {9, 56, false},  {75, 76, false}, {12, 34, false}, {55, 59, false}, {48, 59, false},
     {30, 53, false}, {46, 50, false}, {14, 78, false}, {21, 56, false}, {73, 77, false},
     {44, 48, false}, {20, 56, false}});

// 154 + 196 for enclosing, without head, hands and feet.
constexpr auto kShell350Nodes = std::to_array<LayoutNode>({
    {BoneId::kRibs, {0.72, 0.00, 0.38}, 0.63, false},       // 0
    {BoneId::kRibs, {0.95, 0.65, 0.22}, 0.99, true},        // 1
    {BoneId::kForearm, {0.95, -0.08, -0.16}, 0.65, true},   // 2
    {BoneId::kBelly, {0.39, 0.75, 0.00}, 1.04, true},       // 3
    {BoneId::kShin, {0.05, -0.01, -0.13}, 1.07, true},      // 4
    {BoneId::kClavicle, {0.42, -0.36, -0.23}, 1.52, true},  // 5
    {BoneId::kBelly, {0.14, 0.00, 0.57}, 0.69, false},      // 6
    {BoneId::kThigh, {0.17, -0.13, 0.24}, 1.25, true},      // 7
    {BoneId::kClavicle, {0.83, 0.24, -0.21}, 0.97, true},   // 8
    {BoneId::kClavicle, {0.26, 0.60, -0.52}, 1.00, true},   // 9
    {BoneId::kShin, {0.50, -0.07, -0.13}, 1.05, true},      // 10
    {BoneId::kChest, {0.87, 0.00, -0.52}, 0.66, false},     // 11
    {BoneId::kThigh, {0.17, -0.40, 0.74}, 0.85, true},      // 12
    {BoneId::kBelly, {0.50, 1.02, -0.09}, 0.51, true},      // 13
    {BoneId::kChest, {0.34, 0.00, -0.35}, 1.59, false},     // 14
    {BoneId::kUpperArm, {0.21, -0.02, 0.12}, 1.16, true},   // 15
    {BoneId::kChest, {0.89, 0.50, -0.27}, 0.68, true},      // 16
    {BoneId::kShin, {0.40, -0.07, -0.50}, 0.90, true},      // 17
    {BoneId::kShin, {0.53, -0.08, -0.51}, 0.84, true},      // 18
    {BoneId::kThigh, {0.38, -0.06, 0.36}, 1.17, true},      // 19
    {BoneId::kThigh, {0.35, -0.02, 0.53}, 0.81, true},      // 20
    {BoneId::kShin, {0.09, -0.01, 0.09}, 1.04, true},       // 21
    {BoneId::kThigh, {0.36, -0.05, 0.02}, 1.15, true},      // 22
    {BoneId::kClavicle, {1.01, -0.12, -0.03}, 0.98, true},  // 23
    {BoneId::kPelvis, {0.88, -0.04, 0.03}, 0.62, true},     // 24
    {BoneId::kClavicle, {0.67, -0.78, 0.75}, 0.15, true},   // 25
    {BoneId::kThigh, {0.44, -0.05, 0.17}, 1.18, true},      // 26
    {BoneId::kThigh, {-0.62, -0.17, 0.27}, 1.20, true},     // 27
    {BoneId::kShin, {0.96, -0.13, -0.18}, 0.53, true},      // 28
    {BoneId::kForearm, {0.97, -0.07, 0.18}, 0.60, true},    // 29
    {BoneId::kClavicle, {0.35, -0.81, -0.17}, 1.69, true},  // 30
    {BoneId::kForearm, {0.45, -0.04, -0.17}, 1.01, true},   // 31
    {BoneId::kRibs, {1.16, 0.28, -0.12}, 1.23, true},       // 32
    {BoneId::kBelly, {0.97, 0.61, 0.01}, 0.85, true},       // 33
    {BoneId::kUpperArm, {0.13, -0.02, -0.07}, 1.30, true},  // 34
    {BoneId::kShin, {0.30, -0.05, -0.05}, 1.06, true},      // 35
    {BoneId::kChest, {1.01, 0.83, 0.25}, 0.12, true},       // 36
    {BoneId::kChest, {0.89, 0.36, 0.48}, 0.32, true},       // 37
    {BoneId::kBelly, {0.24, 0.00, 0.01}, 1.26, false},      // 38
    {BoneId::kChest, {1.44, 0.00, -0.77}, 0.10, false},     // 39
    {BoneId::kThigh, {0.25, 0.04, 0.28}, 0.93, true},       // 40
    {BoneId::kShin, {0.94, -0.13, 0.15}, 0.67, true},       // 41
    {BoneId::kRibs, {1.25, 0.66, -0.15}, 1.15, true},       // 42
    {BoneId::kForearm, {0.49, -0.04, 0.06}, 0.99, true},    // 43
    {BoneId::kBelly, {0.86, 0.11, 0.34}, 0.41, true},       // 44
    {BoneId::kShin, {0.11, 0.01, 0.39}, 0.84, true},        // 45
    {BoneId::kThigh, {0.24, -0.23, 0.66}, 0.52, true},      // 46
    {BoneId::kUpperArm, {0.18, -0.03, -0.20}, 1.18, true},  // 47
    {BoneId::kClavicle, {0.72, -0.43, 0.30}, 0.72, true},   // 48
    {BoneId::kBelly, {0.23, 0.00, 0.82}, 0.16, false},      // 49
    {BoneId::kThigh, {0.90, 0.00, 0.64}, 0.24, true},       // 50
    {BoneId::kRibs, {0.33, 0.32, -0.02}, 1.00, true},       // 51
    {BoneId::kBelly, {0.21, 0.41, 0.08}, 1.09, true},       // 52
    {BoneId::kRibs, {0.57, 0.21, 0.19}, 0.84, true},        // 53
    {BoneId::kBelly, {0.95, 0.66, 0.01}, 0.77, true},       // 54
    {BoneId::kPelvis, {0.86, 0.47, 0.08}, 1.29, true},      // 55
    {BoneId::kClavicle, {0.65, -0.20, -0.64}, 0.37, true},  // 56
    {BoneId::kRibs, {0.10, 0.11, 0.10}, 0.92, true},        // 57
    {BoneId::kRibs, {0.94, 0.69, 0.46}, 0.93, true},        // 58
    {BoneId::kChest, {0.39, 0.00, -0.14}, 1.03, false},     // 59
    {BoneId::kUpperArm, {0.19, -0.07, 0.38}, 0.57, true},   // 60
    {BoneId::kClavicle, {0.81, 0.10, -0.30}, 0.78, true},   // 61
    {BoneId::kRibs, {0.61, 0.52, -0.01}, 1.02, true},       // 62
    {BoneId::kUpperArm, {1.39, -0.03, -0.53}, 0.19, true},  // 63
    {BoneId::kUpperArm, {0.96, -0.00, -0.10}, 0.82, true},  // 64
    {BoneId::kUpperArm, {0.77, -0.01, 0.07}, 0.89, true},   // 65
    {BoneId::kForearm, {0.12, -0.01, 0.04}, 1.04, true},    // 66
    {BoneId::kBelly, {0.22, 0.50, 0.14}, 0.74, true},       // 67
    {BoneId::kThigh, {0.11, -0.03, 0.20}, 1.10, true},      // 68
    {BoneId::kBelly, {0.19, 0.40, -0.02}, 0.98, true},      // 69
    {BoneId::kBelly, {0.15, 0.07, -0.03}, 0.75, true},      // 70
    {BoneId::kBelly, {0.54, 0.79, -0.07}, 0.65, true},      // 71
    {BoneId::kShin, {0.91, -0.13, 0.11}, 0.64, true},       // 72
    {BoneId::kChest, {0.32, 0.00, -0.31}, 1.59, false},     // 73
    {BoneId::kShin, {0.73, -0.08, -0.21}, 0.23, true},      // 74
    {BoneId::kRibs, {0.74, 0.03, -0.22}, 0.78, true},       // 75
    {BoneId::kChest, {0.05, 0.00, -0.08}, 1.75, false},     // 76
    {BoneId::kThigh, {0.14, -0.24, -0.42}, 0.89, true},     // 77
    {BoneId::kPelvis, {0.64, 0.45, 0.01}, 1.65, true},      // 78
    {BoneId::kBelly, {0.44, 0.44, 0.03}, 1.14, true},       // 79
    {BoneId::kBelly, {0.59, 0.50, 0.04}, 0.92, true},       // 80
    {BoneId::kThigh, {0.21, -0.20, 0.24}, 0.85, true},      // 81
});
constexpr auto kShell350Edges = std::to_array<LayoutEdge>(
    {{8, 9, false},   {5, 9, true},    {3, 12, false},  {4, 17, false},  {5, 9, false},
     {7, 19, false},  {4, 22, false},  {19, 21, false}, {4, 26, false},  {7, 26, false},
     {18, 28, false}, {1, 30, false},  {2, 31, false},  {5, 8, false},   {8, 34, false},
     {4, 35, false},  {10, 35, false}, {17, 18, false}, {11, 37, false}, {21, 35, false},
     {24, 33, false}, {16, 39, false}, {22, 24, false}, {29, 43, false}, {5, 44, false},
     {21, 26, false}, {19, 45, false}, {2, 43, false},  {0, 38, false},  {14, 16, false},
     {27, 33, false}, {37, 37, true},  {23, 30, false}, {16, 36, false}, {32, 33, false},
     {9, 11, false},  {18, 41, false}, {4, 50, false},  {30, 51, false}, {12, 19, false},
     {6, 52, false},  {6, 12, false},  {40, 49, false}, {3, 53, false},  {24, 26, false},
     {9, 36, false},  {8, 11, false},  {25, 47, false}, {42, 54, false}, {22, 55, false},
     {15, 56, false}, {32, 57, true},  {1, 8, false},   {23, 32, false}, {36, 37, false},
     {30, 58, false}, {5, 54, false},  {4, 10, false},  {15, 48, false}, {28, 41, false},
     {26, 55, false}, {9, 59, false},  {15, 61, false}, {11, 59, false}, {1, 62, false},
     {13, 62, false}, {43, 63, false}, {60, 63, false}, {31, 64, false}, {47, 64, false},
     {15, 65, false}, {43, 66, false}, {52, 67, true},  {7, 68, false},  {27, 68, false},
     {3, 69, false},  {3, 70, true},   {24, 70, true},  {54, 71, false}, {10, 72, false},
     {5, 73, false},  {41, 74, false}, {1, 75, true},   {30, 76, false}, {38, 54, false},
     {46, 78, false}, {77, 78, false}, {34, 65, false}, {73, 76, false}, {8, 15, false},
     {17, 72, false}, {65, 66, false}, {52, 79, false}, {57, 79, false}, {17, 50, false},
     {27, 80, false}, {51, 80, false}, {20, 81, false}, {77, 81, false}, {72, 74, false}});

// 240 + 260 for enclosing, with head, hands and feet.
constexpr auto kShellFull500Nodes = std::to_array<LayoutNode>({
    {BoneId::kChest, {0.21, 0.54, -0.13}, 0.71, true},      // 0
    {BoneId::kHead, {0.07, 0.00, 0.06}, 0.93, false},       // 1
    {BoneId::kChest, {0.86, 0.57, -0.22}, 0.77, true},      // 2
    {BoneId::kForearm, {1.09, -0.01, -0.17}, 0.50, true},   // 3
    {BoneId::kPelvis, {0.67, 0.46, -0.03}, 1.63, true},     // 4
    {BoneId::kThigh, {0.98, -0.01, 0.04}, 0.82, true},      // 5
    {BoneId::kHeel, {0.61, 0.10, -0.44}, 1.38, true},       // 6
    {BoneId::kFoot, {0.96, 1.14, 0.44}, 0.69, true},        // 7
    {BoneId::kShin, {0.36, 0.00, -0.30}, 0.89, true},       // 8
    {BoneId::kHead, {0.70, 0.00, 0.66}, 1.21, false},       // 9
    {BoneId::kThigh, {0.53, -0.07, 0.03}, 1.09, true},      // 10
    {BoneId::kHead, {0.71, 0.00, 0.45}, 1.30, false},       // 11
    {BoneId::kRibs, {0.36, 0.17, 0.22}, 0.81, true},        // 12
    {BoneId::kForearm, {0.08, -0.00, -0.12}, 0.99, true},   // 13
    {BoneId::kRibs, {1.08, 0.64, -0.22}, 0.80, true},       // 14
    {BoneId::kClavicle, {0.33, -0.46, -0.12}, 1.50, true},  // 15
    {BoneId::kBelly, {0.27, 0.00, -0.00}, 1.27, false},     // 16
    {BoneId::kBelly, {-0.05, 0.65, 0.55}, 0.59, true},      // 17
    {BoneId::kFoot, {0.44, -0.00, -0.47}, 1.16, true},      // 18
    {BoneId::kHead, {0.71, 0.00, -0.45}, 1.13, false},      // 19
    {BoneId::kHead, {0.54, 0.00, 0.17}, 1.25, false},       // 20
    {BoneId::kHead, {0.38, 0.00, 0.10}, 1.04, false},       // 21
    {BoneId::kHead, {0.39, 0.00, 1.19}, 0.92, false},       // 22
    {BoneId::kHead, {0.71, 0.00, -0.20}, 1.26, false},      // 23
    {BoneId::kFoot, {0.29, -0.03, -0.82}, 1.26, true},      // 24
    {BoneId::kHead, {0.51, 0.00, 2.27}, 0.14, false},       // 25
    {BoneId::kForearm, {0.37, -0.00, -0.15}, 0.98, true},   // 26
    {BoneId::kPelvis, {0.60, 0.50, -0.25}, 0.90, true},     // 27
    {BoneId::kHead, {0.54, 0.00, -0.29}, 1.08, false},      // 28
    {BoneId::kThigh, {0.26, -0.13, 0.39}, 1.24, true},      // 29
    {BoneId::kHead, {0.34, 0.00, 0.65}, 0.97, false},       // 30
    {BoneId::kHead, {0.30, 0.00, 1.80}, 0.38, false},       // 31
    {BoneId::kThigh, {0.98, 0.00, 0.27}, 0.72, true},       // 32
    {BoneId::kFoot, {0.70, -0.91, -0.18}, 0.72, true},      // 33
    {BoneId::kUpperArm, {0.26, -0.02, -0.21}, 1.14, true},  // 34
    {BoneId::kBelly, {0.26, 0.00, 0.34}, 0.48, false},      // 35
    {BoneId::kThigh, {0.44, -0.09, 0.47}, 1.05, true},      // 36
    {BoneId::kFoot, {0.96, -0.92, 0.46}, 0.54, true},       // 37
    {BoneId::kChest, {0.28, 0.00, -0.17}, 0.69, false},     // 38
    {BoneId::kFoot, {1.07, -0.68, 0.57}, 0.46, true},       // 39
    {BoneId::kBelly, {1.04, 0.54, 0.01}, 0.89, true},       // 40
    {BoneId::kFoot, {0.56, 0.23, -0.30}, 1.08, true},       // 41
    {BoneId::kFoot, {1.15, -0.07, 0.61}, 0.53, true},       // 42
    {BoneId::kUpperArm, {0.53, -0.02, 0.20}, 0.87, true},   // 43
    {BoneId::kShin, {0.37, 0.00, -0.11}, 0.96, true},       // 44
    {BoneId::kThigh, {1.02, -0.00, -0.12}, 0.79, true},     // 45
    {BoneId::kBelly, {0.46, 0.52, 0.03}, 1.12, true},       // 46
    {BoneId::kHead, {0.57, 0.86, 0.02}, 0.55, true},        // 47
    {BoneId::kUpperArm, {0.19, -0.02, 0.14}, 1.17, true},   // 48
    {BoneId::kForearm, {0.41, 0.00, 0.05}, 0.97, true},     // 49
    {BoneId::kShin, {0.90, 0.00, 0.15}, 0.53, true},        // 50
    {BoneId::kShin, {0.32, -0.00, -0.56}, 0.75, true},      // 51
    {BoneId::kBelly, {0.33, 0.43, 0.09}, 0.70, true},       // 52
    {BoneId::kFoot, {0.69, 1.22, -0.37}, 0.59, true},       // 53
    {BoneId::kFoot, {0.60, 1.29, -0.77}, 0.37, true},       // 54
    {BoneId::kShin, {0.74, 0.01, -0.23}, 0.53, true},       // 55
    {BoneId::kShin, {0.39, 0.00, -0.52}, 0.75, true},       // 56
    {BoneId::kUpperArm, {0.14, -0.04, -0.07}, 1.30, true},  // 57
    {BoneId::kThigh, {0.83, -0.03, -0.01}, 0.88, true},     // 58
    {BoneId::kRibs, {1.35, 0.67, -0.17}, 1.15, true},       // 59
    {BoneId::kChest, {0.18, 0.64, -0.11}, 1.54, true},      // 60
    {BoneId::kChest, {0.70, 0.32, -0.37}, 0.92, true},      // 61
    {BoneId::kHead, {0.62, 0.00, -0.68}, 0.86, false},      // 62
    {BoneId::kChest, {0.84, 0.12, -0.21}, 0.59, true},      // 63
    {BoneId::kRibs, {0.47, 0.46, -0.02}, 0.82, true},       // 64
    {BoneId::kThigh, {0.30, -0.11, 0.20}, 1.26, true},      // 65
    {BoneId::kClavicle, {0.98, 0.14, -0.05}, 0.80, true},   // 66
    {BoneId::kShin, {1.80, -0.07, -0.17}, 0.61, true},      // 67
    {BoneId::kShin, {0.81, 0.02, 0.22}, 0.43, true},        // 68
    {BoneId::kHead, {0.71, 0.00, 0.08}, 1.32, false},       // 69
    {BoneId::kClavicle, {0.48, -0.01, -0.18}, 1.22, true},  // 70
    {BoneId::kPelvis, {0.94, 0.67, 0.23}, 1.39, true},      // 71
    {BoneId::kRibs, {0.12, 0.58, -0.10}, 0.39, true},       // 72
    {BoneId::kRibs, {1.21, 0.54, -0.11}, 1.22, true},       // 73
    {BoneId::kUpperArm, {0.72, -0.01, 0.02}, 0.92, true},   // 74
    {BoneId::kChest, {0.12, 0.00, -0.05}, 1.18, false},     // 75
    {BoneId::kForearm, {0.75, 0.01, -0.05}, 0.40, true},    // 76
    {BoneId::kHand, {0.95, -0.23, -0.59}, 0.40, true},      // 77
    {BoneId::kHand, {0.62, -0.45, 2.59}, 0.40, true},       // 78
    {BoneId::kHand, {0.95, -0.20, -0.04}, 0.52, true},      // 79
    {BoneId::kFoot, {0.83, 1.25, 0.04}, 0.68, true},        // 80
    {BoneId::kHand, {0.54, -0.16, -1.06}, 0.59, true},      // 81
    {BoneId::kHand, {0.63, -0.17, -1.11}, 0.45, true},      // 82
    {BoneId::kHand, {0.56, -0.15, 2.27}, 0.34, true},       // 83
    {BoneId::kHand, {0.37, -0.09, 1.27}, 0.54, true},       // 84
    {BoneId::kFoot, {0.81, 0.46, 0.23}, 0.87, true},        // 85
    {BoneId::kHand, {0.34, -0.08, -0.14}, 0.81, true},      // 86
    {BoneId::kHand, {0.74, -0.20, -1.38}, 0.21, true},      // 87
    {BoneId::kBelly, {0.47, 0.58, -0.20}, 0.67, true},      // 88
    {BoneId::kRibs, {0.97, 0.69, 0.46}, 0.94, true},        // 89
    {BoneId::kHand, {0.97, -0.18, 0.78}, 0.31, true},       // 90
    {BoneId::kBelly, {0.54, 0.00, 0.06}, 0.65, false},      // 91
    {BoneId::kFoot, {0.61, -1.03, -0.54}, 0.55, true},      // 92
    {BoneId::kClavicle, {0.32, -0.43, -0.18}, 1.24, true},  // 93
    {BoneId::kThigh, {0.35, -0.10, 0.01}, 1.15, true},      // 94
    {BoneId::kShin, {0.95, 0.02, -0.12}, 0.51, true},       // 95
    {BoneId::kFoot, {0.10, -0.01, -0.25}, 1.33, true},      // 96
    {BoneId::kBelly, {0.93, 0.34, 0.03}, 0.95, true},       // 97
    {BoneId::kHand, {0.28, -0.03, 0.81}, 0.63, true},       // 98
    {BoneId::kHead, {0.72, 0.00, 1.53}, 0.34, false},       // 99
    {BoneId::kClavicle, {0.68, -0.38, 0.10}, 0.40, true},   // 100
    {BoneId::kThigh, {0.50, -0.08, 0.34}, 1.12, true},      // 101
    {BoneId::kBelly, {0.94, 0.63, -0.04}, 0.86, true},      // 102
    {BoneId::kHand, {0.48, -0.09, 0.59}, 0.72, true},       // 103
    {BoneId::kBelly, {0.80, 0.35, 0.17}, 0.62, true},       // 104
    {BoneId::kPelvis, {0.70, 0.21, -0.35}, 1.28, true},     // 105
    {BoneId::kUpperArm, {1.05, 0.00, 0.08}, 0.80, true},    // 106
    {BoneId::kHand, {0.08, -0.01, 0.27}, 0.69, true},       // 107
    {BoneId::kPelvis, {0.84, 0.05, -0.21}, 0.90, true},     // 108
    {BoneId::kRibs, {0.44, 0.27, 0.08}, 0.62, true},        // 109
    {BoneId::kRibs, {0.62, 0.13, -0.19}, 0.79, true},       // 110
    {BoneId::kShin, {0.84, 0.01, -0.14}, 0.51, true},       // 111
    {BoneId::kShin, {0.68, 0.01, 0.03}, 0.67, true},        // 112
    {BoneId::kThigh, {0.87, -0.02, -0.04}, 0.86, true},     // 113
    {BoneId::kPelvis, {0.38, -0.34, 0.48}, 0.89, true},     // 114
    {BoneId::kThigh, {0.19, -0.18, 0.01}, 1.17, true},      // 115
    {BoneId::kHead, {0.43, 0.00, 0.43}, 1.08, false},       // 116
    {BoneId::kClavicle, {0.58, -0.24, -0.12}, 1.08, true},  // 117
    {BoneId::kRibs, {0.62, 1.06, -0.25}, 0.49, true},       // 118
    {BoneId::kThigh, {0.46, -0.08, 0.19}, 1.19, true},      // 119
    {BoneId::kUpperArm, {0.76, -0.01, -0.16}, 0.87, true},  // 120
    {BoneId::kThigh, {0.20, -0.42, 0.68}, 0.68, true},      // 121
    {BoneId::kUpperArm, {0.81, -0.01, 0.11}, 0.82, true},   // 122
    {BoneId::kForearm, {0.09, 0.00, 0.03}, 1.00, true},     // 123
    {BoneId::kRibs, {0.15, 0.42, 0.20}, 0.56, true},        // 124
    {BoneId::kClavicle, {0.51, 0.49, -0.32}, 0.93, true},   // 125
    {BoneId::kClavicle, {0.96, 0.19, -0.12}, 0.81, true},   // 126
    {BoneId::kHead, {0.43, 0.00, 0.80}, 1.07, false},       // 127
    {BoneId::kForearm, {0.11, 0.01, 0.12}, 0.93, true},     // 128
    {BoneId::kRibs, {0.54, 0.25, -0.01}, 1.11, true},       // 129
    {BoneId::kThigh, {0.93, -0.04, 0.07}, 0.73, true},      // 130
});
constexpr auto kShellFull500Edges = std::to_array<LayoutEdge>(
    {{1, 2, false},     {12, 16, false},   {9, 22, false},    {20, 23, false},  {22, 25, false},
     {3, 26, false},    {13, 26, false},   {20, 30, false},   {22, 31, false},  {16, 17, false},
     {17, 35, false},   {7, 37, false},    {33, 37, false},   {37, 39, false},  {0, 40, false},
     {7, 42, false},    {4, 46, false},    {20, 47, false},   {45, 51, false},  {24, 53, false},
     {44, 55, false},   {34, 57, false},   {1, 61, false},    {15, 61, true},   {28, 62, false},
     {1, 63, false},    {52, 64, false},   {55, 56, false},   {10, 65, false},  {11, 69, false},
     {45, 58, false},   {8, 45, false},    {54, 67, false},   {15, 73, true},   {13, 74, false},
     {48, 74, false},   {41, 80, false},   {5, 44, false},    {76, 81, false},  {16, 72, false},
     {21, 28, false},   {11, 20, false},   {77, 82, false},   {29, 36, false},  {78, 83, false},
     {18, 33, false},   {57, 74, false},   {79, 84, false},   {30, 31, false},  {2, 38, false},
     {37, 85, false},   {76, 86, false},   {77, 86, false},   {77, 87, false},  {12, 88, false},
     {27, 88, false},   {59, 66, false},   {40, 71, false},   {79, 87, false},  {84, 90, false},
     {71, 72, false},   {17, 46, false},   {15, 66, false},   {60, 89, false},  {67, 92, false},
     {12, 14, true},    {65, 71, false},   {8, 32, false},    {19, 28, false},  {70, 70, true},
     {10, 94, false},   {6, 95, false},    {18, 96, false},   {68, 96, false},  {91, 97, false},
     {76, 98, false},   {78, 98, false},   {25, 99, false},   {37, 41, false},  {29, 101, false},
     {32, 101, false},  {71, 97, false},   {75, 91, false},   {40, 59, false},  {46, 97, false},
     {83, 86, false},   {17, 29, false},   {61, 70, false},   {57, 100, false}, {0, 0, true},
     {77, 103, false},  {72, 89, false},   {88, 104, false},  {73, 73, true},   {49, 107, false},
     {86, 107, false},  {29, 108, false},  {88, 108, false},  {59, 109, false}, {12, 110, false},
     {14, 110, false},  {55, 111, false},  {95, 111, false},  {44, 112, false}, {50, 112, false},
     {10, 113, false},  {27, 114, false},  {105, 114, false}, {94, 115, false}, {105, 115, false},
     {1, 116, false},   {11, 116, false},  {48, 117, false},  {93, 117, false}, {59, 118, false},
     {102, 118, false}, {5, 119, false},   {29, 119, false},  {13, 120, false}, {34, 120, false},
     {27, 121, false},  {43, 122, false},  {106, 122, false}, {49, 123, false}, {60, 124, false},
     {2, 125, false},   {57, 126, false},  {11, 127, false},  {22, 127, false}, {125, 126, false},
     {106, 128, false}, {123, 128, false}, {17, 27, false},   {4, 121, false},  {38, 126, false},
     {60, 129, false},  {97, 129, false},  {109, 124, false}, {5, 130, false},  {113, 130, false}});

// 200 + 300 for enclosing, without head, hands and feet.
constexpr auto kShell500Nodes = std::to_array<LayoutNode>({
    {BoneId::kRibs, {0.74, 0.0, -0.0}, 1.0, false},      // 0
    {BoneId::kRibs, {0.96, 0.7, 0.7}, 0.8, true},        // 1
    {BoneId::kForearm, {0.94, -0.1, -0.2}, 0.6, true},   // 2
    {BoneId::kBelly, {0.34, 0.5, -0.0}, 1.2, true},      // 3
    {BoneId::kShin, {0.03, -0.0, -0.1}, 1.1, true},      // 4
    {BoneId::kShin, {0.95, -0.1, 0.1}, 0.6, true},       // 5
    {BoneId::kClavicle, {0.32, -0.8, -0.2}, 1.7, true},  // 6
    {BoneId::kBelly, {0.28, 0.0, 0.0}, 1.3, false},      // 7
    {BoneId::kThigh, {0.27, -0.1, 0.3}, 1.2, true},      // 8
    {BoneId::kClavicle, {0.87, 0.2, -0.2}, 1.0, true},   // 9
    {BoneId::kClavicle, {0.27, 0.5, -0.5}, 1.0, true},   // 10
    {BoneId::kForearm, {0.10, -0.0, 0.1}, 1.0, true},    // 11
    {BoneId::kForearm, {0.34, -0.0, -0.2}, 1.0, true},   // 12
    {BoneId::kClavicle, {0.39, -0.9, -0.2}, 1.4, true},  // 13
    {BoneId::kShin, {0.49, -0.1, -0.1}, 1.0, true},      // 14
    {BoneId::kChest, {0.83, 0.0, -0.5}, 0.7, false},     // 15
    {BoneId::kPelvis, {0.61, -0.3, 0.7}, 0.9, true},     // 16
    {BoneId::kBelly, {0.67, 0.8, -0.1}, 0.6, true},      // 17
    {BoneId::kRibs, {0.26, 0.5, 0.2}, 0.3, true},        // 18
    {BoneId::kChest, {0.23, 0.0, 0.0}, 1.3, false},      // 19
    {BoneId::kThigh, {0.55, 0.2, 0.4}, 0.8, true},       // 20
    {BoneId::kUpperArm, {0.13, -0.0, -0.0}, 1.3, true},  // 21
    {BoneId::kBelly, {0.54, 0.0, 0.1}, 1.0, false},      // 22
    {BoneId::kChest, {0.79, 0.6, -0.3}, 0.8, true},      // 23
    {BoneId::kShin, {0.40, -0.1, -0.5}, 0.9, true},      // 24
    {BoneId::kShin, {0.54, -0.1, -0.5}, 0.8, true},      // 25
    {BoneId::kThigh, {0.43, -0.0, 0.3}, 1.1, true},      // 26
    {BoneId::kThigh, {0.28, 0.1, -0.4}, 0.6, true},      // 27
    {BoneId::kShin, {0.12, -0.0, 0.1}, 1.0, true},       // 28
    {BoneId::kThigh, {0.43, -0.0, 0.0}, 1.1, true},      // 29
    {BoneId::kUpperArm, {0.12, -0.4, 0.1}, 0.3, true},   // 30
    {BoneId::kThigh, {0.25, -0.1, 0.2}, 1.2, true},      // 31
    {BoneId::kClavicle, {0.51, -0.8, 0.9}, 0.3, true},   // 32
    {BoneId::kThigh, {0.51, -0.0, 0.1}, 1.1, true},      // 33
    {BoneId::kPelvis, {0.97, 0.7, 0.2}, 1.3, true},      // 34
    {BoneId::kShin, {0.96, -0.1, -0.1}, 0.5, true},      // 35
    {BoneId::kForearm, {0.95, -0.1, 0.2}, 0.6, true},    // 36
    {BoneId::kChest, {0.19, 0.5, -0.1}, 1.5, true},      // 37
    {BoneId::kUpperArm, {0.69, -0.0, -0.2}, 0.9, true},  // 38
    {BoneId::kForearm, {0.48, -0.0, -0.2}, 1.0, true},   // 39
    {BoneId::kRibs, {1.08, 0.4, -0.0}, 1.1, true},       // 40
    {BoneId::kUpperArm, {0.75, -0.0, 0.1}, 0.9, true},   // 41
    {BoneId::kRibs, {0.22, 0.5, 0.1}, 0.8, true},        // 42
    {BoneId::kUpperArm, {0.10, -0.0, -0.0}, 1.3, true},  // 43
    {BoneId::kShin, {0.25, -0.0, -0.1}, 1.1, true},      // 44
    {BoneId::kClavicle, {0.53, -0.0, -0.1}, 1.1, true},  // 45
    {BoneId::kChest, {0.99, 0.7, 0.1}, 0.2, true},       // 46
    {BoneId::kRibs, {0.48, 0.3, -0.3}, 0.5, true},       // 47
    {BoneId::kBelly, {0.60, 0.0, 0.1}, 0.5, false},      // 48
    {BoneId::kChest, {0.92, 0.5, 0.6}, 0.2, true},       // 49
    {BoneId::kBelly, {0.47, 0.0, 0.2}, 0.9, false},      // 50
    {BoneId::kChest, {1.45, 0.0, -0.6}, 0.1, false},     // 51
    {BoneId::kThigh, {0.21, -0.3, 0.7}, 0.8, true},      // 52
    {BoneId::kShin, {0.81, -0.1, 0.0}, 0.7, true},       // 53
    {BoneId::kForearm, {0.32, -0.5, 0.1}, 0.4, true},    // 54
    {BoneId::kUpperArm, {0.38, -0.0, -0.4}, 0.6, true},  // 55
    {BoneId::kChest, {0.10, 0.0, -0.2}, 1.6, false},     // 56
    {BoneId::kClavicle, {0.85, 0.1, -1.0}, 0.2, true},   // 57
    {BoneId::kChest, {1.01, 0.3, -0.3}, 0.5, true},      // 58
    {BoneId::kRibs, {0.78, 0.6, -0.1}, 1.0, true},       // 59
    {BoneId::kChest, {0.23, 0.0, -0.7}, 0.7, false},     // 60
    {BoneId::kPelvis, {0.90, 0.4, 0.1}, 1.0, true},      // 61
    {BoneId::kForearm, {0.48, -0.0, 0.0}, 1.0, true},    // 62
    {BoneId::kBelly, {0.56, 0.9, -0.1}, 0.6, true},      // 63
    {BoneId::kBelly, {0.83, 0.2, -0.1}, 0.6, true},      // 64
    {BoneId::kShin, {0.10, 0.0, 0.4}, 0.8, true},        // 65
    {BoneId::kPelvis, {0.68, 0.3, -0.2}, 1.4, true},     // 66
    {BoneId::kUpperArm, {0.20, -0.0, -0.2}, 1.2, true},  // 67
    {BoneId::kRibs, {0.23, 0.0, -0.1}, 0.4, false},      // 68
    {BoneId::kForearm, {0.06, -0.0, -0.1}, 1.0, true},   // 69
    {BoneId::kRibs, {0.18, 0.3, 0.1}, 0.6, true},        // 70
    {BoneId::kClavicle, {0.49, -0.1, -0.4}, 1.2, true},  // 71
    {BoneId::kShin, {0.19, -0.2, 0.0}, 0.4, true},       // 72
    {BoneId::kShin, {-0.07, 0.1, 0.3}, 0.6, true},       // 73
    {BoneId::kShin, {0.92, -0.1, 0.1}, 0.3, true},       // 74
    {BoneId::kChest, {0.99, 0.5, -0.4}, 0.2, true},      // 75
    {BoneId::kBelly, {0.10, 0.0, 0.8}, 0.4, false},      // 76
    {BoneId::kThigh, {1.15, -0.0, 0.2}, 0.1, true},      // 77
    {BoneId::kShin, {0.62, 0.1, -0.2}, 0.2, true},       // 78
    {BoneId::kThigh, {1.06, -0.0, -0.1}, 0.8, true},     // 79
    {BoneId::kForearm, {0.87, -0.0, -0.4}, 0.1, true},   // 80
    {BoneId::kForearm, {1.00, 0.0, 0.6}, 0.2, true},     // 81
    {BoneId::kShin, {0.92, -0.1, 0.1}, 0.6, true},       // 82
    {BoneId::kChest, {0.84, 0.0, 0.5}, 0.2, true},       // 83
    {BoneId::kForearm, {0.91, 0.5, -0.0}, 0.2, true},    // 84
    {BoneId::kPelvis, {0.66, 0.5, -0.1}, 1.4, true},     // 85
    {BoneId::kForearm, {0.97, 0.3, 0.0}, 0.3, true},     // 86
    {BoneId::kUpperArm, {0.67, 0.0, -0.0}, 0.2, true},   // 87
    {BoneId::kRibs, {0.32, 0.6, 0.0}, 0.8, true},        // 88
    {BoneId::kThigh, {0.29, 0.3, 0.3}, 0.7, true},       // 89
    {BoneId::kThigh, {0.08, -0.2, 0.0}, 0.9, true},      // 90
    {BoneId::kBelly, {0.66, 0.0, 0.1}, 0.8, true},       // 91
    {BoneId::kBelly, {0.58, 0.4, 0.1}, 1.1, true},       // 92
    {BoneId::kBelly, {0.71, 0.8, 0.1}, 0.5, true},       // 93
    {BoneId::kRibs, {0.23, 0.5, 0.1}, 0.7, true},        // 94
    {BoneId::kRibs, {0.16, 0.0, -0.0}, 0.7, false},      // 95
    {BoneId::kRibs, {0.27, 0.5, 0.3}, 0.4, true},        // 96
    {BoneId::kRibs, {0.44, 0.0, -0.2}, 0.3, true},       // 97
    {BoneId::kPelvis, {0.88, 0.0, 0.2}, 1.2, true},      // 98
    {BoneId::kRibs, {0.17, 0.6, -0.0}, 0.8, true},       // 99
    {BoneId::kRibs, {0.72, 0.7, 0.0}, 0.9, true},        // 100
    {BoneId::kThigh, {0.10, -0.2, 0.0}, 1.0, true},      // 101
    {BoneId::kClavicle, {0.87, -0.8, -0.5}, 0.4, true},  // 102
    {BoneId::kChest, {0.25, 0.0, -0.2}, 1.7, false},     // 103
    {BoneId::kBelly, {1.06, 0.4, 0.0}, 0.9, true},       // 104
    {BoneId::kShin, {0.78, -0.2, 0.1}, 0.2, true},       // 105
    {BoneId::kForearm, {0.95, -0.3, -0.1}, 0.4, true},   // 106
});
constexpr auto kShell500Edges = std::to_array<LayoutEdge>({
    {9, 10, false},   {10, 10, true},   {6, 10, true},    {3, 16, false},   {3, 17, false},
    {3, 18, false},   {3, 22, false},   {16, 22, false},  {15, 23, false},  {4, 24, false},
    {14, 24, false},  {6, 10, false},   {3, 17, true},    {5, 25, false},   {14, 25, false},
    {8, 26, false},   {20, 26, false},  {20, 28, false},  {4, 29, false},   {8, 29, false},
    {26, 28, false},  {4, 33, false},   {8, 33, false},   {3, 34, false},   {25, 35, false},
    {1, 37, false},   {9, 37, false},   {21, 38, false},  {2, 39, false},   {12, 39, false},
    {6, 9, false},    {1, 30, true},    {37, 40, false},  {11, 41, false},  {9, 43, false},
    {4, 44, false},   {14, 44, false},  {9, 45, false},   {18, 22, false},  {24, 25, false},
    {1, 47, false},   {15, 49, false},  {46, 49, false},  {28, 44, false},  {31, 42, false},
    {10, 23, false},  {15, 51, false},  {27, 52, false},  {5, 53, false},   {14, 53, false},
    {21, 55, false},  {41, 55, false},  {6, 56, false},   {32, 43, false},  {23, 51, false},
    {29, 31, false},  {15, 58, false},  {12, 62, false},  {36, 62, false},  {50, 59, false},
    {6, 64, false},   {9, 40, false},   {28, 33, false},  {26, 65, false},  {2, 62, false},
    {21, 67, false},  {12, 69, false},  {0, 50, false},   {6, 64, true},    {19, 23, false},
    {34, 42, false},  {46, 60, false},  {29, 61, false},  {38, 69, false},  {41, 43, false},
    {13, 15, false},  {37, 57, false},  {4, 72, false},   {26, 73, false},  {49, 49, true},
    {25, 74, false},  {1, 57, false},   {7, 68, false},   {6, 71, false},   {34, 70, true},
    {0, 63, false},   {30, 37, false},  {23, 46, false},  {21, 41, false},  {40, 42, false},
    {27, 66, false},  {8, 16, false},   {48, 56, false},  {51, 75, false},  {10, 15, false},
    {11, 12, false},  {38, 67, false},  {22, 76, false},  {26, 77, false},  {25, 53, false},
    {4, 79, false},   {24, 44, false},  {28, 73, false},  {62, 80, false},  {36, 81, false},
    {14, 72, false},  {5, 82, false},   {49, 83, false},  {39, 84, false},  {61, 85, false},
    {2, 86, false},   {13, 19, false},  {43, 87, false},  {37, 88, false},  {11, 62, false},
    {16, 26, false},  {32, 55, false},  {23, 45, true},   {52, 89, false},  {8, 90, false},
    {3, 91, false},   {7, 92, false},   {48, 95, false},  {93, 94, false},  {54, 67, false},
    {17, 88, false},  {0, 48, false},   {7, 16, false},   {52, 76, false},  {3, 96, false},
    {31, 33, false},  {10, 46, false},  {9, 15, false},   {32, 67, false},  {1, 97, false},
    {50, 97, false},  {8, 98, false},   {34, 98, false},  {59, 99, false},  {63, 99, false},
    {1, 100, false},  {17, 100, false}, {29, 101, false}, {85, 101, false}, {21, 102, false},
    {60, 102, false}, {6, 103, false},  {40, 104, true},  {92, 104, false}, {1, 60, false},
    {70, 70, true},   {35, 105, false}, {78, 105, false}, {36, 106, false}, {39, 54, false},
});

}  // namespace

std::span<const NamedLayout> Layouts() {
  static constexpr std::array<NamedLayout, 24> kLayouts = {{
      {"best fit, 32", FitKind::kBestFit, 32, false, {kBest32Nodes, kBest32Edges}},
      {"best fit, 64", FitKind::kBestFit, 64, false, {kBest64Nodes, kBest64Edges}},
      {"best fit, 128", FitKind::kBestFit, 128, false, {kBest128Nodes, kBest128Edges}},
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
      {"best fit, whole body, 128",
       FitKind::kBestFit,
       128,
       true,
       {kBestFull128Nodes, kBestFull128Edges}},
      {"best fit, whole body, 250",
       FitKind::kBestFit,
       250,
       true,
       {kBestFull250Nodes, kBestFull250Edges}},
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
      {"shell, 128", FitKind::kEnclose, 128, false, {kShell128Nodes, kShell128Edges}},
      {"shell, 180", FitKind::kEnclose, 180, false, {kShell180Nodes, kShell180Edges}},
      {"shell, 250", FitKind::kEnclose, 250, false, {kShell250Nodes, kShell250Edges}},
      {"shell, 350", FitKind::kEnclose, 350, false, {kShell350Nodes, kShell350Edges}},
      {"shell, 500", FitKind::kEnclose, 500, false, {kShell500Nodes, kShell500Edges}},
      {"shell, whole body, 128",
       FitKind::kEnclose,
       128,
       true,
       {kShellFull128Nodes, kShellFull128Edges}},
      {"shell, whole body, 180",
       FitKind::kEnclose,
       180,
       true,
       {kShellFull180Nodes, kShellFull180Edges}},
      {"shell, whole body, 250",
       FitKind::kEnclose,
       250,
       true,
       {kShellFull250Nodes, kShellFull250Edges}},
      {"shell, whole body, 350",
       FitKind::kEnclose,
       350,
       true,
       {kShellFull350Nodes, kShellFull350Edges}},
      {"shell, whole body, 500",
       FitKind::kEnclose,
       500,
       true,
       {kShellFull500Nodes, kShellFull500Edges}},
  }};
  return kLayouts;
}

}  // namespace capfit::refine
