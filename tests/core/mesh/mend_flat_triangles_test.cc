#include "core/mesh/mend_flat_triangles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/core/mesh/soups.h"

namespace capfit::mesh {
namespace {

using testing::ElementsAre;
using testing::Pair;

void ExpectSound(const Surface& surface, std::size_t vertices) {
  const EdgeMates mates = FindEdgeMates(surface.triangles, vertices);
  EXPECT_TRUE(mates.IsClosedAndOriented());
  EXPECT_EQ(mates.mate, surface.mate);
}

// A tetrahedron whose vertex 4 lies on the edge from 0 to 1, for one of the two triangles there.
TEST(MendFlatTrianglesTest, TurnsTheLongestEdgeOfATriangleWhoseCornersLieOnALine) {
  const std::vector<Eigen::Vector3d> positions = {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}};
  Surface surface =
      SurfaceOf({{0, 2, 1}, {0, 1, 4}, {0, 4, 3}, {4, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 5);
  const MendedTriangles mended = MendFlatTriangles(positions, 1e-9, surface);
  EXPECT_EQ(mended.flipped, 1U);
  EXPECT_TRUE(mended.merged.empty());
  EXPECT_EQ(surface.triangles.size(), 6U);
  ExpectSound(surface, 5);
  for (const Triangle& t : surface.triangles) EXPECT_FALSE(IsFlat(positions, t, 1e-9));
}

// An octahedron with vertex 6 in the place of vertex 0, and two flat triangles between the two.
TEST(MendFlatTrianglesTest, MergesTheHigherOfTwoVerticesInOnePlace) {
  const std::vector<Eigen::Vector3d> positions = {{0, 0, 1},  {1, 0, 0},  {0, 1, 0}, {-1, 0, 0},
                                                  {0, -1, 0}, {0, 0, -1}, {0, 0, 1}};
  Surface surface = SurfaceOf({{0, 1, 2},
                               {6, 2, 3},
                               {6, 3, 4},
                               {0, 4, 1},
                               {0, 2, 6},
                               {0, 6, 4},
                               {5, 2, 1},
                               {5, 3, 2},
                               {5, 4, 3},
                               {5, 1, 4}},
                              7);
  const MendedTriangles mended = MendFlatTriangles(positions, 1e-9, surface);
  EXPECT_EQ(mended.flipped, 0U);
  EXPECT_THAT(mended.merged, ElementsAre(Pair(6U, 0U)));
  EXPECT_THAT(
      surface.triangles,
      ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}, Triangle{0, 4, 1},
                  Triangle{5, 2, 1}, Triangle{5, 3, 2}, Triangle{5, 4, 3}, Triangle{5, 1, 4}));
  ExpectSound(surface, 7);
}

TEST(MendFlatTrianglesTest, LeavesWhatWouldFoldOntoItself) {
  const std::vector<Eigen::Vector3d> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  const Surface tetrahedron = SurfaceOf({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 4);
  Surface surface = tetrahedron;
  const MendedTriangles mended = MendFlatTriangles(positions, 1e-9, surface);
  EXPECT_TRUE(mended.merged.empty());
  EXPECT_EQ(mended.flipped, 0U);
  EXPECT_EQ(surface.triangles, tetrahedron.triangles);
  EXPECT_EQ(surface.mate, tetrahedron.mate);
}

// The ends of an edge that is there twice, with the same two triangles at each, lie in one place.
// Merged they would leave triangles with two equal corners.
TEST(MendFlatTrianglesTest, LeavesVerticesThatTwoEdgesJoin) {
  const std::vector<Eigen::Vector3d> positions = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  // Two pillows of two triangles, sewn together along 0-1 as a ring of four.
  Surface surface{{{0, 1, 2}, {1, 0, 3}, {0, 1, 3}, {1, 0, 2}},
                  {3, 11, 10, 0, 8, 7, 9, 5, 4, 6, 2, 1}};
  for (HalfEdge h = 0; h < surface.mate.size(); ++h) {
    ASSERT_EQ(surface.mate[surface.mate[h]], h);
    ASSERT_EQ(StartOf(surface.triangles, surface.mate[h]), EndOf(surface.triangles, h));
  }
  const MendedTriangles mended = MendFlatTriangles(positions, 1e-9, surface);
  EXPECT_TRUE(mended.merged.empty());
  EXPECT_EQ(surface.triangles.size(), 4U);
}

TEST(MendFlatTrianglesTest, LeavesASoundSurfaceAsItIs) {
  const std::vector<Eigen::Vector3d> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Surface tetrahedron = SurfaceOf({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 4);
  Surface surface = tetrahedron;
  EXPECT_TRUE(MendFlatTriangles(positions, 1e-9, surface).merged.empty());
  EXPECT_EQ(surface.triangles, tetrahedron.triangles);
}

}  // namespace
}  // namespace capfit::mesh
