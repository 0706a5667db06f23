#include "core/tighten/point_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/random.h"

namespace capfit::tighten {
namespace {

using geometry::TaperedCapsule;

std::vector<Eigen::Vector3d> RandomPoints(Random& random, int count) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(random.NextIn(-1, 1), random.NextIn(0, 2), random.NextIn(-0.2, 0.2));
  }
  return points;
}

std::vector<TaperedCapsule> RandomSolids(Random& random, int count) {
  std::vector<TaperedCapsule> solids;
  for (int i = 0; i < count; ++i) {
    const std::vector<Eigen::Vector3d> ends = RandomPoints(random, 2);
    const geometry::Sphere a{ends[0], random.NextIn(0.01, 0.3)};
    solids.emplace_back(a, i % 5 == 0 ? a : geometry::Sphere{ends[1], random.NextIn(0.01, 0.3)});
  }
  return solids;
}

constexpr double kEverything = -std::numeric_limits<double>::infinity();

TEST(PointGridTest, MatchesEverySolidForEveryPoint) {
  Random random(51);
  const ThreadPool pool(1);
  for (const int count : {0, 1, 7, 300, 5000}) {
    const std::vector<Eigen::Vector3d> points = RandomPoints(random, count);
    const std::vector<TaperedCapsule> solids = RandomSolids(random, 20);
    const PointGrid grid(points);
    ASSERT_EQ(grid.size(), points.size());
    const UnionDistances distances = grid.DistancesTo(solids, kEverything, pool);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      EXPECT_EQ(grid.point(i), points[grid.order()[i]]);
      double least = std::numeric_limits<double>::infinity();
      for (const TaperedCapsule& solid : solids) {
        least = std::min(least, solid.SignedDistance(grid.point(i)));
      }
      EXPECT_NEAR(distances.distance_m[i], least, 1e-6);
      const auto nearest = static_cast<std::size_t>(distances.solid[i]);
      EXPECT_NEAR(solids[nearest].SignedDistance(grid.point(i)), least, 1e-6);
    }
  }
}

TEST(PointGridTest, LowersWhatGrownSolidsAreNearerTo) {
  Random random(59);
  const std::vector<Eigen::Vector3d> points = RandomPoints(random, 3000);
  std::vector<TaperedCapsule> solids = RandomSolids(random, 30);
  const PointGrid grid(points);
  UnionDistances lowered = grid.DistancesTo(solids, kEverything, ThreadPool(1));
  const std::vector<std::int32_t> grown = {3, 4, 17};
  for (const std::int32_t k : grown) {
    const auto larger = [&](const geometry::Sphere& s) {
      const Eigen::Vector3d aside(0.05, -0.02, 0.01);
      return geometry::Sphere{s.center_m + aside, s.radius_m + 1.01 * aside.norm()};
    };
    solids[k] = TaperedCapsule(larger(solids[k].a()), larger(solids[k].b()));
  }
  const UnionDistances before = lowered;
  grid.Lower(solids, grown, lowered, ThreadPool(2));
  const UnionDistances anew = grid.DistancesTo(solids, kEverything, ThreadPool(1));
  EXPECT_EQ(lowered.distance_m, anew.distance_m);
  EXPECT_EQ(lowered.solid, anew.solid);
  EXPECT_NE(lowered.distance_m, before.distance_m);
  grid.Lower(solids, {}, lowered, ThreadPool(2));
  EXPECT_EQ(lowered.distance_m, anew.distance_m);
}

TEST(PointGridTest, OnDenseSurfacesFloatsTellAFifthOfAMicrometre) {
  Random random(57);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 40000; ++i) {
    const double angle = random.NextIn(-3.1416, 3.1416);
    points.emplace_back(0.3 + 0.15 * std::cos(angle), random.NextIn(0.0, 1.8),
                        0.1 * std::sin(angle));
  }
  const std::vector<TaperedCapsule> solids = RandomSolids(random, 40);
  const PointGrid grid(points);
  const UnionDistances distances = grid.DistancesTo(solids, kEverything, ThreadPool(2));
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const auto nearest = static_cast<std::size_t>(distances.solid[i]);
    ASSERT_NEAR(distances.distance_m[i], solids[nearest].SignedDistance(grid.point(i)), 2e-7);
  }
}

TEST(PointGridTest, FoldedPointsLieAtTheirMirrorImages) {
  Random random(58);
  const std::vector<Eigen::Vector3d> points = RandomPoints(random, 500);
  const PointGrid grid(points, PointGrid::Fold::kToPositiveX);
  ASSERT_EQ(grid.size(), points.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Eigen::Vector3d& from = points[grid.order()[i]];
    EXPECT_EQ(grid.point(i), Eigen::Vector3d(std::abs(from.x()), from.y(), from.z()));
  }
}

TEST(PointGridTest, EveryPointIsInOneBlockAndWithinItsReach) {
  Random random(52);
  std::vector<Eigen::Vector3d> points = RandomPoints(random, 3000);
  points.resize(3400, points.front());  // many in one place
  const PointGrid grid(points);
  std::vector<int> seen(points.size(), 0);
  for (const PointGrid::Block& block : grid.blocks()) {
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      ++seen[grid.order()[i]];
      EXPECT_LE((grid.point(i) - block.center).norm(), block.reach);
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(points.size()));
}

TEST(PointGridTest, DeepPointsMayBeBoundedButShallowOnesAreExact) {
  Random random(53);
  const ThreadPool pool(1);
  const std::vector<Eigen::Vector3d> points = RandomPoints(random, 4000);
  std::vector<TaperedCapsule> solids = RandomSolids(random, 12);
  // One that holds whole blocks of points deep inside.
  solids.emplace_back(geometry::Sphere{Eigen::Vector3d::Zero(), 3.0},
                      geometry::Sphere{Eigen::Vector3d::UnitX(), 3.0});
  const PointGrid grid(points);
  const UnionDistances exact = grid.DistancesTo(solids, kEverything, pool);
  const UnionDistances shallow = grid.DistancesTo(solids, -0.05, pool);
  int bounded = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (shallow.distance_m[i] == exact.distance_m[i]) continue;
    ++bounded;
    EXPECT_LT(shallow.distance_m[i], -0.05);
    EXPECT_GE(shallow.distance_m[i], exact.distance_m[i] - 1e-6);
  }
  EXPECT_GT(bounded, 0);
}

TEST(PointGridTest, SameBitsForAnyNumberOfThreads) {
  Random random(54);
  const PointGrid grid(RandomPoints(random, 6000));
  const std::vector<TaperedCapsule> solids = RandomSolids(random, 30);
  const UnionDistances one = grid.DistancesTo(solids, kEverything, ThreadPool(1));
  const UnionDistances seven = grid.DistancesTo(solids, kEverything, ThreadPool(7));
  EXPECT_EQ(one.distance_m, seven.distance_m);
  EXPECT_EQ(one.solid, seven.solid);
}

TEST(PointGridTest, WithoutSolidsEverythingIsInfinitelyFar) {
  const PointGrid grid(std::vector<Eigen::Vector3d>{{0, 0, 0}});
  const UnionDistances distances = grid.DistancesTo({}, kEverything, ThreadPool(1));
  EXPECT_EQ(distances.distance_m[0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(distances.solid[0], -1);
}

}  // namespace
}  // namespace capfit::tighten
