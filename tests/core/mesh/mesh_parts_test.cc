// The steps of the preparation by themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/mesh/body_mesh.h"
#include "core/mesh/edge_mates.h"
#include "core/mesh/one_surface.h"
#include "core/mesh/triangulate_loop.h"
#include "core/mesh/weld_vertices.h"
#include "tests/core/mesh/boxes.h"

namespace capfit::mesh {
namespace {

using testing::ElementsAre;

TEST(EdgeMatesTest, PairsOppositeHalfEdges) {
  const std::vector<Triangle> tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const EdgeMates mates = FindEdgeMates(tetrahedron, 4);
  EXPECT_TRUE(mates.IsClosedAndOriented());
  for (HalfEdge h = 0; h < 12; ++h) {
    ASSERT_NE(mates.mate[h], kNoMate);
    EXPECT_EQ(mates.mate[mates.mate[h]], h);
    EXPECT_EQ(StartOf(tetrahedron, h), EndOf(tetrahedron, mates.mate[h]));
  }
}

TEST(EdgeMatesTest, CountsOpenMisdirectedAndCrowdedEdges) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 1, 3}, {4, 5, 6}, {5, 4, 7}, {4, 5, 8}};
  const EdgeMates mates = FindEdgeMates(triangles, 9);
  EXPECT_EQ(mates.open, 10u);
  EXPECT_EQ(mates.misdirected, 1u);
  EXPECT_THAT(mates.crowded_sizes, ElementsAre(3));
  EXPECT_THAT(mates.crowded, ElementsAre(6, 9, 12));
  EXPECT_EQ(mates.mate[0], 3u);
  EXPECT_EQ(mates.mate[6], kNoMate);
}

// By comparing each half-edge with all others.
EdgeMates MatesByBruteForce(std::span<const Triangle> triangles) {
  EdgeMates mates;
  const auto count = static_cast<HalfEdge>(3 * triangles.size());
  mates.mate.assign(count, kNoMate);
  const auto ends = [&](HalfEdge h) {
    return std::minmax({StartOf(triangles, h), EndOf(triangles, h)});
  };
  for (HalfEdge h = 0; h < count; ++h) {
    std::vector<HalfEdge> edge;
    for (HalfEdge other = 0; other < count; ++other) {
      if (ends(other) == ends(h)) edge.push_back(other);
    }
    if (edge.size() == 2) mates.mate[h] = edge[edge[0] == h ? 1 : 0];
    if (edge[0] != h) continue;
    if (edge.size() == 1) ++mates.open;
    if (edge.size() == 2 && StartOf(triangles, edge[0]) == StartOf(triangles, edge[1])) {
      ++mates.misdirected;
    }
    if (edge.size() > 2) mates.crowded_sizes.push_back(static_cast<std::uint32_t>(edge.size()));
  }
  return mates;
}

TEST(EdgeMatesTest, RandomTrianglesArePairedAsByBruteForceOnAnyThreads) {
  Random random(3);
  for (const std::uint32_t vertices : {7u, 60u, 5000u}) {
    const auto any = [&] { return static_cast<std::uint32_t>(random.NextUnit() * vertices); };
    std::vector<Triangle> triangles;
    while (triangles.size() < 500) {
      const std::uint32_t a = any();
      const Triangle t = {a, (a + 1 + any() % 5) % vertices, any()};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
    }
    const EdgeMates truth = MatesByBruteForce(triangles);
    for (const int threads : {1, 2, 3}) {
      const EdgeMates mates = FindEdgeMates(triangles, vertices, ThreadPool(threads));
      EXPECT_EQ(mates.mate, truth.mate);
      EXPECT_EQ(mates.open, truth.open);
      EXPECT_EQ(mates.misdirected, truth.misdirected);
      EXPECT_THAT(mates.crowded_sizes, testing::UnorderedElementsAreArray(truth.crowded_sizes));
    }
  }
}

