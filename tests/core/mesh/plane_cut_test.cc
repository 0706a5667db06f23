#include "core/mesh/plane_cut.h"

#include <gtest/gtest.h>

#include <set>

namespace capfit::mesh {
namespace {

// A tetrahedron, normals outward.
const std::vector<Eigen::Vector3d> kPoints = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<Triangle> kTriangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::vector<CutPiece> CutAtHeight(double z, const std::vector<Triangle>& triangles) {
  std::vector<CutPiece> pieces;
  for (const Triangle& t : triangles) {
    CutTriangle(kPoints, t, {kPoints[t[0]].z() - z, kPoints[t[1]].z() - z, kPoints[t[2]].z() - z},
                pieces);
  }
  return pieces;
}

TEST(PlaneCutTest, OneClosedLoopAroundTheInside) {
  const std::vector<CutPiece> pieces = CutAtHeight(0.25, kTriangles);
  ASSERT_EQ(pieces.size(), 3U);
  const std::vector<CutLoop> loops = LinkPieces(pieces);
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_TRUE(loops[0].is_closed);
  double area = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d& a = pieces[loops[0].pieces[i]].start;
    const Eigen::Vector3d& b = pieces[loops[0].pieces[(i + 1) % 3]].start;
    EXPECT_NEAR(a.z(), 0.25, 1e-15);
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  EXPECT_NEAR(area, 0.5 * 0.75 * 0.75, 1e-15) << "counter-clockwise from above";
  std::set<std::uint32_t> nearest;
  for (const CutPiece& piece : pieces) nearest.insert(piece.nearest_vertex);
  EXPECT_EQ(nearest, (std::set<std::uint32_t>{0, 1, 2}));
}

TEST(PlaneCutTest, VerticesOnThePlaneCountAsAbove) {
  EXPECT_TRUE(CutAtHeight(0.0, kTriangles).empty());
  EXPECT_EQ(LinkPieces(CutAtHeight(1.0, kTriangles)).size(), 1U) << "the tip, as a point";
  EXPECT_TRUE(CutAtHeight(1.5, kTriangles).empty());
}

TEST(PlaneCutTest, OpenWhereTrianglesEnd) {
  std::vector<Triangle> open = kTriangles;
  open.pop_back();
  const std::vector<CutLoop> loops = LinkPieces(CutAtHeight(0.5, open));
  ASSERT_FALSE(loops.empty());
  for (const CutLoop& loop : loops) EXPECT_FALSE(loop.is_closed);
}

// Two tetrahedra that share an edge: four triangles at it.
TEST(PlaneCutTest, LoopsCloseWhereAnEdgeHasMoreThanTwoTriangles) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {0, 0, 1},  {1, 0, 0},
                                               {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  std::vector<CutPiece> pieces;
  for (const Triangle& t : std::vector<Triangle>{{0, 3, 2},
                                                 {0, 2, 1},
                                                 {0, 1, 3},
                                                 {1, 2, 3},
                                                 {0, 5, 4},
                                                 {0, 4, 1},
                                                 {0, 1, 5},
                                                 {1, 4, 5}}) {
    CutTriangle(points, t, {points[t[0]].z() - 0.5, points[t[1]].z() - 0.5, points[t[2]].z() - 0.5},
                pieces);
  }
  std::size_t linked = 0;
  for (const CutLoop& loop : LinkPieces(pieces)) {
    EXPECT_TRUE(loop.is_closed);
    linked += loop.pieces.size();
  }
  EXPECT_EQ(linked, pieces.size());
}

}  // namespace
}  // namespace capfit::mesh
