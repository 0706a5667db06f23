#include "core/tighten/distance_kernel.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace capfit::tighten {
namespace {

Eigen::Vector3d RandomPoint(Random& random, double reach) {
  return {random.NextIn(-reach, reach), random.NextIn(-reach, reach), random.NextIn(-reach, reach)};
}

// All kinds: slender, steep, and swallowed at either end.
geometry::TaperedCapsule RandomCapsule(Random& random) {
  return {{RandomPoint(random, 0.3), random.NextIn(0.01, 0.3)},
          {RandomPoint(random, 0.3), random.NextIn(0.01, 0.3)}};
}

TEST(DistanceKernelTest, InDoublesAsTheExactCapsule) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const geometry::TaperedCapsule capsule = RandomCapsule(random);
    const DistanceKernel kernel = DistanceKernel(capsule);
    const Eigen::Vector3d p = RandomPoint(random, 1.0);
    EXPECT_NEAR(kernel.SignedDistance(p.x(), p.y(), p.z()), capsule.SignedDistance(p), 1e-7);
  }
}

TEST(DistanceKernelTest, InFloatsAroundAPointToAMicrometre) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const geometry::TaperedCapsule capsule = RandomCapsule(random);
    const Eigen::Vector3d center = RandomPoint(random, 1.0);
    const FloatKernel kernel = KernelAround(DistanceKernel(capsule), center);
    const Eigen::Vector3f offset = RandomPoint(random, 0.05).cast<float>();
    const Eigen::Vector3d p = center + offset.cast<double>();
    EXPECT_NEAR(kernel.SignedDistance(offset.x(), offset.y(), offset.z()),
                capsule.SignedDistance(p), 2e-6);
  }
}

TEST(DistanceKernelTest, TheFootLiesBehindThePointAlongTheSlant) {
  // Half opening angle with sine 0.6: a point straight over the axis foots 0.75 of its height back.
  const DistanceKernel solid(geometry::TaperedCapsule({{0, 0, 0}, 0.8}, {{1, 0, 0}, 0.2}));
  const FloatKernel kernel = KernelAround(solid, {0, 0, 0});
  EXPECT_NEAR(kernel.Locate(3.0f, 2.0f, 0.0f).foot_m, 3.0 - 0.75 * 2.0, 1e-6);
}

}  // namespace
}  // namespace capfit::tighten
