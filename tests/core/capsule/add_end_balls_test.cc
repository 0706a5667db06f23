#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/capsule/build_primitives.h"

namespace capfit::capsule {
namespace {

using body::Part;
using body::Segment;

// A body whose vertices are the corners of one small box for each of the segments. Its faces are
// those of the boxes; nothing here looks at them.
body::Body BoxBody(const std::vector<std::pair<Segment, Eigen::Vector3d>>& boxes, bool symmetric) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<mesh::Triangle> triangles;
  std::vector<Segment> segments;
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [segment, middle] : boxes) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (int i = 0; i < 8; ++i) {
      vertices.push_back(middle +
                         0.1 * Eigen::Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
      segments.push_back(segment);
    }
    for (const auto& f : kFaces) {
      triangles.push_back({first + f[0], first + f[1], first + f[2]});
      triangles.push_back({first + f[0], first + f[2], first + f[3]});
    }
  }
  body::Body body{mesh::BodyMesh(vertices, triangles, std::vector<std::int32_t>(vertices.size())),
                  {},
                  1.8,
                  symmetric,
                  {},
                  segments,
                  {},
                  {}};
  return body;
}

constexpr body::PartSelection kAll{true, true, true, true, true, true};

TEST(AddEndBallsTest, BallsAroundHeadHandsAndFeetOnly) {
  const body::Body body = BoxBody({{Segment::kTorso, {0, 1, 0}},
                                   {Segment::kHead, {0, 1.6, 0}},
                                   {Segment::kLeftHand, {0.5, 1, 0}},
                                   {Segment::kRightHand, {-0.6, 1, 0}},
                                   {Segment::kLeftFoot, {0.1, 0, 0.1}}},
                                  false);
  PrimitiveSet set;
  AddBalls(MakeEndBalls(body, kAll, {}), set);
  ASSERT_EQ(set.spheres.size(), 4u);
  EXPECT_EQ(set.origins[0].part, Part::kHead);
  EXPECT_EQ(set.origins[1].part, Part::kLeftHand);
  EXPECT_EQ(set.origins[2].part, Part::kRightHand);
  EXPECT_EQ(set.origins[3].part, Part::kLeftFoot);
  for (const SphereOrigin& origin : set.origins) {
    EXPECT_EQ(origin.mirror, -1);
    EXPECT_EQ(origin.polygon, -1);
  }
  EXPECT_NEAR((set.spheres[2].center_m - Eigen::Vector3d(-0.6, 1, 0)).norm(), 0.0, 1e-12);
  for (const geometry::Sphere& ball : set.spheres) {
    EXPECT_NEAR(ball.radius_m, 0.1 * std::sqrt(3.0), 1e-12);
  }
}

TEST(AddEndBallsTest, OnASymmetricBodyTheyAreExactImagesAroundBothSides) {
  const body::Body body = BoxBody({{Segment::kHead, {0.001, 1.6, 0}},
                                   {Segment::kLeftHand, {0.5, 1, 0}},
                                   {Segment::kRightHand, {-0.51, 1, 0.02}}},
                                  true);
  PrimitiveSet set;
  AddBalls(MakeEndBalls(body, kAll, {}), set);
  ASSERT_EQ(set.spheres.size(), 3u);
  EXPECT_EQ(set.spheres[0].center_m.x(), 0.0);
  EXPECT_EQ(set.origins[0].mirror, 0);
  EXPECT_EQ(set.origins[1].mirror, 2);
  EXPECT_EQ(set.origins[2].mirror, 1);
  EXPECT_EQ(set.spheres[1].center_m.x(), -set.spheres[2].center_m.x());
  EXPECT_EQ(set.spheres[1].radius_m, set.spheres[2].radius_m);
  for (std::size_t v = 0; v < body.vertex_segments.size(); ++v) {
    double least = 1e9;
    for (const geometry::Sphere& ball : set.spheres) {
      least = std::min(least, geometry::SignedDistance(ball, body.mesh.vertices()[v]));
    }
    EXPECT_LE(least, 1e-12);
  }
}

