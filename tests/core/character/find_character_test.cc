#include "core/character/find_character.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/status.h"
#include "core/body/find_body.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/core/mesh/soups.h"

namespace capfit::character {
namespace {

using body::LandmarkId;
using formats::PolygonSoup;
using Joints = std::map<LandmarkId, Eigen::Vector3d>;

constexpr double kPi = 3.14159265358979;

// A woman of 1.70 m, arms held off, as one part called "base".
const PolygonSoup& Woman() {
  static const PolygonSoup woman = [] {
    mannequin::MannequinOptions options;
    options.faces = 6000;
    PolygonSoup soup = *mannequin::MakeMannequin(options);
    soup.parts = {{"base", "skin", 0, soup.face_count(), -1}};
    return soup;
  }();
  return woman;
}

const Joints& JointsOfWoman() {
  static const Joints joints = [] {
    const auto prepared = mesh::PrepareMesh(Woman());
    const auto found = body::FindBody(prepared->mesh, {}, ThreadPool(1), NullObserver());
    Joints all;
    for (int i = 0; i < body::kLandmarkCount; ++i) {
      const auto id = static_cast<LandmarkId>(i);
      if (!found->landmark(id)) continue;
      all[id] = found->body_from_caller.Inverse().Apply(found->landmark(id)->position_m);
    }
    return all;
  }();
  return joints;
}

// The woman and one thing more, as a part of that name.
PolygonSoup WomanWith(const PolygonSoup& thing, const std::string& name) {
  PolygonSoup both = mesh::Together(Woman(), thing);
  both.parts = Woman().parts;
  both.parts.push_back(
      {name, "", Woman().face_count(), both.face_count() - Woman().face_count(), -1});
  return both;
}

// A sheet round the vertical through the point, narrower at its upper end.
PolygonSoup Cone(const Eigen::Vector3d& middle, double low_radius, double high_radius, double low_y,
                 double high_y) {
  constexpr int kAround = 40;
  constexpr int kRings = 10;
  PolygonSoup tube;
  for (int r = 0; r <= kRings; ++r) {
    const double radius = low_radius + (high_radius - low_radius) * r / kRings;
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2.0 * kPi * k / kAround;
      tube.positions.emplace_back(middle.x() + radius * std::cos(angle),
                                  low_y + (high_y - low_y) * r / kRings,
                                  middle.z() + radius * std::sin(angle));
    }
  }
  for (std::uint32_t r = 0; r < kRings; ++r) {
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = r * kAround + k;
      const std::uint32_t b = r * kAround + (k + 1) % kAround;
      for (const std::uint32_t v : {a, a + kAround, b + kAround, b})
        tube.face_vertices.push_back(v);
      tube.face_sizes.push_back(4);
    }
  }
  return tube;
}

// The woman's faces whose middles `is_wanted`, moved.
PolygonSoup Patch(const std::function<bool(const Eigen::Vector3d&)>& is_wanted,
                  const Eigen::Vector3d& by) {
  const PolygonSoup& woman = Woman();
  std::vector<char> mark;
  std::size_t at = 0;
  for (std::size_t face = 0; face < woman.face_count(); ++face) {
    const std::size_t size = woman.face_sizes.empty() ? 3 : woman.face_sizes[face];
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < size; ++k) {
      middle += woman.positions[woman.face_vertices[at + k]] / static_cast<double>(size);
    }
    mark.push_back(is_wanted(middle) ? 1 : 0);
    at += size;
  }
  PolygonSoup patch = formats::WithFaces(woman, mark, 1);
  patch.positions = woman.positions;
  return mesh::Moved(std::move(patch), by);
}

Character Found(const PolygonSoup& soup, const Joints& joints,
                const CharacterOptions& options = {}) {
  const auto found = FindCharacter(soup, options, joints, ThreadPool(2));
  EXPECT_TRUE(found.ok()) << found.status();
  return found.ok() ? *found : Character();
}

// "base body yes, hat accessory no".
std::string TextOf(const Character& character) {
  std::string text;
  for (const CharacterPart& part : character.parts) {
    text += (text.empty() ? "" : ", ") + part.name + " " + std::string(PartKindName(part.kind)) +
            (part.is_included ? " yes" : " no");
  }
  return text;
}

const Eigen::Vector3d& At(LandmarkId id) { return JointsOfWoman().at(id); }

