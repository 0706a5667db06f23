#include "core/solid/shells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/core/mesh/soups.h"
#include "tests/core/solid/solid_shapes.h"

namespace capfit::solid {
namespace {

Shells ShellsOf(const Triangles& t) {
  return FindShells(t.positions, t.triangles, 1e-9, ThreadPool(1), NullObserver());
}

TEST(ShellsTest, ClosesATubeAtBothEnds) {
  for (const int around : {7, 48, 300}) {
    const Triangles tube = Tube(0.5, 0.0, 2.0, around, 10);
    const Shells shells = ShellsOf(tube);
    ASSERT_EQ(shells.volumes.size(), 1u);
    const double base = 0.5 * around * 0.25 * std::sin(2.0 * std::numbers::pi / around);
    EXPECT_NEAR(shells.volumes[0], 2.0 * base, 1e-9);
    ASSERT_EQ(shells.rims.size(), 2u);
    for (const Rim& rim : shells.rims) {
      const double side = rim.middle.y() < 1.0 ? -1.0 : 1.0;
      EXPECT_NEAR(rim.area_vector.y(), side * base, 1e-9) << "out of the tube";
    }
    const mesh::EdgeMates mates = mesh::FindEdgeMates(shells.triangles, tube.positions.size());
    EXPECT_TRUE(mates.IsClosedAndOriented());
  }
}

TEST(ShellsTest, TurnsEachShellOutward) {
  Triangles inside_out = TrianglesOf(mesh::Moved(mesh::Ball(12, 8), {5.0, 0.0, 0.0}));
  for (mesh::Triangle& t : inside_out.triangles) std::swap(t[1], t[2]);
  const Triangles ball = TrianglesOf(mesh::Ball(12, 8));
  const Shells shells = ShellsOf(Both(ball, inside_out));
  ASSERT_EQ(shells.volumes.size(), 2u);
  EXPECT_NEAR(shells.volumes[0], shells.volumes[1], 1e-9);
  const std::size_t half = ball.triangles.size();
  ASSERT_EQ(shells.triangles.size(), 2 * half);
  const auto offset = static_cast<std::uint32_t>(ball.positions.size());
  for (std::size_t t = 0; t < half; ++t) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(shells.triangles[t][k], ball.triangles[t][k]);
      EXPECT_EQ(shells.triangles[half + t][k], ball.triangles[t][k] + offset);
    }
  }
}

}  // namespace
}  // namespace capfit::solid
