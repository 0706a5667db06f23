#include "core/mannequin/catmull_clark.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/mannequin/cage_builder.h"
#include "core/mannequin/girth.h"
#include "core/mannequin/quad_sampling.h"

namespace capfit::mannequin {
namespace {

using Eigen::Vector3d;

QuadMesh Cube() {
  QuadMesh cube;
  for (int i = 0; i < 8; ++i) {
    cube.vertices.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  }
  cube.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return cube;
}

TEST(SmoothSurfaceTest, CubeCornerGoesToTheKnownLimit) {
  // Valence 3: (9 p + 4 sum of neighbours + sum of diagonals) / 24 = (9 + 4 - 1) / 24 of p.
  const SmoothSurface surface(Cube(), 0);
  EXPECT_LT((surface.GridPoint(1, 0, 0) - 0.5 * Vector3d(-1, -1, 1)).norm(), 1e-12);
}

TEST(SmoothSurfaceTest, MoreLevelsSampleTheSameSurface) {
  const SmoothSurface coarse(Cube(), 1);
  const SmoothSurface fine(Cube(), 4);
  for (std::size_t face = 0; face < 6; ++face) {
    for (int i = 0; i <= 2; ++i) {
      for (int j = 0; j <= 2; ++j) {
        EXPECT_LT((coarse.GridPoint(face, i, j) - fine.GridPoint(face, 8 * i, 8 * j)).norm(),
                  1e-12);
      }
    }
  }
}

// Each step keeps the sharp edges sharp: they are the same after one and after four.
TEST(SmoothSurfaceTest, MoreLevelsSampleTheSameSurfaceWithCreases) {
  QuadMesh cube = Cube();
  cube.creases = {{4, 5}, {5, 7}, {7, 6}, {6, 4}};  // around the face z = 1
  const SmoothSurface coarse(cube, 1);
  const SmoothSurface fine(cube, 4);
  for (std::size_t face = 0; face < 6; ++face) {
    for (int i = 0; i <= 2; ++i) {
      for (int j = 0; j <= 2; ++j) {
        EXPECT_LT((coarse.GridPoint(face, i, j) - fine.GridPoint(face, 8 * i, 8 * j)).norm(),
                  1e-12);
      }
    }
  }
}

TEST(SmoothSurfaceTest, CreaseCornerGoesToTheLimitOfItsCurve) {
  QuadMesh cube = Cube();
  cube.creases = {{4, 5}, {5, 7}, {7, 6}, {6, 4}};
  // (4 p + both neighbours) / 6 for the corner (-1, -1, 1), whose neighbours are (1, -1, 1) and
  // (-1, 1, 1).
  const Vector3d limit(-4.0 / 6.0, -4.0 / 6.0, 1.0);
  for (const int levels : {0, 1, 3}) {
    EXPECT_LT((SmoothSurface(cube, levels).GridPoint(1, 0, 0) - limit).norm(), 1e-12) << levels;
  }
}

TEST(SmoothSurfaceTest, GridFollowsTheFacesDirections) {
  const QuadMesh cube = Cube();
  const SmoothSurface surface(cube, 3);
  const int last = surface.grid_size() - 1;
  for (std::size_t face = 0; face < cube.quads.size(); ++face) {
    const auto nearest_corner = [&](int i, int j) {
      std::uint32_t best = 0;
      for (std::uint32_t v = 0; v < 8; ++v) {
        const Vector3d& p = surface.GridPoint(face, i, j);
        if ((cube.vertices[v] - p).norm() < (cube.vertices[best] - p).norm()) best = v;
      }
      return best;
    };
    EXPECT_EQ(nearest_corner(0, 0), cube.quads[face][0]);
    EXPECT_EQ(nearest_corner(last, 0), cube.quads[face][1]);
    EXPECT_EQ(nearest_corner(last, last), cube.quads[face][2]);
    EXPECT_EQ(nearest_corner(0, last), cube.quads[face][3]);
  }
}

TEST(SmoothSurfaceTest, FaceInsideACreasedRingStaysFlat) {
  QuadMesh cube = Cube();
  cube.creases = {{4, 5}, {5, 7}, {7, 6}, {6, 4}};  // around the face z = 1
  const SmoothSurface surface(cube, 3);
  for (int i = 0; i < surface.grid_size(); ++i) {
    for (int j = 0; j < surface.grid_size(); ++j) {
      EXPECT_NEAR(surface.GridPoint(1, i, j).z(), 1.0, 1e-12);
    }
  }
  EXPECT_LT(surface.GridPoint(0, 4, 4).z(), -0.4);
}

TEST(QuadSamplingTest, OppositeEdgesAreDividedAlike) {
  QuadMesh box = Cube();
  for (Vector3d& p : box.vertices) p.x() *= 3.0;
  const SmoothSurface surface(box, 3);
  const Divisions divisions = ChooseDivisions(box, surface, 600);
  EXPECT_NEAR(divisions.quad_count, 600, 60);
  const QuadMesh mesh = Sample(box, surface, divisions);
  EXPECT_EQ(static_cast<int>(mesh.quads.size()), divisions.quad_count);
  // Closed without hanging vertices: V - E + F = 2 with E = 2 F.
  EXPECT_EQ(mesh.vertices.size(), mesh.quads.size() + 2);
}

TEST(GirthTest, TapeAroundAPolygonAndAHollow) {
  EXPECT_DOUBLE_EQ(TapeLength({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}, {0.5, 0}}), 4.0);
  EXPECT_NEAR(TapeLength({{0, 0}, {3, 0}, {0, 4}}), 12.0, 1e-12);
  EXPECT_DOUBLE_EQ(TapeLength({}), 0.0);
}

TEST(GirthTest, HalfACubeTogetherWithItsMirrorImage) {
  QuadMesh half = Cube();
  for (Vector3d& p : half.vertices) p.x() = 0.5 * (p.x() + 1.0);  // x in [0, 1]
  EXPECT_NEAR(HalfBodyGirth(half.vertices, half.quads, 0.3), 8.0, 1e-12);
  EXPECT_EQ(HalfBodyGirth(half.vertices, half.quads, 1.5), 0.0);
}

TEST(CageBuilderTest, CapClosesARingWithAGrid) {
  CageBuilder builder;
  Ring ring;
  for (const auto& [x, z] :
       {std::pair{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}) {
    ring.push_back(builder.Add({static_cast<double>(x), 0.0, static_cast<double>(z)}));
  }
  builder.Cap(ring, 3, 2, {0, 0.5, 0});
  const QuadMesh mesh = std::move(builder).Take();
  EXPECT_EQ(mesh.quads.size(), 6u);
  ASSERT_EQ(mesh.vertices.size(), 12u);
  EXPECT_NEAR(mesh.vertices[10].x(), 1.0, 1e-12);
  EXPECT_NEAR(mesh.vertices[10].z(), 1.0, 1e-12);
  EXPECT_GT(mesh.vertices[10].y(), 0.4);
}

TEST(QuadMeshTest, MirrorImageClosesTheHalfAndTurnsItsFaces) {
  QuadMesh half;
  half.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  half.quads = {{0, 1, 2, 3}};
  const QuadMesh whole = WithMirrorImage(half);
  ASSERT_EQ(whole.vertices.size(), 6u);
  ASSERT_EQ(whole.quads.size(), 2u);
  EXPECT_EQ(whole.quads[1], (Quad{0, 3, 5, 4}));
  EXPECT_EQ(whole.vertices[4].x(), -1.0);
}

}  // namespace
}  // namespace capfit::mannequin
