#include "core/section/valleys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/core/section/shapes.h"

namespace capfit::section {
namespace {

// An ellipse 0.3 m by 0.22 m with two round bulges at the front (+y), the cleft in the middle.
std::vector<Eigen::Vector2d> Chest(double bulge, int count) {
  std::vector<Eigen::Vector2d> points(static_cast<std::size_t>(count));
  for (int i = 0; i <= count / 2; ++i) {  // from the back over x > 0 to the front
    const double a = kPi * i / (count / 2);
    const double lobe = std::exp(-std::pow((a - 0.8 * kPi) / 0.25, 2));
    const double x = 0.15 * std::sin(a) * (1 + bulge * lobe);
    const double y = -0.11 * std::cos(a) * (1 + 2 * bulge * lobe);
    const bool on_axis = i == 0 || i == count / 2;
    points[i] = {on_axis ? 0.0 : x, y};
    if (!on_axis) points[count - i] = {-x, y};
  }
  return points;
}

TEST(ValleysTest, FindsTheCleftInTheMiddleAndMirroredSides) {
  const auto chest = Chest(0.3, 128);
  const auto valleys = FindValleys(chest, Eigen::Vector2d::UnitY());
  ASSERT_TRUE(valleys.has_value());
  EXPECT_EQ(valleys->middle, 64);
  EXPECT_EQ(valleys->side[0] + valleys->side[1], 128);
  EXPECT_GT(valleys->bulge_height_m, 0.01);
  EXPECT_NEAR(valleys->middle_depth_m, valleys->bulge_height_m, 1e-12);
}

TEST(ValleysTest, HigherBulgesAreMeasuredHigher) {
  double before = 0.0;
  for (const double bulge : {0.15, 0.25, 0.35, 0.45}) {
    const auto valleys = FindValleys(Chest(bulge, 128), Eigen::Vector2d::UnitY());
    ASSERT_TRUE(valleys.has_value());
    EXPECT_GT(valleys->bulge_height_m / valleys->width_m, before);
    before = valleys->bulge_height_m / valleys->width_m;
  }
  EXPECT_GT(before, 0.04);
}

TEST(ValleysTest, TurningTheOutlineTurnsTheValleys) {
  const auto chest = Chest(0.3, 128);
  for (const double angle : {0.4, 1.9, -2.5}) {
    const Eigen::Rotation2Dd turn(angle);
    std::vector<Eigen::Vector2d> turned;
    for (const Eigen::Vector2d& p : chest) turned.push_back(turn * p);
    const auto a = FindValleys(chest, Eigen::Vector2d::UnitY());
    const auto b = FindValleys(turned, turn * Eigen::Vector2d::UnitY());
    ASSERT_TRUE(b.has_value());
    EXPECT_EQ(a->middle, b->middle);
    EXPECT_NEAR(a->bulge_height_m, b->bulge_height_m, 1e-9);
  }
}

TEST(ValleysTest, PiecesCoverTheOutlineAndShareBorders) {
  const auto chest = Chest(0.3, 128);
  const auto valleys = FindValleys(chest, Eigen::Vector2d::UnitY());
  const PolygonSplit split = SplitAtValleys(chest.size(), *valleys);
  ASSERT_EQ(split.pieces.size(), 3u);
  std::set<int> all;
  std::size_t total = 0;
  for (const auto& piece : split.pieces) {
    EXPECT_GE(piece.size(), 3u);
    all.insert(piece.begin(), piece.end());
    total += piece.size();
  }
  EXPECT_EQ(all.size(), 128u);
  EXPECT_EQ(total, 131u);
  EXPECT_EQ(split.pieces[0].back(), split.pieces[1].front());
  EXPECT_EQ(split.pieces[1].back(), split.pieces[2].front());
  EXPECT_EQ(split.pieces[2].back(), split.pieces[0].front());
}

}  // namespace
}  // namespace capfit::section
