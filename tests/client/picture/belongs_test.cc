#include "client/picture/belongs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "client/picture/gaps_file.h"
#include "core/base/status.h"
#include "core/mannequin/mannequin.h"

namespace capfit::client {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using testing::HasSubstr;

formats::PolygonSoup Mannequin(int faces) {
  mannequin::MannequinOptions options;
  options.faces = faces;
  return *mannequin::MakeMannequin(options);
}

formats::PolygonSoup Moved(formats::PolygonSoup soup, const Affine3d& motion) {
  for (Vector3d& position : soup.positions) position = motion * position;
  return soup;
}

Affine3d Scaled(double factor) { return Affine3d(Eigen::Scaling(factor)); }

class BelongsTest : public testing::Test {
 protected:
  BelongsTest() {
    Eigen::AlignedBox3d box;
    for (const Vector3d& position : body_.positions) box.extend(position);
    own_.body = {static_cast<std::int64_t>(body_.positions.size()), box.min(), box.max()};
    own_.metres_per_unit = 1.0;
    foreign_.spheres = {{{0.0, 1.0, 0.0}, 0.15}, {{0.0, 1.4, 0.0}, 0.15}, {{0.1, 0.1, 0.0}, 0.1}};
  }
  [[nodiscard]] absl::Status Own(const Affine3d& motion) const {
    return CheckBelongs(own_, Moved(body_, motion));
  }
  [[nodiscard]] absl::Status Foreign(const Affine3d& motion) const {
    return CheckBelongs(foreign_, Moved(body_, motion));
  }

  const formats::PolygonSoup body_ = Mannequin(6000);
  ResultSet own_;
  ResultSet foreign_;
};

TEST_F(BelongsTest, TheBodyItselfAndItsDecimatedCopyPass) {
  EXPECT_TRUE(Own(Affine3d::Identity()).ok());
  EXPECT_TRUE(CheckBelongs(own_, Mannequin(2000)).ok());
  EXPECT_TRUE(CheckBelongs(own_, Mannequin(40'000)).ok());
}

TEST_F(BelongsTest, WhatMendingLeavesOutDoesNotCount) {
  formats::PolygonSoup with_speck = body_;
  const auto first = static_cast<std::uint32_t>(with_speck.positions.size());
  for (const Vector3d& corner :
       {Vector3d(9, 9, 9), Vector3d(9.1, 9, 9), Vector3d(9, 9.1, 9), Vector3d(9, 9, 9.1)}) {
    with_speck.positions.push_back(corner);
  }
  const std::uint32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  for (const auto& face : faces) {
    if (!with_speck.face_sizes.empty()) with_speck.face_sizes.push_back(3);
    for (const std::uint32_t corner : face) with_speck.face_vertices.push_back(first + corner);
  }
  EXPECT_TRUE(CheckBelongs(own_, with_speck).ok());
}

TEST_F(BelongsTest, AnotherUnitPlaceAxisOrBodyIsRefusedWithBothFigures) {
  const absl::Status status = Own(Scaled(100.0));
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(ReasonOf(status), ErrorReason::kContradictsBody);
  EXPECT_THAT(std::string(status.message()), HasSubstr("RESULT is not of this BODY"));
  EXPECT_THAT(std::string(status.message()), HasSubstr("100 times as large"));
  EXPECT_THAT(std::string(status.message()), HasSubstr(", 1.7, "));
  EXPECT_THAT(std::string(status.message()), HasSubstr(", 170, "));
  EXPECT_FALSE(Own(Scaled(1 / 2.54)).ok());
  EXPECT_FALSE(Own(Affine3d(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX()))).ok());
  mannequin::MannequinOptions options;
  options.height_m = 1.5;
  EXPECT_FALSE(CheckBelongs(own_, *mannequin::MakeMannequin(options)).ok());
}

TEST_F(BelongsTest, TwoPercentOfTheDiagonalAreTheLimit) {
  const double diagonal = (own_.body->box_max - own_.body->box_min).norm();
  EXPECT_TRUE(Own(Affine3d(Eigen::Translation3d(0, 0, 0.0195 * diagonal))).ok());
  EXPECT_FALSE(Own(Affine3d(Eigen::Translation3d(0, 0, 0.0205 * diagonal))).ok());
}

TEST_F(BelongsTest, AForeignSetMustBeOfTheSamePlaceAndSize) {
  EXPECT_TRUE(Foreign(Affine3d::Identity()).ok());
  for (const double factor : {0.001, 0.01, 0.0254, 0.1, 1 / 2.54, 10.0, 39.37, 100.0, 1000.0}) {
    EXPECT_FALSE(Foreign(Scaled(factor)).ok()) << factor;
  }
  EXPECT_FALSE(Foreign(Affine3d(Eigen::Translation3d(0, 2, 0))).ok()) << "beside the body";
  EXPECT_FALSE(Foreign(Affine3d(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX()))).ok())
      << "upside down";
  EXPECT_THAT(std::string(Foreign(Scaled(100.0)).message()), HasSubstr("its spheres reach from"));
}

TEST_F(BelongsTest, AForeignSetOfOneHandOrOneWholeHeapPasses) {
  foreign_.spheres = {{{0.6, 0.85, 0.0}, 0.1}};
  EXPECT_TRUE(Foreign(Affine3d::Identity()).ok());
  foreign_.spheres = {{{0.0, 0.85, 0.0}, 1.1}};
  EXPECT_TRUE(Foreign(Affine3d::Identity()).ok());
  foreign_.spheres.clear();
  EXPECT_TRUE(Foreign(Affine3d::Identity()).ok());
}

TEST_F(BelongsTest, VertexCountsMustBeTheSame) {
  EXPECT_TRUE(CheckVertexCount("gaps", body_.positions.size(), body_).ok());
  const absl::Status status = CheckVertexCount("gaps", 7, body_);
  EXPECT_THAT(std::string(status.message()),
              HasSubstr("gaps has 7 vertices, BODY has " + std::to_string(body_.positions.size())));
}

TEST_F(BelongsTest, GapsMustHaveTheUnitOfTheResult) {
  const VertexGaps gaps{0.01, std::vector<float>(body_.positions.size())};
  EXPECT_THAT(std::string(CheckGapsBelong(gaps, own_, body_).message()),
              HasSubstr("gaps are in units of 0.01 m, RESULT in units of 1 m"));
  own_.metres_per_unit = 0.01;
  EXPECT_TRUE(CheckGapsBelong(gaps, own_, body_).ok());
  EXPECT_TRUE(CheckGapsBelong(gaps, foreign_, body_).ok());
}

}  // namespace
}  // namespace capfit::client
