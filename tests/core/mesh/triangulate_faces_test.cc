#include "core/mesh/triangulate_faces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/mesh/edge_mates.h"
#include "tests/core/mesh/soups.h"

namespace capfit::mesh {
namespace {

Eigen::Vector3d NormalOf(const formats::PolygonSoup& soup, const Triangle& t) {
  const Eigen::Vector3d& a = soup.positions[t[0]];
  return (soup.positions[t[1]] - a).cross(soup.positions[t[2]] - a);
}

// Whether it faces into the ball: no triangle of one does, and one of each two that fold over.
bool IsInward(const formats::PolygonSoup& soup, const Triangle& t) {
  return NormalOf(soup, t).dot(soup.positions[t[0]]) <= 0.0;
}

// A ball of uneven triangles, as scans and decimated meshes have them: edges turned at random.
formats::PolygonSoup UnevenBall(std::uint64_t seed) {
  formats::PolygonSoup ball = Ball(40, 40);
  std::vector<Triangle> triangles = TrianglesOf(ball);
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
  }
  Random random(seed);
  for (int round = 0; round < 8; ++round) {
    const EdgeMates mates = FindEdgeMates(triangles, ball.positions.size());
    std::vector<bool> is_done(triangles.size(), false);
    for (HalfEdge t = 0; t < triangles.size(); ++t) {
      const HalfEdge h = 3 * t + static_cast<HalfEdge>(random.NextBelow(3));
      const HalfEdge mate = mates.mate[h];
      if (mate == kNoMate || is_done[t] || is_done[mate / 3]) continue;
      const std::uint32_t c = StartOf(triangles, PreviousInTriangle(h));
      const std::uint32_t d = StartOf(triangles, PreviousInTriangle(mate));
      const Triangle first = {StartOf(triangles, h), d, c};
      const Triangle second = {d, EndOf(triangles, h), c};
      if (IsInward(ball, first) || IsInward(ball, second)) continue;
      if (!edges.insert(std::minmax(c, d)).second) continue;
      edges.erase(std::minmax(StartOf(triangles, h), EndOf(triangles, h)));
      is_done[t] = is_done[mate / 3] = true;
      triangles[t] = first;
      triangles[mate / 3] = second;
    }
  }
  ball.face_vertices.clear();
  for (const Triangle& t : triangles) {
    ball.face_vertices.insert(ball.face_vertices.end(), t.begin(), t.end());
  }
  return ball;
}

// Neighbours become quads at random, each beginning anywhere.
formats::PolygonSoup Joined(const formats::PolygonSoup& soup, std::uint64_t seed) {
  const std::vector<Triangle> triangles = TrianglesOf(soup);
  const EdgeMates mates = FindEdgeMates(triangles, soup.positions.size());
  Random random(seed);
  formats::PolygonSoup joined;
  joined.positions = soup.positions;
  std::vector<bool> is_used(triangles.size(), false);
  for (HalfEdge t = 0; t < triangles.size(); ++t) {
    if (is_used[t]) continue;
    is_used[t] = true;
    const HalfEdge h = 3 * t + static_cast<HalfEdge>(random.NextBelow(3));
    const HalfEdge mate = mates.mate[h];
    if (mate == kNoMate || is_used[mate / 3]) {
      joined.face_sizes.push_back(3);
      joined.face_vertices.insert(joined.face_vertices.end(), triangles[t].begin(),
                                  triangles[t].end());
      continue;
    }
    is_used[mate / 3] = true;
    const std::array<std::uint32_t, 4> quad = {
        StartOf(triangles, h), StartOf(triangles, PreviousInTriangle(mate)), EndOf(triangles, h),
        StartOf(triangles, PreviousInTriangle(h))};
    const std::size_t first = random.NextBelow(4);
    joined.face_sizes.push_back(4);
    for (std::size_t k = 0; k < 4; ++k) joined.face_vertices.push_back(quad[(first + k) % 4]);
  }
  return joined;
}

std::size_t Inward(const formats::PolygonSoup& soup, const std::vector<Triangle>& triangles) {
  return static_cast<std::size_t>(std::count_if(
      triangles.begin(), triangles.end(), [&](const Triangle& t) { return IsInward(soup, t); }));
}

// What a fan from the first corner folds over.
double FoldedShare(const formats::PolygonSoup& soup) {
  std::vector<Triangle> fans;
  std::size_t at = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    for (std::size_t k = 2; k < size; ++k) {
      fans.push_back(
          {soup.face_vertices[at], soup.face_vertices[at + k - 1], soup.face_vertices[at + k]});
    }
    at += size;
  }
  return static_cast<double>(Inward(soup, fans)) / static_cast<double>(soup.face_sizes.size());
}

