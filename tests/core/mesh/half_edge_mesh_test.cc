#include "core/mesh/half_edge_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>
#include <vector>

#include "core/mesh/triangulate_loop.h"
#include "tests/core/mesh/soups.h"

namespace capfit::mesh {
namespace {

using testing::ElementsAre;

std::vector<std::uint32_t> VerticesOf(const HalfEdgeMesh& mesh, const Rim& rim) {
  std::vector<std::uint32_t> vertices;
  for (const OpenMesh::HalfedgeHandle h : rim) {
    vertices.push_back(static_cast<std::uint32_t>(mesh.from_vertex_handle(h).idx()));
  }
  return vertices;
}

TEST(HalfEdgeMeshTest, GivesBackTheSurfaceItWasMadeOf) {
  const formats::PolygonSoup ball = Ball(24, 15);
  for (const double chance : {0.0, 0.1, 0.6}) {
    const Surface surface = WithHoles(ball, chance, 5);
    const Surface back = HalfEdgeMesh(ball.positions.size(), surface).ToSurface();
    EXPECT_EQ(back.triangles, surface.triangles);
    EXPECT_EQ(back.mate, surface.mate);
  }
}

// Edges are what the mates say, where four triangles share the two vertices of one too.
TEST(HalfEdgeMeshTest, KeepsApartWhatMeetsAtACrowdedEdge) {
  std::vector<Triangle> triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}};
  Surface surface{triangles, RawVector<HalfEdge>(12, kNoMate)};
  surface.mate[0] = 3, surface.mate[3] = 0;
  surface.mate[6] = 9, surface.mate[9] = 6;
  HalfEdgeMesh mesh(6, surface);
  EXPECT_EQ(mesh.ToSurface().mate, surface.mate);
  const std::vector<Rim> rims = mesh.FindRims();
  ASSERT_EQ(rims.size(), 2U);
  EXPECT_THAT(VerticesOf(mesh, rims[0]), ElementsAre(0, 2, 1, 3));
  EXPECT_THAT(VerticesOf(mesh, rims[1]), ElementsAre(0, 4, 1, 5));
}

// Six triangles round vertex 0, every other one missing: three holes that touch there.
TEST(HalfEdgeMeshTest, RimsThatTouchInAVertexAreSeveral) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}, {2, 7, 3}, {4, 7, 5},
                                           {6, 7, 1}, {1, 7, 2}, {3, 7, 4}, {5, 7, 6}};
  HalfEdgeMesh mesh(8, SurfaceOf(triangles, 8));
  const std::vector<Rim> rims = mesh.FindRims();
  ASSERT_EQ(rims.size(), 3U);
  std::set<std::vector<std::uint32_t>> found;
  for (const Rim& rim : rims) {
    std::vector<std::uint32_t> vertices = VerticesOf(mesh, rim);
    EXPECT_EQ(vertices.size(), 3U);
    std::rotate(vertices.begin(), std::find(vertices.begin(), vertices.end(), 0U), vertices.end());
    found.insert(vertices);
    for (std::size_t i = 0; i < rim.size(); ++i) {
      EXPECT_EQ(mesh.next_halfedge_handle(rim[i]), rim[(i + 1) % rim.size()]);
    }
  }
  EXPECT_EQ(found, (std::set<std::vector<std::uint32_t>>{{0, 2, 3}, {0, 4, 5}, {0, 6, 1}}));
}

TEST(HalfEdgeMeshTest, FilledRimsMakeAClosedSurfaceWithTheFillingsBehind) {
  const formats::PolygonSoup ball = Ball(24, 15);
  const std::vector<Eigen::Vector3d>& positions = ball.positions;
  const Surface open = WithHoles(ball, 0.02, 9);
  HalfEdgeMesh mesh(positions.size(), open);
  std::vector<Triangle> expected = open.triangles;
  for (const Rim& rim : mesh.FindRims()) {
    const std::vector<std::uint32_t> corners = VerticesOf(mesh, rim);
    std::vector<Eigen::Vector3d> points;
    for (const std::uint32_t v : corners) points.push_back(positions[v]);
    const auto filling = FillBySmallestArea(points, [](auto, auto) { return true; });
    ASSERT_TRUE(filling.has_value());
    for (const Triangle& t : *filling) {
      expected.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
    }
    mesh.FillRim(rim, *filling);
  }
  const Surface closed = mesh.ToSurface();
  ASSERT_GT(closed.triangles.size(), open.triangles.size());
  EXPECT_EQ(closed.triangles, expected);
  const EdgeMates mates = FindEdgeMates(closed.triangles, positions.size());
  EXPECT_TRUE(mates.IsClosedAndOriented());
  EXPECT_EQ(mates.mate, closed.mate);
}

TEST(HalfEdgeMeshTest, TurnsAnEdgeAndBack) {
  const formats::PolygonSoup ball = Ball(12, 7);
  const Surface surface = WithHoles(ball, 0.0, 1);
  HalfEdgeMesh mesh(ball.positions.size(), surface);
  const OpenMesh::HalfedgeHandle h = mesh.halfedge_handle(OpenMesh::FaceHandle(40));
  const OpenMesh::VertexHandle apex = mesh.opposite_vh(h);
  const OpenMesh::VertexHandle beyond = mesh.opposite_he_opposite_vh(h);
  const OpenMesh::VertexHandle from = mesh.from_vertex_handle(h);
  const auto edges_before = mesh.valence(apex) + mesh.valence(beyond);
  mesh.TurnEdge(h);
  EXPECT_EQ(mesh.to_vertex_handle(h), apex);
  EXPECT_EQ(mesh.from_vertex_handle(h), beyond);
  const Surface turned = mesh.ToSurface();
  const EdgeMates mates = FindEdgeMates(turned.triangles, ball.positions.size());
  EXPECT_TRUE(mates.IsClosedAndOriented());
  EXPECT_EQ(mates.mate, turned.mate);
  EXPECT_EQ(mesh.valence(apex) + mesh.valence(beyond), edges_before + 2);
  for (const OpenMesh::VertexHandle v : mesh.vertices()) {
    EXPECT_EQ(mesh.from_vertex_handle(mesh.halfedge_handle(v)), v);
  }
  for (int again = 0; again < 3; ++again) mesh.TurnEdge(h);
  EXPECT_EQ(mesh.from_vertex_handle(h), from);
  const EdgeMates back = FindEdgeMates(mesh.ToSurface().triangles, ball.positions.size());
  EXPECT_TRUE(back.IsClosedAndOriented());
  EXPECT_EQ(mesh.ToSurface().triangles[40], surface.triangles[40]);
}

// The two triangles of a pillow, open along one of its three edges.
TEST(HalfEdgeMeshTest, ZipsASlit) {
  Surface surface{{{0, 1, 2}, {2, 1, 0}}, {kNoMate, 3, 5, 1, kNoMate, 2}};
  HalfEdgeMesh mesh(3, surface);
  const std::vector<Rim> rims = mesh.FindRims();
  ASSERT_EQ(rims.size(), 1U);
  ASSERT_EQ(rims[0].size(), 2U);
  mesh.ZipRim(rims[0]);
  surface.mate[0] = 4;
  surface.mate[4] = 0;
  EXPECT_EQ(mesh.ToSurface().triangles, surface.triangles);
  EXPECT_EQ(mesh.ToSurface().mate, surface.mate);
}

}  // namespace
}  // namespace capfit::mesh