TEST(OneSurfaceTest, PiecesTouchingVerticesAndUnusedOnesAreTold) {
  const auto is_one = [](const std::vector<Triangle>& triangles, std::size_t vertices) {
    const EdgeMates mates = FindEdgeMates(triangles, vertices);
    EXPECT_TRUE(mates.IsClosedAndOriented());
    return IsOneSurface(triangles, mates.mate, vertices, ThreadPool(2));
  };
  const auto tetrahedron = [](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    return std::vector<Triangle>{{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}};
  };
  const auto both = [&](std::vector<Triangle> first, const std::vector<Triangle>& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
  };
  EXPECT_TRUE(is_one(tetrahedron(0, 1, 2, 3), 4));
  EXPECT_TRUE(is_one(tetrahedron(3, 0, 2, 1), 4));
  EXPECT_FALSE(is_one(tetrahedron(0, 1, 2, 3), 5));
  EXPECT_FALSE(is_one(both(tetrahedron(0, 2, 4, 6), tetrahedron(1, 3, 5, 7)), 8));
  EXPECT_FALSE(is_one(both(tetrahedron(0, 1, 2, 3), tetrahedron(3, 4, 5, 6)), 7));

  // A ring with a handle, of as many triangles as twice its vertices; and with two tetrahedra that
  // touch it in a vertex each, which have the count of one surface without handles.
  std::vector<Triangle> torus;
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto at = [](std::uint32_t row, std::uint32_t column) {
        return 3 * (row % 3) + column % 3;
      };
      torus.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      torus.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  EXPECT_TRUE(is_one(torus, 9));
  EXPECT_FALSE(is_one(torus, 10));
  const std::vector<Triangle> one_more = both(torus, tetrahedron(0, 9, 10, 11));
  EXPECT_FALSE(is_one(one_more, 12));
  EXPECT_FALSE(is_one(both(one_more, tetrahedron(1, 12, 13, 14)), 15));
  // A barrel, and one whose ends are the same vertex.
  const auto barrel = [](std::uint32_t top) {
    std::vector<Triangle> triangles;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t low = 1 + k;
      const std::uint32_t next_low = 1 + (k + 1) % 3;
      triangles.push_back({0, next_low, low});
      triangles.push_back({low, next_low, low + 3});
      triangles.push_back({next_low, next_low + 3, low + 3});
      triangles.push_back({low + 3, next_low + 3, top});
    }
    return triangles;
  };
  EXPECT_TRUE(is_one(barrel(7), 8));
  EXPECT_FALSE(is_one(barrel(0), 7));
  EXPECT_FALSE(is_one(barrel(0), 8));
}

// A wheel has a vertex with so many edges that they are sorted the other way.
TEST(EdgeMatesTest, HandlesVerticesOfManyEdges) {
  std::vector<Triangle> wheel;
  constexpr std::uint32_t kSpokes = 1000;
  for (std::uint32_t k = 1; k <= kSpokes; ++k) wheel.push_back({0, k, k % kSpokes + 1});
  const EdgeMates mates = FindEdgeMates(wheel, kSpokes + 1);
  EXPECT_EQ(mates.open, kSpokes);
  EXPECT_EQ(mates.misdirected, 0u);
  for (std::uint32_t k = 0; k < kSpokes; ++k) {
    EXPECT_EQ(mates.mate[3 * k + 2], 3 * ((k + 1) % kSpokes));
  }
}

TEST(WeldTest, MergesEqualPositionsOfCandidatesOnly) {
  const std::vector<Eigen::Vector3d> positions = {{0, 0, 0}, {1, 2, 3}, {-0.0, 0, 0},
                                                  {1, 2, 3}, {0, 0, 0}, {1, 2, 3 + 1e-15}};
  EXPECT_THAT(WeldEqual(positions, std::vector<std::uint32_t>{0, 1, 2, 3, 5}),
              ElementsAre(0, 1, 0, 1, 4, 5));
}

TEST(WeldTest, JoinsTheNearestWithinTheToleranceWithoutChains) {
  std::vector<Eigen::Vector3d> line;
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < 6; ++i) {
    line.emplace_back(0.75 * i, 0, 0);
    all.push_back(i);
  }
  EXPECT_THAT(WeldWithin(line, all, 1.0), ElementsAre(0, 0, 2, 2, 4, 4));
  EXPECT_THAT(WeldWithin(line, all, 0.74), ElementsAre(0, 1, 2, 3, 4, 5));
}

