#include "core/pipeline/overlap_warning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace capfit::pipeline {
namespace {

// Two cubes with sides of 1, the second moved along x.
body::Body TwoCubes(double moved) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<mesh::Triangle> triangles;
  for (const double x : {0.0, moved}) {
    const auto base = static_cast<std::uint32_t>(vertices.size());
    for (int k = 0; k < 8; ++k) vertices.emplace_back(x + (k & 1), (k & 2) / 2, (k & 4) / 4);
    for (const mesh::Triangle& t : std::vector<mesh::Triangle>{{0, 2, 3},
                                                               {0, 3, 1},
                                                               {4, 5, 7},
                                                               {4, 7, 6},
                                                               {0, 1, 5},
                                                               {0, 5, 4},
                                                               {2, 6, 7},
                                                               {2, 7, 3},
                                                               {0, 4, 6},
                                                               {0, 6, 2},
                                                               {1, 3, 7},
                                                               {1, 7, 5}}) {
      triangles.push_back({base + t[0], base + t[1], base + t[2]});
    }
  }
  body::Body body{mesh::BodyMesh(std::move(vertices), std::move(triangles), {}),
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