TEST(AddEndBallsTest, OnlyWhatIsAskedForIndicesGoOnFromTheSet) {
  const body::Body body =
      BoxBody({{Segment::kHead, {0, 1.6, 0}}, {Segment::kLeftFoot, {0.1, 0, 0.1}}}, true);
  PrimitiveSet set;
  set.spheres.push_back({{0, 1, 0}, 0.1});
  set.origins.emplace_back();
  AddBalls(MakeEndBalls(body, {true, true, true, true, false, false}, {}), set);
  ASSERT_EQ(set.spheres.size(), 2u);
  EXPECT_EQ(set.origins[1].part, Part::kHead);
  EXPECT_EQ(set.origins[1].mirror, 1);
}

// Of each cluster: here two boxes beside each other.
TEST(AddEndBallsTest, SeveralAreAroundClustersOfThePart) {
  const body::Body body = BoxBody({{Segment::kHead, {0.0, 1.5, 0.0}},
                                   {Segment::kHead, {0.0, 1.9, 0.1}},
                                   {Segment::kLeftFoot, {0.2, 0.1, 0.0}},
                                   {Segment::kLeftFoot, {0.2, 0.1, 0.4}},
                                   {Segment::kRightFoot, {-0.2, 0.1, 0.0}},
                                   {Segment::kRightFoot, {-0.2, 0.1, 0.4}}},
                                  true);
  PrimitiveSet set;
  AddBalls(MakeEndBalls(body, kAll, {.head = 2, .hand = 3, .foot = 2}), set);
  ASSERT_EQ(set.spheres.size(), 6u);
  for (const geometry::Sphere& ball : set.spheres) {
    EXPECT_NEAR(ball.radius_m, 0.1 * std::sqrt(3.0), 1e-9);
  }
  EXPECT_EQ(set.spheres[0].center_m.x(), 0.0);
  EXPECT_EQ(set.spheres[1].center_m.x(), 0.0);
  EXPECT_NEAR(std::abs(set.spheres[0].center_m.y() - set.spheres[1].center_m.y()), 0.4, 1e-9);
  for (const std::size_t left : {2u, 4u}) {
    EXPECT_EQ(set.origins[left].part, Part::kLeftFoot);
    EXPECT_EQ(set.origins[left].mirror, static_cast<int>(left) + 1);
    EXPECT_EQ(set.origins[left + 1].mirror, static_cast<int>(left));
    EXPECT_EQ(set.spheres[left].center_m.x(), -set.spheres[left + 1].center_m.x());
  }
  EXPECT_NEAR(std::abs(set.spheres[2].center_m.z() - set.spheres[4].center_m.z()), 0.4, 1e-9);
}

// The head of a body that leans to a side is longest aside; its balls stay in the middle.
TEST(AddEndBallsTest, OfAHeadTheyAreInTheMiddlePlane) {
  const body::Body body = BoxBody({{Segment::kHead, {-0.5, 1.5, 0.0}},
                                   {Segment::kHead, {0.5, 1.5, 0.0}},
                                   {Segment::kHead, {0.0, 1.8, 0.0}}},
                                  true);
  PrimitiveSet set;
  AddBalls(MakeEndBalls(body, kAll, {.head = 2}), set);
  ASSERT_EQ(set.spheres.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(set.spheres[i].center_m.x(), 0.0);
    EXPECT_EQ(set.origins[i].mirror, static_cast<int>(i));
  }
  EXPECT_NEAR(std::abs(set.spheres[0].center_m.y() - set.spheres[1].center_m.y()), 0.3, 1e-9);
}

