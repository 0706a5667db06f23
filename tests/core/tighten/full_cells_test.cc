#include "core/tighten/full_cells.h"

#include <gtest/gtest.h>

#include <limits>

namespace capfit::tighten {
namespace {

// 2 x 1 x 2 cells of a tenth of a metre, all full but the first.
FullCells Cells(bool folded) {
  return {.origin_m = {-0.1f, 1.0f, 0.0f},
          .cells_per_m = 10.0f,
          .nx = 2,
          .ny = 1,
          .nz = 2,
          .folded = folded,
          .is_full = {0, 1, 1, 1}};
}

TEST(FullCells, HoldWhatLiesInOneOfThem) {
  const FullCells cells = Cells(false);
  EXPECT_FALSE(cells.Holds({-0.05, 1.05, 0.05}));
  EXPECT_TRUE(cells.Holds({-0.05, 1.05, 0.15}));
  EXPECT_TRUE(cells.Holds({0.05, 1.05, 0.05}));
  EXPECT_TRUE(cells.Holds({0.05, 1.05, 0.15}));
}

TEST(FullCells, HoldNothingBesideTheirBox) {
  const FullCells cells = Cells(false);
  for (const Eigen::Vector3d& at : {Eigen::Vector3d(0.15, 1.05, 0.05),
                                    {0.05, 0.95, 0.05},
                                    {0.05, 1.15, 0.05},
                                    {0.05, 1.05, -0.05},
                                    {0.05, 1.05, 0.25},
                                    {1e30, 1.05, 0.05}}) {
    EXPECT_FALSE(cells.Holds(at)) << at.transpose();
  }
  EXPECT_FALSE(cells.Holds({0.05, std::numeric_limits<double>::quiet_NaN(), 0.05}));
  EXPECT_FALSE(FullCells().Holds({0.0, 0.0, 0.0}));
}

TEST(FullCells, FoldedOnesHoldBothSides) {
  const FullCells cells = Cells(true);
  EXPECT_TRUE(cells.Holds({0.05, 1.05, 0.05}));
  EXPECT_TRUE(cells.Holds({-0.05, 1.05, 0.05}));
}

}  // namespace
}  // namespace capfit::tighten
