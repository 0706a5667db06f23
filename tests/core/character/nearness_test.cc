#include "core/character/nearness.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/core/mesh/soups.h"

namespace capfit::character {
namespace {

TEST(CellSetTest, NearIsUpToACellAndFarFromFourOn) {
  constexpr double kCell = 0.25;
  const Shells ball = FindShells(mesh::Ball(64, 32));
  CellSet cells(kCell);
  for (const Facet& facet : ball.facets) cells.Add(facet);
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p(random.NextIn(-3, 3), random.NextIn(-3, 3), random.NextIn(-3, 3));
    const double off = std::abs(p.norm() - 1.0);
    if (off < 0.95 * kCell) {
      EXPECT_TRUE(cells.IsNear(p)) << p.transpose();
    }
    if (off > 4.0 * kCell) {
      EXPECT_FALSE(cells.IsNear(p)) << p.transpose();
    }
  }
}

TEST(CellSetTest, LargeFacetsAreSampledBetweenTheirCorners) {
  CellSet cells(0.1);
  cells.Add({{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}});
  EXPECT_TRUE(cells.IsNear({0.66, 0.66, 0.05}));
}

TEST(ClustersTest, HangTogetherOverAGapAndNotOverTwo) {
  for (const double gap_between : {0.5, 2.5}) {
    const Shells pair = FindShells(
        mesh::Together(mesh::Cube(), mesh::Moved(mesh::Cube(), {1.0 + gap_between, 0.0, 0.0})));
    const std::vector<std::uint32_t> clusters = ClustersOf(pair, 1.0, {1, 1});
    EXPECT_EQ(clusters[0] == clusters[1], gap_between < 1.0) << gap_between;
  }
}

TEST(ClustersTest, WhatIsNotTakenJoinsNothing) {
  const Shells three = FindShells(
      mesh::Together(mesh::Together(mesh::Cube(), mesh::Moved(mesh::Cube(), {2.2, 0.0, 0.0})),
                     mesh::Moved(mesh::Cube(), {4.4, 0.0, 0.0})));
  EXPECT_EQ(ClustersOf(three, 1.2, {1, 1, 1}), (std::vector<std::uint32_t>{0, 0, 0}));
  EXPECT_EQ(ClustersOf(three, 1.2, {1, 0, 1}), (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace capfit::character
