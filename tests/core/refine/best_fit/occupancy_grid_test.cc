#include "core/refine/best_fit/occupancy_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/refine/best_fit/fill_error.h"
#include "tests/core/refine/ball_body.h"

namespace capfit::refine {
namespace {

capsule::MirroredSet Ball(const Eigen::Vector3d& center, double radius_m, bool is_mirrored) {
  capsule::MirroredSet graph(is_mirrored);
  graph.AddSphere({center, radius_m}, true);
  return graph;
}

class OccupancyGridTest : public testing::TestWithParam<bool> {};

TEST_P(OccupancyGridTest, VolumeIsThatOfTheMesh) {
  const body::Body body = BallBody({0.0, 0.3, 0.05}, 0.2);
  ASSERT_GT(body.mesh.volume(), 0.0);
  const OccupancyGrid grid = MakeOccupancyGrid(body, AllParts(), 0.008, GetParam(), ThreadPool(1));
  EXPECT_NEAR(grid.volume_m3, body.mesh.volume(), 0.005 * body.mesh.volume());
}

TEST_P(OccupancyGridTest, CostIsOneOutsideMinusOneInsideAndZeroOnTheSurface) {
  const OccupancyGrid grid = MakeOccupancyGrid(BallBody({0.0, 0.3, 0.05}, 0.2), AllParts(), 0.008,
                                               GetParam(), ThreadPool(1));
  const float x[] = {0.0f, 0.0f, 0.0f, 5.0f}, y[] = {0.3f, 0.53f, 0.5f, 0.0f},
              z[] = {0.05f, 0.05f, 0.05f, 0.0f};
  float cost[4];
  SampleCost(grid, x, y, z, 4, cost);
  EXPECT_FLOAT_EQ(cost[0], -1.0f);
  EXPECT_FLOAT_EQ(cost[1], 1.0f);
  EXPECT_NEAR(cost[2], 0.0f, 0.3f);
  EXPECT_FLOAT_EQ(cost[3], 1.0f);
}

TEST_P(OccupancyGridTest, ACoarserGridHoldsTheSame) {
  const Eigen::Vector3d center(0.0, 0.3, 0.05);
  const OccupancyGrid grid =
      MakeOccupancyGrid(BallBody(center, 0.2), AllParts(), 0.008, GetParam(), ThreadPool(1));
  const OccupancyGrid coarse = CoarserGrid(grid);
  EXPECT_EQ(coarse.volume_m3, grid.volume_m3);
  EXPECT_FLOAT_EQ(coarse.cell_m, 0.016f);
  double fine_cells = 0.0, coarse_cells = 0.0;
  for (const int share : grid.inside) fine_cells += share;
  for (const int share : coarse.inside) coarse_cells += share;
  EXPECT_NEAR(coarse_cells, fine_cells / 8.0, 1e-3 * fine_cells);
  capsule::MirroredSet less = Ball(center, 0.16, GetParam());
  EXPECT_NEAR(GridError(coarse, less, ThreadPool(1)), 1.0 - std::pow(0.8, 3), 0.02);
}

TEST_P(OccupancyGridTest, FullCellsAreThoseWhollyInside) {
  const Eigen::Vector3d center(0.0, 0.3, 0.05);
  const tighten::FullCells full = FullCellsOf(
      MakeOccupancyGrid(BallBody(center, 0.2), AllParts(), 0.008, GetParam(), ThreadPool(1)));
  for (const double side : {-1.0, 1.0}) {
    for (const Eigen::Vector3d& out : {Eigen::Vector3d(1, 0, 0), {0, 1, 0}, {0, 0, -1}}) {
      EXPECT_TRUE(full.Holds(center + side * 0.185 * out)) << side * out.transpose();
      EXPECT_FALSE(full.Holds(center + side * 0.205 * out)) << side * out.transpose();
    }
  }
}

TEST_P(OccupancyGridTest, ErrorIsNothingForTheBallItselfAndExactForOthers) {
  const Eigen::Vector3d center(0.0, 0.3, 0.05);
  const OccupancyGrid grid =
      MakeOccupancyGrid(BallBody(center, 0.2), AllParts(), 0.008, GetParam(), ThreadPool(1));
  const capsule::MirroredSet same = Ball(center, 0.2, GetParam());
  const capsule::MirroredSet less = Ball(center, 0.16, GetParam());
  const capsule::MirroredSet more = Ball(center, 0.22, GetParam());
  EXPECT_LT(GridError(grid, same, ThreadPool(1)), 0.02);
  EXPECT_NEAR(GridError(grid, less, ThreadPool(1)), 1.0 - std::pow(0.8, 3), 0.015);
  EXPECT_NEAR(GridError(grid, more, ThreadPool(1)), std::pow(1.1, 3) - 1.0, 0.015);
}

TEST_P(OccupancyGridTest, PartsLeftOutCostNothingToFillAndNothingToLeave) {
  body::PartSelection no_feet;
  const Eigen::Vector3d center(0.0, 0.3, 0.05);
  const OccupancyGrid grid =
      MakeOccupancyGrid(BallBody(center, 0.2), no_feet, 0.008, GetParam(), ThreadPool(1));
  const double whole = 4.0 / 3.0 * std::numbers::pi * 0.008;
  EXPECT_NEAR(grid.volume_m3, 0.5 * whole, 0.05 * whole);
  const float x = 0.0f, y = 0.2f, z = 0.05f;
  float cost = 1.0f;
  SampleCost(grid, &x, &y, &z, 1, &cost);
  EXPECT_FLOAT_EQ(cost, 0.0f);
  capsule::MirroredSet same = Ball(center, 0.2, GetParam());
  EXPECT_LT(GridError(grid, same, ThreadPool(1)), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Folding, OccupancyGridTest, testing::Bool(),
                         [](const auto& test) { return test.param ? "Folded" : "Whole"; });

}  // namespace
}  // namespace capfit::refine
