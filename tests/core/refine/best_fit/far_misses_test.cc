#include "core/refine/best_fit/far_misses.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/core/refine/ball_body.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

const Eigen::Vector3d kMissedMiddle(0.0, 0.3, 0.05);
constexpr double kMissedRadiusM = 0.3;

SurfacePoints PointsOfBall() {
  static const body::Body body = BallBody(kMissedMiddle, kMissedRadiusM);
  return {tighten::PointGrid(body.mesh.vertices(), tighten::PointGrid::Fold::kToPositiveX)};
}

double Missed(const SurfacePoints& points, const capsule::MirroredSet& graph) {
  const std::vector<double> misses = FarMisses(points, graph, ThreadPool(1));
  return std::accumulate(misses.begin(), misses.end(), 0.0);
}

// A capsule on the plane that reaches far up and down, a pair of capsules to the sides, one of
// balls, and one ball in the midst of all.
capsule::MirroredSet Reaching() {
  capsule::MirroredSet set(true);
  const int low = set.AddSphere({kMissedMiddle - Eigen::Vector3d(0, 0.2, 0), 0.06}, true);
  const int high = set.AddSphere({kMissedMiddle + Eigen::Vector3d(0, 0.2, 0), 0.05}, true);
  const int in = set.AddSphere({kMissedMiddle + Eigen::Vector3d(0.05, 0, 0), 0.05}, false);
  const int out = set.AddSphere({kMissedMiddle + Eigen::Vector3d(0.2, 0.03, 0), 0.07}, false);
  set.AddSphere({kMissedMiddle + Eigen::Vector3d(0.08, 0, 0.18), 0.07}, false);
  set.AddSphere({kMissedMiddle, 0.04}, true);
  set.AddCapsule(low, high);
  set.AddCapsule(in, out);
  return set;
}

// Of each cone by itself: what is missed without it, looked up anew.
TEST(MissedWithoutTest, IsWhatIsMissedOfTheRest) {
  const SurfacePoints points = PointsOfBall();
  const capsule::MirroredSet set = Reaching();
  const std::vector<Cone> cones = ConesOf(set);
  const std::vector<int> images = ImagesOfCones(set);
  const std::vector<double> more_m = MissedWithout(points, cones, images, ThreadPool(2));
  ASSERT_EQ(more_m.size(), cones.size());
  const double before = Missed(points, set);
  for (std::size_t i = 0; i < cones.size(); ++i) {
    std::vector<char> spheres(set.spheres().size(), 0), capsules(set.capsules().size(), 0);
    for (std::size_t k = 0; k < cones.size(); ++k) {
      if (k == i || images[k] == static_cast<int>(i)) continue;
      spheres[cones[k].node_a] = spheres[cones[k].node_b] = 1;
      if (k < capsules.size()) capsules[k] = 1;
    }
    capsule::MirroredSet rest = set;
    rest.KeepOnly(spheres, capsules);
    EXPECT_NEAR(more_m[i], Missed(points, rest) - before, 1e-4 * before) << i;
  }
  EXPECT_GT(more_m[0], 0.1 * before);
  EXPECT_EQ(more_m.back(), 0.0);  // nothing lies nearest to the ball in the midst
}

TEST(MissedWithoutTest, ImagesHaveTheSameAndAnyPoolTellsTheSameBits) {
  const SurfacePoints points = PointsOfBall();
  const capsule::MirroredSet set = Reaching();
  const std::vector<int> images = ImagesOfCones(set);
  const std::vector<double> one = MissedWithout(points, ConesOf(set), images, ThreadPool(1));
  EXPECT_EQ(one, MissedWithout(points, ConesOf(set), images, ThreadPool(3)));
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i], one[images[i]]);
}

// A point 0.24 m from the only ball is 0.2 m further out than what counts as far.
TEST(FarMissesTest, CountBeyondFourCentimetres) {
  const SurfacePoints points = PointsOfBall();
  capsule::MirroredSet set(true);
  set.AddSphere({kMissedMiddle, kMissedRadiusM - 0.24}, true);
  for (const double miss : FarMisses(points, set, ThreadPool(1))) EXPECT_NEAR(miss, 0.2, 1e-3);
  set.sphere(0).radius_m = kMissedRadiusM - 0.03;
  EXPECT_EQ(Missed(points, set), 0.0);
}

}  // namespace
}  // namespace capfit::refine
