#include "core/refine/layouts/starting_graphs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/refine/layouts/bones.h"
#include "tests/core/capsule/mirrored.h"
#include "tests/core/refine/mannequin_body.h"

namespace capfit::refine {
namespace {

capsule::Budget Primitives(int count) { return {count, capsule::kNoLimit, capsule::kNoLimit}; }

// How many primitives each has.
std::vector<int> SizesOf(const std::vector<capsule::MirroredSet>& graphs) {
  std::vector<int> sizes;
  for (const capsule::MirroredSet& graph : graphs) sizes.push_back(graph.primitive_count());
  return sizes;
}

std::vector<int> Enclosing(int budget, const StartSizes& sizes) {
  const body::PartSelection all{.head = true, .hands = true, .feet = true};
  const std::vector<capsule::MirroredSet> graphs = StartingGraphs(
      FitKind::kEnclose, MannequinBody(), all, Primitives(budget), sizes, ThreadPool(2));
  for (const capsule::MirroredSet& graph : graphs) {
    EXPECT_TRUE(capsule::IsExactlyMirrored(graph));
  }
  return SizesOf(graphs);
}

// Whatever sizes the tables have: between one layout and the next larger one, both are there.
TEST(StartingGraphs, TheNextLargerOnesComeFirstThenTheLargestThatFit) {
  for (const int budget : {20, 40, 70, 128, 150, 200, 300, 400}) {
    SCOPED_TRACE(budget);
    const std::vector<int> sizes = Enclosing(budget, {});
    ASSERT_GE(sizes.size(), 2U);
    EXPECT_GT(sizes.front(), budget);
    EXPECT_LE(sizes.back(), budget);
    EXPECT_TRUE(std::is_partitioned(sizes.begin(), sizes.end(),
                                    [budget](int size) { return size > budget; }));
  }
}

TEST(StartingGraphs, BeyondAllTheLargestServes) {
  const std::vector<int> sizes = Enclosing(1000, {});
  ASSERT_EQ(sizes.size(), 1U);
  EXPECT_GT(sizes[0], 400);
}

TEST(StartingGraphs, ALayoutWithTooLittleToSpareIsPassedOver) {
  const int next = Enclosing(160, {}).front();
  const int spared = next - 160;
  EXPECT_EQ(Enclosing(160, {.least_spared = spared}).front(), next);
  EXPECT_GT(Enclosing(160, {.least_spared = spared + 1}).front(), next);
}

// Not where it is the only one: something must be started from.
TEST(StartingGraphs, TooLittleToSpareServesWhereThereIsNoOther) {
  const int largest = Enclosing(1000, {}).front();
  EXPECT_EQ(Enclosing(largest - 10, {.least_spared = 100}).front(), largest);
}

// Without the landmarks that a body without legs lacks; a skeleton may know the hips all the same.
body::Body UpperBody(bool with_hips) {
  body::Body body = MannequinBody();
  for (int i = 0; i < body::kLandmarkCount; ++i) {
    const auto id = static_cast<body::LandmarkId>(i);
    const bool is_of_leg = id >= body::LandmarkId::kLeftHip && id <= body::LandmarkId::kRightAnkle;
    const bool is_hip = is_of_leg && id <= body::LandmarkId::kRightHip;
    const bool is_below_bust = id == body::LandmarkId::kCrotch || id == body::LandmarkId::kWaist ||
                               id == body::LandmarkId::kHip;
    const bool is_of_foot = id >= body::LandmarkId::kLeftToe;
    if ((is_of_leg && !(is_hip && with_hips)) || is_below_bust || is_of_foot) {
      body.landmarks[i].reset();
    }
  }
  body.chains[static_cast<int>(body::Part::kLeftLeg)].reset();
  body.chains[static_cast<int>(body::Part::kRightLeg)].reset();
  return body;
}

// Its bones run on from where it ends, or from the hips where they are known, to the bust.
TEST(StartingGraphs, TheTrunkOfAnUpperBodyIsHungDownToItsEnd) {
  for (const bool with_hips : {false, true}) {
    SCOPED_TRACE(with_hips);
    const body::Body body = UpperBody(with_hips);
    const Skeleton skeleton(body);
    const auto& belly = skeleton.bone(BoneId::kBelly, Side::kLeft);
    const auto& ribs = skeleton.bone(BoneId::kRibs, Side::kLeft);
    ASSERT_TRUE(belly && ribs);
    EXPECT_EQ(belly->to_m, ribs->from_m);
    EXPECT_EQ(ribs->to_m, body.landmark(body::LandmarkId::kBust)->position_m);
    const Eigen::Vector3d end = body.chain(body::Part::kTorso)->PointAt(0.0);
    if (!with_hips) {
      EXPECT_EQ(belly->from_m, end);
    }
    const body::PartSelection torso{.arms = false, .legs = false};
    for (const capsule::MirroredSet& graph :
         StartingGraphs(FitKind::kEnclose, body, torso, Primitives(64), {}, ThreadPool(1))) {
      double lowest = ribs->to_m.y();
      for (const geometry::Sphere& sphere : graph.spheres()) {
        lowest = std::min(lowest, sphere.center_m.y() - sphere.radius_m);
      }
      EXPECT_LE(lowest, end.y() + 0.1 * (ribs->to_m.y() - end.y()));
    }
  }
}

TEST(StartingGraphs, OneWithTooMuchToSpareIsLeftOut) {
  const std::vector<int> all = Enclosing(160, {});
  const std::vector<int> few = Enclosing(160, {.most_spared = 1});
  EXPECT_GT(all.front(), 160);
  ASSERT_FALSE(few.empty());
  EXPECT_LE(few.front(), 160);
  EXPECT_EQ(few.back(), all.back());
}

}  // namespace
}  // namespace capfit::refine
