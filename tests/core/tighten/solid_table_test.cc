#include "core/tighten/solid_table.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace capfit::tighten {
namespace {

// All kinds: slender, steep, swallowed at either end, and lone spheres.
std::vector<geometry::TaperedCapsule> MixedSolids(Random& random, int count) {
  const auto point = [&random] {
    return Eigen::Vector3d(random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(-1, 1));
  };
  std::vector<geometry::TaperedCapsule> solids;
  for (int i = 0; i < count; ++i) {
    const geometry::Sphere first{point(), random.NextIn(0.01, 0.8)};
    const geometry::Sphere second{point(), random.NextIn(0.01, 0.8)};
    solids.emplace_back(first, i % 5 == 0 ? first : second);
  }
  return solids;
}

// Numbers of solids that fill whole registers and that do not.
TEST(SolidTableTest, TellsTheDistanceOfEachSolid) {
  Random random(11);
  for (int count = 0; count <= 13; ++count) {
    const std::vector<geometry::TaperedCapsule> solids = MixedSolids(random, count);
    const SolidTable table(solids);
    ASSERT_EQ(table.size(), solids.size());
    std::vector<double> distances = {-7.0};
    for (int trial = 0; trial < 50; ++trial) {
      const Eigen::Vector3d place(random.NextIn(-2, 2), random.NextIn(-2, 2), random.NextIn(-2, 2));
      table.DistancesFrom(place, distances);
      ASSERT_GE(distances.size(), solids.size());
      for (std::size_t k = 0; k < solids.size(); ++k) {
        EXPECT_NEAR(distances[k], solids[k].SignedDistance(place), 1e-7);
      }
    }
  }
}

}  // namespace
}  // namespace capfit::tighten