PolygonSoup Skirt() {
  const Eigen::Vector3d hip = 0.5 * (At(LandmarkId::kLeftHip) + At(LandmarkId::kRightHip));
  return Cone(hip, 0.3, 0.14, At(LandmarkId::kLeftKnee).y(), hip.y() + 0.15);
}

PolygonSoup Backpack() {
  return mesh::Moved(mesh::Box({-0.15, 0.0, -0.18}, {0.15, 0.4, 0.0}), {0.0, 1.0, -0.14});
}

PolygonSoup Scalp() {
  const double neck = At(LandmarkId::kNeck).y();
  return Patch([&](const Eigen::Vector3d& p) { return p.y() > neck + 0.16; }, {0.0, 0.01, -0.005});
}

PolygonSoup ChestPlate() {
  return Patch(
      [](const Eigen::Vector3d& p) {
        return p.z() > 0.03 && p.y() > 1.1 && p.y() < 1.35 && std::abs(p.x()) < 0.14;
      },
      {0.0, 0.0, 0.008});
}

TEST(FindCharacterTest, OneSurfaceIsTheBody) {
  for (const Joints& joints : {Joints(), JointsOfWoman()}) {
    const Character found = Found(Woman(), joints);
    EXPECT_EQ(TextOf(found), "base body yes");
    EXPECT_EQ(found.surface_count, 1U);
    EXPECT_TRUE(found.warnings.empty());
    EXPECT_EQ(found.has_joints, !joints.empty());
  }
}

TEST(FindCharacterTest, WithJointsGeometryTellsWhatNamesDoNot) {
  const auto with = [](const PolygonSoup& thing) {
    return TextOf(Found(WomanWith(thing, "x"), JointsOfWoman()));
  };
  EXPECT_EQ(with(Skirt()), "base body yes, x skirt no");
  EXPECT_EQ(with(Backpack()), "base body yes, x accessory no");
  EXPECT_EQ(with(Scalp()), "base body yes, x hair no");
  EXPECT_EQ(with(ChestPlate()), "base body yes, x clothing yes");
  // A hoop that nowhere touches her.
  const Eigen::Vector3d knee = 0.5 * (At(LandmarkId::kLeftKnee) + At(LandmarkId::kRightKnee));
  EXPECT_EQ(with(Cone(knee, 0.45, 0.45, 0.3, 1.0)), "base body yes, x skirt no");
  const Eigen::Vector3d eye = At(LandmarkId::kNeck) + Eigen::Vector3d(0.03, 0.12, 0.08);
  EXPECT_EQ(with(mesh::Moved(mesh::Ball(12, 6, 0.012), eye)), "base body yes, x inner no");
  EXPECT_EQ(with(mesh::Moved(mesh::Box({0, 0, 0}, {0.3, 0.3, 0.3}), {0.0, 3.0, 0.0})),
            "base body yes, x fragment no");
}

TEST(FindCharacterTest, NamesDoNotTakeAwayWhatGoesAroundTheTrunk) {
  PolygonSoup liar = Woman();
  liar.parts[0].name = "Sword";
  EXPECT_EQ(TextOf(Found(liar, JointsOfWoman())), "Sword body yes");
  EXPECT_EQ(TextOf(Found(liar, {})), "Sword body yes");  // nothing else is there
}

TEST(FindCharacterTest, WithoutJointsNamesTell) {
  EXPECT_EQ(TextOf(Found(WomanWith(Backpack(), "Rucksack"), {})),
            "base body yes, Rucksack accessory no");
  EXPECT_EQ(TextOf(Found(WomanWith(Skirt(), "Skirt"), {})), "base body yes, Skirt skirt no");
  EXPECT_EQ(TextOf(Found(WomanWith(ChestPlate(), "ChestPlate"), {})),
            "base body yes, ChestPlate clothing yes");
}

CharacterOptions HairOrSkirt(bool hair, bool skirt) { return {{}, {}, hair, skirt}; }

TEST(FindCharacterTest, HairAndSkirtsByOption) {
  EXPECT_EQ(TextOf(Found(WomanWith(Skirt(), "x"), JointsOfWoman(), HairOrSkirt(false, true))),
            "base body yes, x skirt yes");
  EXPECT_EQ(TextOf(Found(WomanWith(Scalp(), "x"), JointsOfWoman(), HairOrSkirt(true, false))),
            "base body yes, x hair yes");
}

