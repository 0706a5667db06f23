#include "core/coverage/grow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/random.h"
#include "tests/core/tighten/tube_body.h"

namespace capfit::coverage {
namespace {

using tighten::DistanceToUnion;
using tighten::IsExactlyMirrored;
using tighten::MakeTubeBody;
using tighten::TubeBody;

const NullObserver kSilent;

Eigen::Vector3d RandomPoint(Random& random) {
  return {random.NextIn(-0.8, 0.8), random.NextIn(-0.1, 1.7), random.NextIn(-0.4, 0.4)};
}

TEST(GrowToTest, TheNewSetContainsTheOldAndTouchesThePoint) {
  Random random(31);
  for (int round = 0; round < 60; ++round) {
    const TubeBody body = MakeTubeBody(static_cast<std::uint64_t>(round), 0.0);
    capsule::PrimitiveSet set = body.set;
    const Demand demand{RandomPoint(random), round % 2 == 0 ? 0.0 : -0.01};
    const double missing = DistanceToUnion(set, demand.point_m) - demand.allowed_m;
    ASSERT_EQ(GrowTo(demand, set), missing > 0.0);
    EXPECT_LE(DistanceToUnion(set, demand.point_m), demand.allowed_m + 1e-12);
    if (missing > 0.0) {
      EXPECT_NEAR(DistanceToUnion(set, demand.point_m), demand.allowed_m, 1e-6);
    }
    for (std::size_t i = 0; i < set.spheres.size(); ++i) {
      const double slack = set.spheres[i].radius_m - body.set.spheres[i].radius_m -
                           (set.spheres[i].center_m - body.set.spheres[i].center_m).norm();
      EXPECT_GE(slack, -1e-12) << "sphere " << i << " does not contain what it was";
    }
    EXPECT_TRUE(IsExactlyMirrored(set));
  }
}

TEST(GrowToTest, AFreeCapsuleGrowsByHalfOfWhatIsMissing) {
  capsule::PrimitiveSet set;
  set.spheres = {{{0, 0, 0}, 0.2}, {{0, 0, 1}, 0.1}};
  set.origins.resize(2);
  set.capsules = {{0, 1}};
  const Eigen::Vector3d point(0.5, 0.1, 0.4);
  const double missing = DistanceToUnion(set, point);
  ASSERT_TRUE(GrowTo({point, 0.0}, set));
  EXPECT_NEAR(set.spheres[0].radius_m, 0.2 + 0.5 * missing, 1e-8);
  EXPECT_NEAR(set.spheres[1].radius_m, 0.1 + 0.5 * missing, 1e-8);
}

TEST(GrowToTest, APointBeyondOneEndMovesOnlyThatEnd) {
  capsule::PrimitiveSet set;
  set.spheres = {{{0, 0, 0}, 0.2}, {{0, 0, 1}, 0.2}};
  set.origins.resize(2);
  set.capsules = {{0, 1}};
  ASSERT_TRUE(GrowTo({{0, 0, 1.4}, 0.0}, set));
  EXPECT_EQ(set.spheres[0].radius_m, 0.2);
  EXPECT_EQ(set.spheres[0].center_m, Eigen::Vector3d(0, 0, 0));
  EXPECT_NEAR(set.spheres[1].radius_m, 0.3, 1e-8);
  EXPECT_NEAR(set.spheres[1].center_m.z(), 1.1, 1e-8);
}

TEST(GrowToAllTest, MeetsEveryDemandInAtMostOneStepEach) {
  Random random(32);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const TubeBody body = MakeTubeBody(seed, 0.0);
    capsule::PrimitiveSet set = body.set;
    std::vector<Demand> demands;
    for (int i = 0; i < 300; ++i) demands.push_back({RandomPoint(random), -1e-6});
    const int steps = GrowToAll(demands, kSilent, set);
    EXPECT_GT(steps, 0);
    EXPECT_LE(steps, 300);
    for (const Demand& demand : demands) {
      EXPECT_LE(DistanceToUnion(set, demand.point_m), 0.0);
    }
    EXPECT_EQ(GrowToAll(demands, kSilent, set), 0);
  }
}

// One after the other, the furthest out first: the nearest of all solids grows each time.
TEST(GrowToAllTest, GrowsTheNearestSolidOfTheFurthestDemand) {
  Random random(33);
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const TubeBody body = MakeTubeBody(seed, 0.0);
    std::vector<Demand> demands;
    for (int i = 0; i < 60; ++i) {  // neighbours follow each other, as on a surface
      const Eigen::Vector3d step(0.01 * i, 0.02 * i, 0.005 * (i % 7));
      demands.push_back({Eigen::Vector3d(-0.3, 0.2, 0.3) + step, -1e-6});
      if (i % 17 == 0) demands.push_back({RandomPoint(random), -1e-6});
    }
    capsule::PrimitiveSet one_by_one = body.set;
    const auto missing = [&](const Demand& demand) {
      return DistanceToUnion(one_by_one, demand.point_m) - demand.allowed_m;
    };
    std::vector<Demand> open = demands;
    int steps = 0;
    for (;;) {
      std::erase_if(open, [&](const Demand& demand) { return missing(demand) <= 0.0; });
      if (open.empty()) break;
      const auto furthest = std::max_element(
          open.begin(), open.end(),
          [&](const Demand& a, const Demand& b) { return missing(a) < missing(b); });
      ASSERT_TRUE(GrowTo(*furthest, one_by_one));
      open.erase(furthest);
      ++steps;
    }
    capsule::PrimitiveSet all_at_once = body.set;
    EXPECT_EQ(GrowToAll(demands, kSilent, all_at_once), steps);
    for (std::size_t i = 0; i < body.set.spheres.size(); ++i) {
      EXPECT_EQ(all_at_once.spheres[i].center_m, one_by_one.spheres[i].center_m);
      EXPECT_EQ(all_at_once.spheres[i].radius_m, one_by_one.spheres[i].radius_m);
    }
  }
}

}  // namespace
}  // namespace capfit::coverage
