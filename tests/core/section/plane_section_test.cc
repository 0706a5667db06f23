#include "core/section/plane_section.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/section/outline.h"
#include "tests/core/section/shapes.h"

namespace capfit::section {
namespace {

geometry::PlaneFrame LevelAt(double y) {
  return {{0, y, 0}, Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitZ()};  // normal +Y
}

geometry::PlaneFrame RandomPlane(Random& random, double reach) {
  Eigen::Vector3d normal;
  do {
    normal = {random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(-1, 1)};
  } while (normal.norm() < 0.1);
  normal.normalize();
  geometry::PlaneFrame frame;
  frame.origin_m = random.NextIn(-reach, reach) * normal;
  frame.x_axis = normal.unitOrthogonal();
  frame.y_axis = normal.cross(frame.x_axis);
  return frame;
}

std::vector<SectionLoop> Cut(const mesh::BodyMesh& mesh, const geometry::PlaneFrame& plane) {
  return CutMesh(mesh::PlaneCutter(mesh.vertices(), mesh.triangles()), plane);
}

double LoopArea(const SectionLoop& loop) {
  std::vector<Eigen::Vector2d> points;
  for (const SectionPoint& p : loop) points.push_back(p.position_m);
  return SignedArea(points);
}

TEST(CutMeshTest, SphereGivesOneCircle) {
  const mesh::BodyMesh sphere = Sphere(1.0, 200, 200);
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const geometry::PlaneFrame plane = RandomPlane(random, 0.9);
    const auto loops = Cut(sphere, plane);
    ASSERT_EQ(loops.size(), 1u);
    const double r2 = 1.0 - plane.origin_m.squaredNorm();
    EXPECT_NEAR(LoopArea(loops[0]), kPi * r2, 0.01);
    for (const SectionPoint& p : loops[0]) EXPECT_NEAR(p.position_m.norm(), std::sqrt(r2), 0.02);
  }
}

TEST(CutMeshTest, MissGivesNothing) { EXPECT_TRUE(Cut(Sphere(1.0, 20, 20), LevelAt(1.5)).empty()); }

TEST(CutMeshTest, TorusGivesTwoDiscsOrARing) {
  const mesh::BodyMesh torus = Torus(1.0, 0.25, 120, 60);
  const geometry::PlaneFrame upright{{0, 0, 0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  const auto discs = Cut(torus, upright);
  ASSERT_EQ(discs.size(), 2u);
  for (const SectionLoop& loop : discs) EXPECT_NEAR(LoopArea(loop), kPi / 16, 1e-3);
  const auto ring = Cut(torus, LevelAt(0.01));
  ASSERT_EQ(ring.size(), 2u);  // the outer rim runs one way, the inner the other
  const double a = LoopArea(ring[0]);
  const double b = LoopArea(ring[1]);
  EXPECT_LT(a * b, 0.0);
  EXPECT_NEAR(a + b, kPi * (1.25 * 1.25 - 0.75 * 0.75), 0.02);
}

// A tube's rings lie exactly in the plane: every vertex of the loop is a vertex of the mesh.
TEST(CutMeshTest, PlanesThroughVerticesAndFacesStillClose) {
  MeshParts parts;
  AddTube(
      {0, 0, 0}, {0, 1, 0}, Eigen::Vector3d::UnitX(),
      [](double) { return Eigen::Vector2d(0.2, 0.1); }, 4, 24, parts);
  const mesh::BodyMesh tube = parts.Build();
  const double area = 0.5 * 24 * std::sin(2 * kPi / 24) * 0.02;
  for (const double y : {0.25, 0.5, 0.75, 1.0}) {
    const auto loops = Cut(tube, LevelAt(y));
    ASSERT_EQ(loops.size(), 1u) << y;
    EXPECT_NEAR(LoopArea(loops[0]), area, 1e-12) << y;
  }
  EXPECT_TRUE(Cut(tube, LevelAt(0.0)).empty());  // all of it is on the plane or above
}

TEST(CutMeshTest, PointsLieInThePlaneAndOnTheMesh) {
  const mesh::BodyMesh sphere = Sphere(1.0, 16, 16);
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const geometry::PlaneFrame plane = RandomPlane(random, 0.9);
    for (const SectionLoop& loop : Cut(sphere, plane)) {
      for (const SectionPoint& p : loop) {
        const Eigen::Vector3d at = plane.ToSpace(p.position_m);
        const Eigen::Vector3d vertex = sphere.vertices()[p.nearest_vertex];
        EXPECT_LT((at - vertex).norm(), 0.35);  // half an edge away at most
      }
    }
  }
}

TEST(OutlineTest, ForeignStretchesAreCutOffStraight) {
  // A square whose right third belongs to something else.
  SectionLoop loop;
  for (int i = 0; i <= 30; ++i) loop.push_back({{i * 0.1, 0.0}, i > 20 ? 1u : 0u});
  for (int i = 30; i >= 0; --i) loop.push_back({{i * 0.1, 3.0}, i > 20 ? 1u : 0u});
  const auto outline = PartOutline({loop}, [](std::uint32_t v) { return v == 0; });
  ASSERT_TRUE(outline.has_value());
  EXPECT_NEAR(SignedArea(*outline), 2.0 * 3.0, 1e-12);
}

TEST(OutlineTest, TakesTheNearerOfTwoLoopsAndNeverAHollow) {
  const auto square = [](double x, double side, bool turned) {
    SectionLoop loop{{{x, 0}, 0}, {{x + side, 0}, 0}, {{x + side, side}, 0}, {{x, side}, 0}};
    if (turned) std::reverse(loop.begin(), loop.end());
    return loop;
  };
  const auto all = [](std::uint32_t) { return true; };
  const auto outline =
      PartOutline({square(5, 1, false), square(-1, 1.2, false), square(0, 1, true)}, all);
  ASSERT_TRUE(outline.has_value());
  EXPECT_NEAR(SignedArea(*outline), 1.44, 1e-12);
  EXPECT_FALSE(PartOutline({square(0, 1, true)}, all).has_value());
  EXPECT_FALSE(PartOutline({}, all).has_value());
}

TEST(OutlineTest, ResamplesAtEqualSteps) {
  const std::vector<Eigen::Vector2d> square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const auto points = Resample(square, 32);
  ASSERT_EQ(points.size(), 32u);
  for (std::size_t i = 0; i < 32; ++i) {
    EXPECT_NEAR((points[(i + 1) % 32] - points[i]).norm(), 0.5, 1e-12);
  }
}

TEST(OutlineTest, SymmetrisedIsTheMeanToTheBit) {
  std::vector<Eigen::Vector2d> skew;
  for (int i = 0; i < 90; ++i) {
    const double a = 2 * kPi * i / 90 + 0.3;
    skew.emplace_back(0.3 * std::cos(a) + 0.01, 0.2 * std::sin(a) + 0.02 * std::cos(a));
  }
  const auto points = Symmetrised(skew, 64);
  ASSERT_TRUE(points.has_value());
  ASSERT_EQ(points->size(), 64u);
  EXPECT_EQ((*points)[0].x(), 0.0);
  EXPECT_EQ((*points)[32].x(), 0.0);
  for (std::size_t k = 1; k < 32; ++k) {
    EXPECT_EQ((*points)[k].x(), -(*points)[64 - k].x());
    EXPECT_EQ((*points)[k].y(), (*points)[64 - k].y());
  }
  EXPECT_NEAR(SignedArea(*points), SignedArea(skew), 0.01 * SignedArea(skew));
  for (Eigen::Vector2d& p : skew) p.x() += 1.0;
  EXPECT_FALSE(Symmetrised(skew, 64).has_value());
}

}  // namespace
}  // namespace capfit::section