// Two spheres of each chain, one nearer to the ball's place than the other; pairs where not
// centred.
PrimitiveSet ChainsAndBalls() {
  PrimitiveSet set;
  const auto pair = [&](Part part, const Eigen::Vector3d& at) {
    const int index = static_cast<int>(set.spheres.size());
    set.spheres.push_back({at, 0.05});
    set.spheres.push_back({{-at.x(), at.y(), at.z()}, 0.05});
    set.origins.push_back({part, -1, index + 1});
    set.origins.push_back({body::MirrorPart(part), -1, index});
  };
  pair(Part::kTorso, {0.1, 1.0, 0.0});   // 0, 1
  pair(Part::kTorso, {0.05, 1.4, 0.0});  // 2, 3
  pair(Part::kLeftArm, {0.3, 1.3, 0.0});
  pair(Part::kLeftArm, {0.6, 1.3, 0.0});   // 6, 7
  pair(Part::kLeftHand, {0.8, 1.3, 0.0});  // 8, 9
  set.spheres.push_back({{0.0, 1.6, 0.0}, 0.1});
  set.origins.push_back({Part::kHead, -1, 10});
  return set;
}

TEST(LinkEndBallsTest, BallsAreJoinedToTheNearestOfTheirChain) {
  PrimitiveSet set = ChainsAndBalls();
  LinkEndBalls(set);
  std::sort(set.capsules.begin(), set.capsules.end());
  const std::vector<CapsuleEnds> expected = {{2, 10}, {3, 10}, {6, 8}, {7, 9}};
  EXPECT_EQ(set.capsules, expected);
  EXPECT_EQ(set.spheres.size(), ChainsAndBalls().spheres.size());
}

TEST(LinkEndBallsTest, ARowIsJoinedAndHangsOnWhatIsNearest) {
  PrimitiveSet set;
  set.spheres = {{{0.1, 1.0, 0.0}, 0.1},
                 {{0.1, 0.2, 0.0}, 0.1},
                 {{0.1, 0.0, 0.4}, 0.05},
                 {{0.1, 0.0, 0.2}, 0.05},
                 {{0.1, 0.0, 0.0}, 0.05}};
  set.origins = {{Part::kLeftLeg, -1, -1},
                 {Part::kLeftLeg, -1, -1},
                 {Part::kLeftFoot, -1, -1},
                 {Part::kLeftFoot, -1, -1},
                 {Part::kLeftFoot, -1, -1}};
  LinkEndBalls(set);
  std::sort(set.capsules.begin(), set.capsules.end());
  const std::vector<CapsuleEnds> expected = {{1, 4}, {2, 3}, {3, 4}};
  EXPECT_EQ(set.capsules, expected);
}

// A palm with two fingers: the second one hangs on the palm, not on the first one's tip.
TEST(LinkEndBallsTest, BallsAreJoinedAsATreeOfTheNearest) {
  PrimitiveSet set;
  const auto add = [&](double x, double y, double radius_m) {
    set.spheres.push_back({{x, y, 0.0}, radius_m});
  };
  add(-0.02, 0.2, 0.01);  // a finger's tip
  add(0.12, 0.2, 0.01);   // the other's
  add(0.0, 0.1, 0.01);
  add(0.05, 0.0, 0.05);  // the palm
  add(0.1, 0.1, 0.01);
  add(0.05, -0.1, 0.04);  // of the arm
  set.origins.assign(5, {Part::kLeftHand, -1, -1});
  set.origins.push_back({Part::kLeftArm, -1, -1});
  LinkEndBalls(set);
  std::sort(set.capsules.begin(), set.capsules.end());
  const std::vector<CapsuleEnds> expected = {{0, 2}, {1, 4}, {2, 3}, {3, 4}, {3, 5}};
  EXPECT_EQ(set.capsules, expected);
}

TEST(LinkEndBallsTest, BallsWithoutAChainStayAlone) {
  PrimitiveSet set;
  set.spheres = {{{0.1, 0.0, 0.0}, 0.1}, {{0.3, 1.0, 0.0}, 0.1}};
  set.origins = {{Part::kLeftFoot, -1, -1}, {Part::kLeftArm, -1, -1}};
  LinkEndBalls(set);
  EXPECT_TRUE(set.capsules.empty());
}

}  // namespace
}  // namespace capfit::capsule
