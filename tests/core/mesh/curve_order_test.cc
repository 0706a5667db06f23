#include "core/mesh/curve_order.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/body_mesh.h"
#include "tests/core/mesh/soups.h"

namespace capfit::mesh {
namespace {

// Listed otherwise: vertices and triangles dealt anew, each triangle from another corner.
formats::PolygonSoup ListedAnew(const formats::PolygonSoup& soup) {
  Random random(11);
  const auto deal = [&](std::size_t count) {
    std::vector<std::uint32_t> order(count);
    for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
    for (std::size_t i = count; i > 1; --i) {
      std::swap(order[i - 1], order[random.NextBelow(i)]);
    }
    return order;
  };
  const std::vector<std::uint32_t> vertex = deal(soup.positions.size());
  formats::PolygonSoup anew;
  anew.positions.resize(soup.positions.size());
  for (std::size_t v = 0; v < vertex.size(); ++v) anew.positions[vertex[v]] = soup.positions[v];
  const std::vector<Triangle> triangles = TrianglesOf(soup);
  for (const std::uint32_t t : deal(triangles.size())) {
    for (const std::size_t k : {1u, 2u, 0u}) {
      anew.face_vertices.push_back(vertex[triangles[t][k]]);
    }
  }
  return anew;
}

BodyMesh MeshOf(const formats::PolygonSoup& soup) {
  return BodyMesh(soup.positions, TrianglesOf(soup), {});
}

formats::PolygonSoup Mannequin() {
  mannequin::MannequinOptions options;
  options.faces = 20'000;
  options.quads = false;
  return *mannequin::MakeMannequin(options);
}

TEST(CurveOrderTest, ListsTrianglesByTheirLowestCorners) {
  const formats::PolygonSoup ball = Ball(40, 30);
  const CurveOrder order =
      OrderAlongCurve(ball.positions, TrianglesOf(ball), ThreadPool(2), NullObserver());
  ASSERT_EQ(order.source.size(), ball.positions.size());
  for (std::uint32_t v = 0; v < order.source.size(); ++v) EXPECT_EQ(order.rank[order.source[v]], v);
  ASSERT_TRUE(std::is_sorted(order.triangles.begin(), order.triangles.end()));
  ASSERT_EQ(order.first_triangle.size(), ball.positions.size() + 1);
  EXPECT_EQ(order.first_triangle.back(), order.triangles.size());
  for (std::uint32_t v = 0; v < order.source.size(); ++v) {
    for (std::uint32_t i = order.first_triangle[v]; i < order.first_triangle[v + 1]; ++i) {
      EXPECT_EQ(order.triangles[i][0], v);
      EXPECT_LT(v, std::min(order.triangles[i][1], order.triangles[i][2]));
    }
  }
}

TEST(CurveOrderTest, KeepsTheTrianglesAndTheirWayRound) {
  const formats::PolygonSoup ball = Ball(25, 20);
  const CurveOrder order =
      OrderAlongCurve(ball.positions, TrianglesOf(ball), ThreadPool(1), NullObserver());
  std::vector<Triangle> came = TrianglesOf(ball);
  for (Triangle& t : came) {
    for (std::uint32_t& v : t) v = order.rank[v];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::sort(came.begin(), came.end());
  EXPECT_TRUE(std::ranges::equal(order.triangles, came));
}

// What every later room gets is the same bit by bit, however the body came.
TEST(CurveOrderTest, CopiesComeOutTheSame) {
  const ThreadPool pool(2);
  const BodyMesh mesh = MeshOf(Mannequin()).InCurveOrder(pool, NullObserver());
  const auto points = SnappedPoints(mesh.vertices(), *mesh.frame(), pool);
  geometry::Similarity turn;
  turn.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  turn.scale = 39.37;
  turn.translation = {3.0, -1.0, 0.5};
  for (const BodyMesh& copy :
       {MeshOf(ListedAnew(Mannequin())), MeshOf(Mannequin()).Transformed(turn)}) {
    const BodyMesh again = copy.InCurveOrder(pool, NullObserver());
    EXPECT_EQ(points, SnappedPoints(again.vertices(), *again.frame(), pool));
    EXPECT_TRUE(std::ranges::equal(mesh.triangles(), again.triangles()));
    EXPECT_TRUE(std::ranges::equal(mesh.mates(), again.mates()));
  }
}

TEST(CurveOrderTest, MatesAreThoseOfAnyOrder) {
  for (const bool is_open : {false, true}) {
    std::vector<Triangle> triangles = TrianglesOf(Ball(60, 50));
    if (is_open) triangles.resize(triangles.size() - 7);
    triangles.push_back(triangles.front());  // three and four triangles at its edges
    triangles.push_back(triangles.front());
    const std::vector<Eigen::Vector3d> points = Ball(60, 50).positions;
    const CurveOrder order = OrderAlongCurve(points, triangles, ThreadPool(1), NullObserver());
    const EdgeMates any = FindEdgeMates(order.triangles, points.size());
    for (const int threads : {1, 3}) {
      const EdgeMates sorted = FindEdgeMates(order.triangles, points.size(), ThreadPool(threads),
                                             NullObserver(), order.first_triangle);
      EXPECT_EQ(sorted.mate, any.mate);
      EXPECT_EQ(sorted.crowded, any.crowded);
      EXPECT_EQ(sorted.open, any.open);
      EXPECT_EQ(sorted.misdirected, any.misdirected);
      EXPECT_EQ(sorted.open > 0, is_open);
    }
  }
}

TEST(CurveOrderTest, AMeshInOrderStaysAsItIs) {
  const BodyMesh mesh = MeshOf(Mannequin()).InCurveOrder(ThreadPool(1), NullObserver());
  const BodyMesh again = mesh.InCurveOrder(ThreadPool(1), NullObserver());
  EXPECT_EQ(mesh.vertices().data(), again.vertices().data()) << "copies share their arrays";
  const BodyMesh moved =
      mesh.Transformed({}, {mesh.vertices().begin(), mesh.vertices().end()}, ThreadPool(1));
  EXPECT_EQ(mesh.triangles().data(), moved.triangles().data());
  EXPECT_FALSE(moved.frame().has_value()) << "its vertices may be anywhere";
  EXPECT_NEAR(mesh.volume(), moved.volume(), 1e-12 * mesh.volume());
}

}  // namespace
}  // namespace capfit::mesh
