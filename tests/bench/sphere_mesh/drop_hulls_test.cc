#include "tests/bench/sphere_mesh/drop_hulls.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace capfit::bench {
namespace {

using Eigen::Vector3d;

// Points on the surface of capsules of radius 0.05 along the polyline through `corners`, away from
// its corners.
std::vector<Vector3d> AlongPath(const std::vector<Vector3d>& corners) {
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vector3d along = (corners[i + 1] - corners[i]).normalized();
    const Vector3d across = along.unitOrthogonal();
    for (int k = 2; k <= 18; ++k) {
      const Vector3d foot = corners[i] + k / 20.0 * (corners[i + 1] - corners[i]);
      for (const Vector3d& side : {across, Vector3d(along.cross(across))}) {
        points.emplace_back(foot + 0.05 * side);
        points.emplace_back(foot - 0.05 * side);
      }
    }
  }
  return points;
}

// A horseshoe of three capsules, with an edge across its mouth and a triangle in its bend.
struct Horseshoe {
  std::vector<Vector3d> corners = {{0, 0, 0}, {0.5, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0}};
  SphereMesh mesh{{}, {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {0, 2}}, {{0, 1, 2}}};
  Horseshoe() {
    for (const Vector3d& corner : corners) mesh.spheres.push_back({corner, 0.05});
  }
};

TEST(DropHulls, DropsWhatTheSurfaceDoesNotKnow) {
  const Horseshoe shoe;
  ASSERT_EQ(PrimitiveCount(shoe.mesh), 11);
  const SphereMesh left = DropHulls(shoe.mesh, 7, AlongPath(shoe.corners));
  EXPECT_EQ(left.spheres.size(), 4U);
  EXPECT_TRUE(left.triangles.empty());
  EXPECT_EQ(left.edges, (std::vector<std::array<int, 2>>{{0, 1}, {1, 2}, {2, 3}}));
}

TEST(DropHulls, NothingIsDroppedWithinTheBudget) {
  const Horseshoe shoe;
  const SphereMesh left = DropHulls(shoe.mesh, 11, AlongPath(shoe.corners));
  EXPECT_EQ(left.edges, shoe.mesh.edges);
  EXPECT_EQ(left.triangles, shoe.mesh.triangles);
}

// Whatever the points say and however small the budget: a side stays as long as its triangle does,
// and all stay joined.
TEST(DropHulls, StaysASoundConnectedComplex) {
  const Horseshoe shoe;
  const std::vector<Vector3d> mouth = AlongPath({{0, 0.5, 0}, {0, 0, 0}, {0.5, 0.5, 0}});
  for (int budget = 11; budget >= 0; --budget) {
    const SphereMesh left = DropHulls(shoe.mesh, budget, mouth);
    EXPECT_LE(PrimitiveCount(left), std::max(budget, 7));
    const std::set<std::array<int, 2>> edges(left.edges.begin(), left.edges.end());
    if (!left.triangles.empty()) {
      EXPECT_TRUE(edges.contains({0, 1}) && edges.contains({1, 2}) && edges.contains({0, 2}));
    }
    std::set<int> joined = {0};
    for (int pass = 0; pass < 4; ++pass) {
      for (const auto& [a, b] : edges) {
        if (joined.contains(a) || joined.contains(b)) joined.insert({a, b});
      }
    }
    EXPECT_EQ(joined.size(), 4U) << budget;
  }
}

}  // namespace
}  // namespace capfit::bench
