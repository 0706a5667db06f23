#include "core/pipeline/overlap_warning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/core/mesh/boxes.h"

namespace capfit::pipeline {
namespace {

// Two cubes with sides of 1, the second moved along x.
body::Body TwoCubes(double moved) {
  const Eigen::Vector3d along(moved, 0, 0);
  const Eigen::Vector3d side = Eigen::Vector3d::Ones();
  body::Body body{mesh::BoxesOf(std::vector<std::array<Eigen::Vector3d, 2>>{
                      {Eigen::Vector3d::Zero(), side}, {along, along + side}}),
                  {},
                  1.0,
                  false,
                  {},
                  {},
                  {},
                  {}};
  body.body_from_caller.scale = 0.01;
  body.body_from_caller.translation = {1.0, 0.0, 0.0};
  return body;
}

TEST(OverlapWarningTest, TellsHowMuchAndWhereInTheCallersFrame) {
  const auto warning = WarningOfOverlap(TwoCubes(0.5));
  ASSERT_TRUE(warning.has_value());
  EXPECT_EQ(warning->code, "SURFACE_OVERLAPS");
  // A quarter of both volumes, in the middle of [0.5, 1]: in centimetres, a metre further back.
  EXPECT_THAT(warning->message, testing::HasSubstr("25 % of its volume"));
  EXPECT_THAT(warning->message, testing::HasSubstr("(-25"));
}

TEST(OverlapWarningTest, WhatOnlyTouchesDoesNotCount) {
  EXPECT_FALSE(WarningOfOverlap(TwoCubes(1.0)).has_value());
  EXPECT_FALSE(WarningOfOverlap(TwoCubes(2.0)).has_value());
}

}  // namespace
}  // namespace capfit::pipeline