TEST(FindCharacterTest, TheCallersWordDecides) {
  const PolygonSoup soup = WomanWith(Backpack(), "Rucksack");
  EXPECT_EQ(TextOf(Found(soup, JointsOfWoman(), {{"ruck*"}, {}})),
            "base body yes, Rucksack accessory yes");
  EXPECT_EQ(TextOf(Found(soup, JointsOfWoman(), {{"*"}, {"RUCKSACK"}})),
            "base body yes, Rucksack accessory no");
  EXPECT_EQ(TextOf(Found(soup, JointsOfWoman(), {{"skin"}, {}})),  // a material
            "base body yes, Rucksack accessory no");
  const auto unknown = FindCharacter(soup, {{}, {"Rucksack", "Hat"}}, {}, ThreadPool(1));
  EXPECT_EQ(unknown.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(FieldOf(unknown.status()), "options.exclude_parts[1]");
  EXPECT_THAT(std::string(unknown.status().message()), testing::HasSubstr("Rucksack, base"));
  const auto nothing = FindCharacter(soup, {{}, {"*"}}, {}, ThreadPool(1));
  EXPECT_EQ(ReasonOf(nothing.status()), ErrorReason::kNothingToFit);
}

TEST(FindCharacterTest, FloorsAreLeftOut) {
  const PolygonSoup floor = mesh::Box({-0.5, -0.002, -0.5}, {0.5, 0.0, 0.5});
  for (const Joints& joints : {Joints(), JointsOfWoman()}) {
    EXPECT_EQ(TextOf(Found(WomanWith(floor, ""), joints)), "base body yes,  fragment no");
  }
  // One that hangs together with the feet, as marked.
  std::vector<char> is_floor(Woman().face_count(), 0);
  is_floor[0] = is_floor[1] = 1;
  const auto found = FindCharacter(Woman(), {}, {}, ThreadPool(1), is_floor);
  ASSERT_TRUE(found.ok()) << found.status();
  EXPECT_EQ(TextOf(*found), "base body yes, base fragment no");
  EXPECT_EQ(found->is_left_out[0] + found->is_left_out[1] + found->is_left_out[2], 2);
}

TEST(FindCharacterTest, TwoPeopleAreRefusedByName) {
  const PolygonSoup two = WomanWith(mesh::Moved(Woman(), {2.0, 0.0, 0.0}), "妹");
  const auto found = FindCharacter(two, {}, {}, ThreadPool(1));
  EXPECT_EQ(ReasonOf(found.status()), ErrorReason::kTwoBodies);
  EXPECT_THAT(std::string(found.status().message()),
              testing::AllOf(testing::HasSubstr("\"base\""), testing::HasSubstr("\"妹\"")));
}

TEST(FindCharacterTest, MasksAndPartsAgreeForAnyThreads) {
  const PolygonSoup soup = WomanWith(Backpack(), "x");
  const auto one = FindCharacter(soup, {}, JointsOfWoman(), ThreadPool(1));
  const auto many = FindCharacter(soup, {}, JointsOfWoman(), ThreadPool(5));
  EXPECT_EQ(one->is_left_out, many->is_left_out);
  std::size_t faces = 0;
  for (const CharacterPart& part : one->parts) faces += part.face_count;
  EXPECT_EQ(faces, soup.face_count());
  EXPECT_EQ(std::count(one->is_left_out.begin(), one->is_left_out.end(), 1), 6);
  ASSERT_EQ(one->warnings.size(), 1U);
  EXPECT_EQ(one->warnings[0].code, "PARTS_LEFT_OUT");
  EXPECT_THAT(one->warnings[0].message, testing::HasSubstr("x: accessory"));
}

TEST(FindCharacterTest, WhatFallsApartIsRefusedInTime) {
  PolygonSoup crumbs;
  for (std::uint32_t i = 0; i < 30'000; ++i) {
    const Eigen::Vector3d p(0.01 * (i % 100), 0.01 * (i / 100 % 100), 0.01 * (i / 10000));
    for (const Eigen::Vector3d& d :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.001, 0, 0), Eigen::Vector3d(0, 0.001, 0)}) {
      crumbs.positions.push_back(p + d);
      crumbs.face_vertices.push_back(static_cast<std::uint32_t>(crumbs.positions.size() - 1));
    }
  }
  const auto found = FindCharacter(crumbs, {}, JointsOfWoman(), ThreadPool(1));
  EXPECT_EQ(ReasonOf(found.status()), ErrorReason::kNoSurface);
}

}  // namespace
}  // namespace capfit::character
