#include "core/mesh/surface_sums.h"

#include <gtest/gtest.h>

#include <numeric>

namespace capfit::mesh {
namespace {

const std::vector<Eigen::Vector3d> kCorners = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {0, 0, 12}};
const std::vector<Triangle> kFaces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

TEST(SurfaceSumsTest, OfATetrahedron) {
  Eigen::Vector3d vectors = Eigen::Vector3d::Zero();
  double by_middles = 0.0, by_corners = 0.0;
  for (const Triangle& t : kFaces) {
    const Eigen::Vector3d area = AreaVector(kCorners, t);
    vectors += area;
    by_middles += area.z() * Middle(kCorners, t).z();
    by_corners += SignedVolume(kCorners[t[0]], kCorners[t[1]], kCorners[t[2]]);
  }
  EXPECT_LT(vectors.norm(), 1e-12);
  EXPECT_NEAR(by_middles, 24.0, 1e-12);
  EXPECT_NEAR(by_corners, 24.0, 1e-12);
}

TEST(SurfaceSumsTest, VertexAreasShareOutTheWhole) {
  std::vector<double> areas(4, 0.0);
  const double whole = AddVertexAreas(kCorners, kFaces, areas);
  EXPECT_NEAR(whole, 6.0 + 18.0 + 24.0 + AreaVector(kCorners, kFaces[3]).norm(), 1e-12);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), whole, 1e-12);
  EXPECT_NEAR(areas[0], (6.0 + 18.0 + 24.0) / 3.0, 1e-12);
}

}  // namespace
}  // namespace capfit::mesh