// Against all pairs: every candidate joins the nearest earlier one that stands for itself.
TEST(WeldTest, AgreesWithTheSearchThroughAllPairs) {
  Random random(3);
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < 500; ++i) {
    positions.emplace_back(random.NextIn(-5, 5), random.NextIn(-5, 5), random.NextIn(-5, 5));
    all.push_back(i);
  }
  for (const double tolerance : {0.1, 0.5, 2.0}) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
      std::uint32_t nearest = i;
      double distance = tolerance;
      for (std::uint32_t k = 0; k < i; ++k) {
        const double d = (positions[i] - positions[k]).norm();
        if (expected[k] == k && d < distance) {
          nearest = k;
          distance = d;
        }
      }
      expected.push_back(nearest);
    }
    EXPECT_EQ(WeldWithin(positions, all, tolerance), expected) << tolerance;
  }
}

constexpr auto kAny = [](std::uint32_t, std::uint32_t) { return true; };

double AreaOf(const std::vector<Eigen::Vector3d>& loop, const std::vector<Triangle>& triangles) {
  double area = 0.0;
  for (const Triangle& t : triangles) {
    area += 0.5 * (loop[t[1]] - loop[t[0]]).cross(loop[t[2]] - loop[t[0]]).norm();
  }
  return area;
}

// The smallest area of all triangulations of the chain from i to k, by trying them all.
double LeastArea(const std::vector<Eigen::Vector3d>& loop, std::size_t i, std::size_t k) {
  if (k - i < 2) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t m = i + 1; m < k; ++m) {
    const double own = 0.5 * (loop[m] - loop[i]).cross(loop[k] - loop[i]).norm();
    least = std::min(least, own + LeastArea(loop, i, m) + LeastArea(loop, m, k));
  }
  return least;
}

TEST(TriangulateLoopTest, FindsNearlyTheLeastArea) {
  Random random(11);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Eigen::Vector3d> loop;
    for (int i = 0; i < 9; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 9;
      loop.emplace_back(std::cos(angle), std::sin(angle), random.NextIn(-0.5, 0.5));
    }
    const auto filling = FillBySmallestArea(loop, kAny);
    ASSERT_TRUE(filling.has_value());
    EXPECT_EQ(filling->size(), 7u);
    // The price of edges may cost up to 1e-3 of the squared lengths of six of them.
    EXPECT_LE(AreaOf(loop, *filling), LeastArea(loop, 0, 8) + 0.03);
  }
}

TEST(TriangulateLoopTest, KeepsInsideFlatOutlinesWithInwardCorners) {
  const std::vector<Eigen::Vector3d> arrow = {
      {0, 0, 0}, {2, 2, 0}, {0, 4, 0}, {0.2, 2.2, 0}, {0.2, 1.8, 0}};
  EXPECT_NEAR(AreaOf(arrow, *FillBySmallestArea(arrow, kAny)), 3.56, 1e-12);
  EXPECT_NEAR(AreaOf(arrow, *FillByCuttingEars(arrow, kAny)), 3.56, 1e-12);
}

TEST(TriangulateLoopTest, UsesNoForbiddenEdge) {
  std::vector<Eigen::Vector3d> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto not_from_0_to_2 = [](std::uint32_t i, std::uint32_t k) { return i + k != 2; };
  for (const auto& fill : {FillBySmallestArea, FillByCuttingEars}) {
    const auto filling = fill(square, not_from_0_to_2);
    ASSERT_TRUE(filling.has_value());
    for (const Triangle& t : *filling) EXPECT_TRUE(t[0] == 1 || t[1] == 1 || t[2] == 1);
    const auto none = [](std::uint32_t, std::uint32_t) { return false; };
    EXPECT_FALSE(fill(square, none).has_value());
  }
}

}  // namespace
}  // namespace capfit::mesh
