#include "core/pipeline/overlap_warning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <vector>

#include "tests/core/mesh/boxes.h"

namespace capfit::pipeline {
namespace {

// Of a cube with sides of 1, which was 100 and stood elsewhere.
std::optional<Warning> WarningOf(const metrics::Overlap& overlap) {
  body::Body body{mesh::BoxesOf(std::vector<std::array<Eigen::Vector3d, 2>>{
                      {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()}}),
                  {},
                  1.0,
                  false,
                  {},
                  {},
                  {},
                  {}};
  body.body_from_caller.scale = 0.01;
  body.body_from_caller.translation = {1.0, 0.0, 0.0};
  return WarningOfOverlap(body, overlap);
}

TEST(OverlapWarningTest, TellsHowMuchAndWhereInTheCallersFrame) {
  const auto warning = WarningOf({0.25, {0.75, 0.5, 0.5}});
  ASSERT_TRUE(warning.has_value());
  EXPECT_EQ(warning->code, "SURFACE_OVERLAPS");
  EXPECT_THAT(warning->message, testing::HasSubstr("25 % of its volume"));
  EXPECT_THAT(warning->message, testing::HasSubstr("(-25, 50, 50)"));
}

TEST(OverlapWarningTest, WhatIsLittleIsNotTold) {
  EXPECT_FALSE(WarningOf({0.0009, {0.75, 0.5, 0.5}}).has_value());
  EXPECT_FALSE(WarningOf({}).has_value());
}

}  // namespace
}  // namespace capfit::pipeline
