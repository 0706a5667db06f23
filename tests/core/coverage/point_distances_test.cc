#include "core/coverage/point_distances.h"

#include <gtest/gtest.h>

#include "core/coverage/grow.h"
#include "tests/core/tighten/tube_body.h"

namespace capfit::coverage {
namespace {

// A set and its points, folded as coverage has them.
struct Ground {
  explicit Ground(std::uint64_t seed) : body(tighten::MakeTubeBody(seed, 0.002)) {}

  [[nodiscard]] PointDistances Distances() {
    return {body.target, points, 10.0, variables, body.set, pool};
  }
  // What the set's own solids say of each point, one by one.
  void ExpectTrue(const tighten::UnionDistances& by_target_index) {
    const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(body.set);
    ASSERT_EQ(by_target_index.distance_m.size(), body.target.points_m.size());
    for (std::size_t i = 0; i < body.target.points_m.size(); ++i) {
      const Eigen::Vector3d& point = body.target.points_m[i];
      const double distance = tighten::DistanceToUnion(body.set, point);
      // Beside an axis, deep inside, floats lose digits.
      const double tolerance = distance < -0.02 ? 3e-5 : 1e-6;
      ASSERT_NEAR(by_target_index.distance_m[i], distance, tolerance);
      ASSERT_NEAR(solids[by_target_index.solid[i]].SignedDistance(point), distance, tolerance);
    }
  }

  tighten::TubeBody body;
  const ThreadPool pool{2};
  tighten::SetVariables variables{body.set};
  const tighten::PointGrid points{body.target.points_m, tighten::PointGrid::Fold::kToPositiveX};
};

TEST(PointDistances, AreThoseOfTheSetAsItIs) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Ground ground(seed);
    PointDistances distances = ground.Distances();
    EXPECT_EQ(distances.Known(), nullptr);
    ground.ExpectTrue(distances.ByTargetIndex());
    EXPECT_EQ(distances.Known(), &distances.InOrderOfPoints());
    // Growing step by step, as coverage does.
    for (const Eigen::Vector3d& point :
         {Eigen::Vector3d(0.3, 1.0, 0.2), Eigen::Vector3d(-0.2, 0.4, -0.2)}) {
      ASSERT_TRUE(GrowTo({point, 0.0}, ground.body.set));
      EXPECT_EQ(distances.Known(), nullptr);
      ground.ExpectTrue(distances.ByTargetIndex());
    }
    // What has become smaller is measured anew.
    for (geometry::Sphere& sphere : ground.body.set.spheres) sphere.radius_m *= 0.8;
    ground.ExpectTrue(distances.ByTargetIndex());
  }
}

}  // namespace
}  // namespace capfit::coverage
