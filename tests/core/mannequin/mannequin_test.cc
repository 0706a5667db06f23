#include "core/mannequin/mannequin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <ostream>
#include <set>
#include <string>
#include <tuple>

#include "core/base/status.h"
#include "tests/core/mannequin/surface_checks.h"

namespace capfit::mannequin {
namespace {

using Eigen::Vector3d;
using test_support::Corners;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

struct Case {
  std::string name;
  MannequinOptions options;
  friend void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }
};

Case Make(const std::string& name, MannequinOptions options) { return {name, options}; }

MannequinOptions With(MannequinSex sex, MannequinPose pose, int faces, bool quads, bool complete) {
  MannequinOptions options;
  options.sex = sex;
  options.pose = pose;
  options.faces = faces;
  options.quads = quads;
  options.with_head = options.with_hands = options.with_feet = complete;
  return options;
}

MannequinOptions WithGirths(MannequinSex sex, double height_m, double bust_m, double waist_m,
                            double hip_m) {
  MannequinOptions options = With(sex, MannequinPose::kA, 6'000, true, true);
  options.height_m = height_m;
  options.bust_m = bust_m;
  options.waist_m = waist_m;
  options.hip_m = hip_m;
  return options;
}

MannequinOptions WithArmAngle(double angle_rad) {
  MannequinOptions options = With(MannequinSex::kMale, MannequinPose::kT, 6'000, true, true);
  options.arm_angle_rad = angle_rad;
  return options;
}

MannequinOptions Without(bool head, bool hands, bool feet) {
  MannequinOptions options = With(MannequinSex::kFemale, MannequinPose::kA, 6'000, true, true);
  options.with_head = !head;
  options.with_hands = !hands;
  options.with_feet = !feet;
  return options;
}

std::vector<Case> Cases() {
  constexpr auto kF = MannequinSex::kFemale;
  constexpr auto kM = MannequinSex::kMale;
  return {
      Make("FemaleT", With(kF, MannequinPose::kT, 8'000, true, true)),
      Make("FemaleA", With(kF, MannequinPose::kA, 20'000, true, true)),
      Make("FemaleSides", With(kF, MannequinPose::kSides, 8'000, true, true)),
      Make("MaleT", With(kM, MannequinPose::kT, 8'000, true, true)),
      Make("MaleA", With(kM, MannequinPose::kA, 8'000, false, true)),
      Make("MaleSides", With(kM, MannequinPose::kSides, 8'000, false, true)),
      Make("CoarsestQuads", With(kF, MannequinPose::kA, 2'000, true, true)),
      Make("CoarsestTriangles", With(kM, MannequinPose::kA, 2'000, false, true)),
      Make("CoarsestCut", With(kM, MannequinPose::kT, 2'000, true, false)),
      Make("FiveThousand", With(kF, MannequinPose::kSides, 5'000, true, true)),
      Make("Fine", With(kF, MannequinPose::kA, 60'000, true, true)),
      Make("FemaleCut", With(kF, MannequinPose::kA, 8'000, true, false)),
      Make("MaleCut", With(kM, MannequinPose::kT, 8'000, false, false)),
      Make("WithoutHead", Without(true, false, false)),
      Make("WithoutHands", Without(false, true, false)),
      Make("WithoutFeet", Without(false, false, true)),
      Make("SlimFemale", WithGirths(kF, 1.75, 0.78, 0.58, 0.86)),
      Make("HeavyFemale", WithGirths(kF, 1.62, 1.08, 0.94, 1.15)),
      Make("HeavyMale", WithGirths(kM, 1.78, 1.20, 1.18, 1.16)),
      Make("SmallPerson", WithGirths(kM, 1.10, 0.58, 0.52, 0.60)),
      Make("ArmsHanging", WithArmAngle(0.15)),
      Make("ArmsThirty", WithArmAngle(30 * kDegree)),
      Make("ArmsRaised", WithArmAngle(2.0)),
  };
}

class MannequinTest : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    auto made = MakeMannequin(GetParam().options);
    ASSERT_TRUE(made.ok()) << made.status();
    soup_ = *std::move(made);
  }
  [[nodiscard]] const MannequinOptions& options() const { return GetParam().options; }
  [[nodiscard]] std::size_t FaceCount() const {
    return soup_.face_sizes.empty() ? soup_.face_vertices.size() / 3 : soup_.face_sizes.size();
  }
  formats::PolygonSoup soup_;
};

TEST_P(MannequinTest, IsOneClosedOutwardSurface) {
  const test_support::SurfaceFacts facts = test_support::Examine(soup_);
  EXPECT_EQ(facts.unmatched_edges, 0);
  EXPECT_EQ(facts.euler_number, 2);
  EXPECT_EQ(facts.unused_vertices, 0);
  // Between 9 and 60 litres for each cubic metre of height, with or without limbs.
  const double cube = std::pow(options().height_m, 3);
  EXPECT_GT(facts.volume, 0.009 * cube);
  EXPECT_LT(facts.volume, 0.060 * cube);
}

TEST_P(MannequinTest, HasAboutAsManyFacesAsAskedFor) {
  EXPECT_NEAR(static_cast<double>(FaceCount()), options().faces, 0.2 * options().faces);
  const std::size_t corners = options().quads ? 4 : 3;
  EXPECT_EQ(soup_.face_vertices.size(), corners * FaceCount());
}

TEST_P(MannequinTest, IsItsOwnMirrorImageBitForBit) {
  std::map<std::tuple<double, double, double>, std::uint32_t> vertex_at;
  for (std::uint32_t i = 0; i < soup_.positions.size(); ++i) {
    const Vector3d& p = soup_.positions[i];
    ASSERT_TRUE(vertex_at.emplace(std::tuple(p.x(), p.y(), p.z()), i).second) << "vertex " << i;
  }
  std::vector<std::uint32_t> image;
  for (const Vector3d& p : soup_.positions) {
    const auto found = vertex_at.find({p.x() == 0.0 ? 0.0 : -p.x(), p.y(), p.z()});
    ASSERT_NE(found, vertex_at.end());
    image.push_back(found->second);
  }
  std::set<std::set<std::uint32_t>> faces;
  for (const Corners& face : test_support::Faces(soup_)) faces.emplace(face.begin(), face.end());
  for (const Corners& face : test_support::Faces(soup_)) {
    std::set<std::uint32_t> mirrored;
    for (const std::uint32_t v : face) mirrored.insert(image[v]);
    ASSERT_TRUE(faces.contains(mirrored));
    ASSERT_FALSE(mirrored == std::set<std::uint32_t>(face.begin(), face.end()));
  }
}

TEST_P(MannequinTest, HasTheHeightAndStandsOnTheFloor) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vector3d& p : soup_.positions) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  if (options().with_feet) {
    EXPECT_EQ(low, 0.0);
  }
  // Coarse meshes have no vertex right on the crown.
  const double tolerance = options().faces < 5'000 ? 6e-3 : 1e-3;
  if (options().with_head) {
    EXPECT_NEAR(high, options().height_m, tolerance * options().height_m);
  }
  if (!options().with_feet) {
    EXPECT_GT(low, 0.03 * options().height_m);
  }
  if (!options().with_head) {
    EXPECT_LT(high, 0.9 * options().height_m);
  }
}

TEST_P(MannequinTest, HasTheGirthsToOnePercent) {
  const auto check = [&](const std::optional<double>& wanted_m, double level) {
    if (!wanted_m) return;
    EXPECT_NEAR(test_support::TapeAt(soup_, level * options().height_m), *wanted_m,
                0.01 * *wanted_m);
  };
  check(options().bust_m, kBustLevel);
  check(options().waist_m, kWaistLevel);
  check(options().hip_m, kHipLevel);
}

TEST_P(MannequinTest, DoesNotCutThroughItself) {
  if (FaceCount() > 30'000)
    GTEST_SKIP() << "SKIPPED: too fine for the slow check; the coarser ones tell";
  EXPECT_EQ(test_support::CountSelfIntersections(soup_), 0);
}

TEST_P(MannequinTest, SameOptionsGiveTheSameBits) {
  const auto again = MakeMannequin(options());
  ASSERT_TRUE(again.ok());
  EXPECT_TRUE(again->positions == soup_.positions);
  EXPECT_EQ(again->face_vertices, soup_.face_vertices);
}

INSTANTIATE_TEST_SUITE_P(Table, MannequinTest, testing::ValuesIn(Cases()),
                         [](const auto& tested) { return tested.param.name; });

// Farthest point of the surface to the left, as the hand's tip.
Vector3d LeftTip(const formats::PolygonSoup& soup) {
  return *std::max_element(soup.positions.begin(), soup.positions.end(),
                           [](const auto& a, const auto& b) { return a.x() < b.x(); });
}

TEST(MannequinPoseTest, ArmsPointTheWayTheyAreTold) {
  for (const double angle_deg : {30.0, 45.0, 60.0, 90.0, 110.0}) {
    MannequinOptions whole = WithArmAngle(angle_deg * kDegree);
    MannequinOptions cut = whole;
    cut.with_hands = false;
    const auto with_hands = MakeMannequin(whole);
    const auto without = MakeMannequin(cut);
    ASSERT_TRUE(with_hands.ok() && without.ok());
    // From the wrist's cut to the fingertips: along the arm, to the accuracy of the two tips.
    const Vector3d hand = LeftTip(*with_hands) - LeftTip(*without);
    EXPECT_NEAR(std::atan2(hand.x(), -hand.y()) / kDegree, angle_deg, 12.0);
    EXPECT_GT(hand.norm(), 0.08 * whole.height_m);
  }
}

TEST(MannequinPoseTest, ToesPointForward) {
  const auto soup = MakeMannequin({});
  ASSERT_TRUE(soup.ok());
  double front = 0.0;
  double back = 0.0;
  for (const Vector3d& p : soup->positions) {
    if (p.y() > 0.03) continue;
    front = std::max(front, p.z());
    back = std::min(back, p.z());
  }
  EXPECT_GT(front, 1.8 * -back);
}

TEST(MannequinPartsTest, CutsAreFlat) {
  MannequinOptions options = Without(true, true, true);
  options.pose = MannequinPose::kT;
  const auto soup = MakeMannequin(options);
  ASSERT_TRUE(soup.ok());
  // The lowest vertices are the ankle's cut, those furthest out the wrist's: many, all in a plane.
  const double low = std::min_element(soup->positions.begin(), soup->positions.end(),
                                      [](const auto& a, const auto& b) { return a.y() < b.y(); })
                         ->y();
  const double out = LeftTip(*soup).x();
  const auto count = [&](const auto& is_in) {
    return std::count_if(soup->positions.begin(), soup->positions.end(), is_in);
  };
  EXPECT_GE(count([&](const Vector3d& p) { return p.y() < low + 1e-9; }), 32);
  EXPECT_GE(count([&](const Vector3d& p) { return p.x() > out - 1e-9; }), 16);
}

TEST(MannequinPartsTest, WhatIsLeftStaysWhereItWas) {
  const auto whole = MakeMannequin(Without(false, false, false));
  const auto cut = MakeMannequin(Without(true, true, true));
  ASSERT_TRUE(whole.ok() && cut.ok());
  for (const double level : {0.52, 0.6, 0.7, 0.75}) {
    const double y = level * 1.70;
    EXPECT_NEAR(test_support::TapeAt(*whole, y), test_support::TapeAt(*cut, y), 2e-3);
  }
}

TEST(MannequinSpeedTest, HalfAMillionFaces) {
  MannequinOptions options;
  options.faces = 500'000;
  const auto soup = MakeMannequin(options);
  ASSERT_TRUE(soup.ok());
  EXPECT_NEAR(static_cast<double>(soup->face_sizes.size()), 5e5, 1e4);
}

struct BadCase {
  std::string name;
  void (*spoil)(MannequinOptions&);
  std::string field;
  std::string limit;
  friend void PrintTo(const BadCase& c, std::ostream* os) { *os << c.name; }
};

class MannequinErrorTest : public testing::TestWithParam<BadCase> {};

TEST_P(MannequinErrorTest, NamesTheOptionAndItsRange) {
  MannequinOptions options;
  GetParam().spoil(options);
  const auto soup = MakeMannequin(options);
  ASSERT_FALSE(soup.ok());
  EXPECT_TRUE(absl::IsInvalidArgument(soup.status()));
  EXPECT_EQ(FieldOf(soup.status()), GetParam().field);
  EXPECT_THAT(std::string(soup.status().message()), HasSubstr(GetParam().limit));
}

INSTANTIATE_TEST_SUITE_P(
    Options, MannequinErrorTest,
    testing::Values(
        BadCase{"Dwarf", [](auto& o) { o.height_m = 0.79; }, "height_m", "[0.8, 2.3]"},
        BadCase{"Giant", [](auto& o) { o.height_m = 2.31; }, "height_m", "[0.8, 2.3]"},
        BadCase{"HeightNan", [](auto& o) { o.height_m = std::nan(""); }, "height_m", "[0.8, 2.3]"},
        BadCase{"Bust", [](auto& o) { o.bust_m = 0.49; }, "bust_m", "[0.5, 1.8]"},
        BadCase{"Waist", [](auto& o) { o.waist_m = 1.9; }, "waist_m", "[0.5, 1.8]"},
        BadCase{"Hip", [](auto& o) { o.hip_m = -1.0; }, "hip_m", "[0.5, 1.8]"},
        BadCase{"HipForHeight", [](auto& o) { o.hip_m = 1.75; }, "hip_m", "sex and height"},
        BadCase{"Angle", [](auto& o) { o.arm_angle_rad = 0.1; }, "arm_angle_rad", "[0.15, 2]"},
        BadCase{"FewFaces", [](auto& o) { o.faces = 1999; }, "faces", "[2000, 500000]"},
        BadCase{"ManyFaces", [](auto& o) { o.faces = 500'001; }, "faces", "[2000, 500000]"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace capfit::mannequin
