#include "core/character/shells.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/mesh/soups.h"

namespace capfit::character {
namespace {

using mesh::Ball;
using mesh::Cube;
using mesh::Moved;
using mesh::Together;

TEST(ShellsTest, PiecesThatShareNoVertexAreShells) {
  const Shells found = FindShells(Together(Cube(), Moved(Ball(16, 8), {5.0, 0.0, 0.0})));
  ASSERT_EQ(found.shells.size(), 2U);
  EXPECT_EQ(found.shells[0].face_count, 6U);
  EXPECT_NEAR(found.shells[0].area, 6.0, 1e-12);
  EXPECT_EQ(found.shells[0].box_max, Eigen::Vector3d(1.0, 1.0, 1.0));
  EXPECT_EQ(found.shells[1].face_count, found.shell_of_face.size() - 6);
  EXPECT_EQ(found.first_facet[1], 12U);  // quads are fans of two
  EXPECT_EQ(found.shells[0].surface, 0U);
  EXPECT_EQ(found.shells[1].surface, 1U);
}

TEST(ShellsTest, SplitVerticesAtTheSamePlaceCountAsOne) {
  const formats::PolygonSoup whole = Ball(16, 8);
  EXPECT_EQ(FindShells(mesh::SplitApart(whole)).shells.size(), 1U);
}

TEST(ShellsTest, APartEndsAShellButNotTheSurface) {
  formats::PolygonSoup cube = Cube();
  cube.parts = {{"lower", "", 0, 3, -1}, {"upper", "", 3, 3, -1}};
  const Shells found = FindShells(cube);
  ASSERT_EQ(found.shells.size(), 2U);
  EXPECT_EQ(found.shells[1].part, 1U);
  EXPECT_EQ(found.shells[0].surface, found.shells[1].surface);
}

TEST(ShellsTest, WhatIsCutOffHangsTogetherWithNothingElse) {
  const formats::PolygonSoup cube = Cube();
  std::vector<char> is_cut_off(6, 0);
  is_cut_off[2] = 1;
  const Shells found = FindShells(cube, is_cut_off);
  ASSERT_EQ(found.shells.size(), 2U);
  EXPECT_FALSE(found.shells[0].is_cut_off);
  EXPECT_EQ(found.shells[0].face_count, 5U);
  EXPECT_TRUE(found.shells[1].is_cut_off);
  EXPECT_EQ(found.shell_of_face[2], 1U);
}

TEST(ShellsTest, PartsWithoutFacesAreFine) {
  formats::PolygonSoup cube = Cube();
  cube.parts = {{"empty", "", 0, 0, -1}, {"all", "", 0, 6, -1}, {"none", "", 6, 0, -1}};
  const Shells found = FindShells(cube);
  ASSERT_EQ(found.shells.size(), 1U);
  EXPECT_EQ(found.shells[0].part, 1U);
}

}  // namespace
}  // namespace capfit::character