// Joining uneven triangles without looking makes far more quads with inward corners than modelling
// does: they are cut where they were joined.
TEST(TriangulateFacesTest, QuadsJoinedFromTrianglesDoNotFold) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const formats::PolygonSoup ball = UnevenBall(seed);
    ASSERT_EQ(Inward(ball, TrianglesOf(ball)), 0u);
    const formats::PolygonSoup joined = Joined(ball, seed);
    const double folded = FoldedShare(joined);
    EXPECT_GT(folded, 0.03);
    const TriangulatedFaces faces = TriangulateFaces(joined, joined.positions);
    EXPECT_EQ(faces.triangles.size(), TrianglesOf(ball).size());
    // (Slivers that bend round the ball fold over either way.)
    EXPECT_LT(static_cast<double>(Inward(joined, faces.triangles)),
              0.5 * folded * static_cast<double>(joined.face_sizes.size()));
  }
}

// The flat end of a cut: a star of many corners, half of them inward.
TEST(TriangulateFacesTest, FacesOfManyCornersAreFilledWithoutFolds) {
  for (const std::size_t corners : {std::size_t{100}, std::size_t{400}, std::size_t{1000}}) {
    formats::PolygonSoup star;
    double twice_area = 0.0;
    for (std::size_t k = 0; k < corners; ++k) {
      const double angle =
          2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
      const double radius = k % 2 == 0 ? 1.0 : 0.97;
      star.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
      star.face_vertices.push_back(static_cast<std::uint32_t>(k));
      twice_area += 0.97 * std::sin(2.0 * std::numbers::pi / static_cast<double>(corners));
    }
    star.face_sizes = {static_cast<std::uint32_t>(corners)};
    const TriangulatedFaces faces = TriangulateFaces(star, star.positions);
    EXPECT_EQ(faces.triangles.size(), corners - 2);
    double twice_filled = 0.0;
    for (const Triangle& t : faces.triangles) {
      const Eigen::Vector3d normal = NormalOf(star, t);
      EXPECT_GT(normal.z(), -1e-12);
      twice_filled += normal.norm();
    }
    EXPECT_NEAR(twice_filled, twice_area, 1e-9) << corners;
  }
}

// A model of quads with a crumpled one here and there is cut as other programs cut it.
TEST(TriangulateFacesTest, ModelledQuadsKeepTheDiagonalFromTheirFirstCorner) {
  formats::PolygonSoup sheet;
  const std::uint32_t side = 30;
  for (std::uint32_t i = 0; i <= side; ++i) {
    for (std::uint32_t k = 0; k <= side; ++k) sheet.positions.emplace_back(i, k, 0.0);
  }
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t k = 0; k < side; ++k) {
      const std::uint32_t a = i * (side + 1) + k;
      for (const std::uint32_t v : {a, a + side + 1, a + side + 2, a + 1}) {
        sheet.face_vertices.push_back(v);
      }
      sheet.face_sizes.push_back(4);
    }
  }
  sheet.positions[sheet.face_vertices[4 * 400 + 1]] += Eigen::Vector3d(-0.8, 0.8, 0.0);
  const TriangulatedFaces faces = TriangulateFaces(sheet, sheet.positions);
  ASSERT_EQ(faces.triangles.size(), 2 * sheet.face_sizes.size());
  for (std::size_t f = 0; f < sheet.face_sizes.size(); ++f) {
    EXPECT_EQ(faces.triangles[2 * f][0], sheet.face_vertices[4 * f]);
    EXPECT_EQ(faces.triangles[2 * f + 1][0], sheet.face_vertices[4 * f]);
  }
}

}  // namespace
}  // namespace capfit::mesh
