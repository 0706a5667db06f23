#include "core/refine/graph/points_apart.h"

#include <gtest/gtest.h>

namespace capfit::refine {
namespace {

TEST(BestApartTest, TakesTheBestThatKeepTheirDistance) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {1.5, 0, 0}, {5, 0, 0}};
  using Points = std::vector<Eigen::Vector3d>;
  EXPECT_EQ(BestApart(points, {1, 4, 3, 2}, 1.0, 9), (Points{points[1], points[3], points[0]}));
  EXPECT_EQ(BestApart(points, {1, 4, 3, 2}, 1.0, 2), (Points{points[1], points[3]}));
  EXPECT_EQ(BestApart(points, {0, -1, 3, 0}, 0.0, 9), (Points{points[2]}));
  EXPECT_EQ(BestApart(points, {2, 2, 2, 2}, 1.2, 9), (Points{points[0], points[2], points[3]}));
}

}  // namespace
}  // namespace capfit::refine
