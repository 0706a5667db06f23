#include "core/refine/best_fit/fill_error.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/core/refine/ball_body.h"

namespace capfit::refine {
namespace {

constexpr double kErrorRadiusM = 0.2;
const Eigen::Vector3d kErrorMiddle(0.0, 0.3, 0.05);

OccupancyGrid Grid(bool folded) {
  static const body::Body body = BallBody(kErrorMiddle, kErrorRadiusM);
  return MakeOccupancyGrid(body, AllParts(), 0.008, folded, ThreadPool(1));
}

double BallVolume(double radius_m) {
  return 4.0 / 3.0 * std::numbers::pi * radius_m * radius_m * radius_m;
}

// A capsule up the middle, a pair of capsules at its sides that overlap it, and a ball beside it.
capsule::MirroredSet Overlapping(bool mirrored) {
  capsule::MirroredSet set(mirrored);
  const int low = set.AddSphere({kErrorMiddle - Eigen::Vector3d(0, 0.08, 0), 0.1}, mirrored);
  const int high = set.AddSphere({kErrorMiddle + Eigen::Vector3d(0, 0.08, 0), 0.09}, mirrored);
  const int side = set.AddSphere({kErrorMiddle + Eigen::Vector3d(0.12, 0.02, 0.01), 0.07}, false);
  set.AddSphere({kErrorMiddle + Eigen::Vector3d(0.02, 0.0, 0.16), 0.05}, false);
  set.AddCapsule(low, high);
  set.AddCapsule(high, side);
  return set;
}

// What each cone is said to lose is by how much the error over all cells rises without it.
TEST(ErrorsByCapsuleTest, TheLossIsTheErrorWithoutIt) {
  for (const bool mirrored : {true, false}) {
    const OccupancyGrid grid = Grid(mirrored);
    const capsule::MirroredSet set = Overlapping(mirrored);
    const CapsuleErrors errors = ErrorsByCapsule(grid, set, ThreadPool(2));
    const std::vector<Cone> cones = ConesOf(set);
    ASSERT_EQ(errors.loss_m3.size(), cones.size());
    const double before = GridError(grid, set, ThreadPool(1)) * grid.volume_m3;
    for (int e = 0; e < set.capsule_count(); ++e) {
      std::vector<Cone> rest;
      for (int other = 0; other < static_cast<int>(cones.size()); ++other) {
        const bool is_capsule = other < set.capsule_count();
        if (other != e && !(is_capsule && other == set.ImageOfCapsule(e))) {
          rest.push_back(cones[other]);
        }
      }
      const Eigen::Vector3d far = Eigen::Vector3d::Constant(10.0);
      const double after = FillError(grid, rest, {-far, far});
      EXPECT_NEAR(errors.loss_m3[e], after - before, 1e-3 * BallVolume(kErrorRadiusM)) << e;
      EXPECT_GT(errors.loss_m3[e], 0.0);
    }
  }
}

// One small ball in the middle of the body: all that it leaves out lies beside it, and what it
// fills is what goes with it.
TEST(ErrorsByCapsuleTest, AllErrorIsBesideTheOnlyBall) {
  const OccupancyGrid grid = Grid(true);
  capsule::MirroredSet set(true);
  set.AddSphere({kErrorMiddle, 0.1}, true);
  const CapsuleErrors errors = ErrorsByCapsule(grid, set, ThreadPool(1));
  ASSERT_EQ(errors.beside_m3.size(), 1U);
  const double whole = BallVolume(kErrorRadiusM), filled = BallVolume(0.1);
  EXPECT_NEAR(errors.loss_m3[0], filled, 0.02 * filled);
  EXPECT_NEAR(errors.beside_m3[0], whole - filled, 0.02 * whole);
}

TEST(ErrorsByCapsuleTest, ImagesHaveTheSameAndAnyPoolTellsTheSameBits) {
  const OccupancyGrid grid = Grid(true);
  const capsule::MirroredSet set = Overlapping(true);
  const CapsuleErrors one = ErrorsByCapsule(grid, set, ThreadPool(1));
  const CapsuleErrors three = ErrorsByCapsule(grid, set, ThreadPool(3));
  EXPECT_EQ(one.loss_m3, three.loss_m3);
  EXPECT_EQ(one.beside_m3, three.beside_m3);
  for (int e = 0; e < set.capsule_count(); ++e) {
    EXPECT_EQ(one.loss_m3[e], one.loss_m3[set.ImageOfCapsule(e)]);
  }
  // The pair of balls without a capsule comes last.
  EXPECT_EQ(one.loss_m3[one.loss_m3.size() - 2], one.loss_m3.back());
}

}  // namespace
}  // namespace capfit::refine
