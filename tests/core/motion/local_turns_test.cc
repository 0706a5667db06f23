#include "core/motion/local_turns.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

namespace capfit::motion {
namespace {

using Vec3 = Eigen::Vector3d;

// An arm along x that bends at 0: points on two tubes, a capsule in each.
struct Arm {
  capsule::PrimitiveSet set;
  std::vector<Vec3> points;

  Arm() {
    for (const double x : {-0.3, 0.0, 0.3}) {
      set.spheres.push_back({Vec3(x, 0, 0), 0.05});
      set.origins.push_back({});
    }
    set.capsules = {{0, 1}, {1, 2}};
    for (int i = -30; i <= 30; ++i) {
      for (int k = 0; k < 12; ++k) {
        const double angle = k * 0.5235987755982988;
        points.emplace_back(0.01 * i, 0.05 * std::cos(angle), 0.05 * std::sin(angle));
      }
    }
  }
};

TEST(LocalTurnsTest, ABodyThatMovesAsOneTurnsEverywhereAlike) {
  const Arm arm;
  const LocalTurns turns(arm.points, arm.set, ThreadPool(1));
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  std::vector<Vec3> now;
  for (const Vec3& p : arm.points) now.push_back(turn * p + Vec3(5, -3, 2));
  for (const Eigen::Matrix3d& at : turns.At(now)) EXPECT_LT((at - turn).norm(), 1e-9);
}

TEST(LocalTurnsTest, EachEndTurnsWithItsLimb) {
  const Arm arm;
  const LocalTurns turns(arm.points, arm.set, ThreadPool(1));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vec3::UnitZ()).toRotationMatrix();
  std::vector<Vec3> now;
  for (const Vec3& p : arm.points) now.push_back(p.x() > 0.0 ? Vec3(turn * p) : p);
  const std::vector<Eigen::Matrix3d> at = turns.At(now);
  EXPECT_LT(Eigen::AngleAxisd(at[0]).angle(), 1e-6);
  EXPECT_NEAR(Eigen::AngleAxisd(at[2]).angle(), 0.8, 1e-6);
  EXPECT_GT(Eigen::AngleAxisd(at[1]).angle(), 0.2);  // the elbow is of both
  EXPECT_LT(Eigen::AngleAxisd(at[1]).angle(), 0.6);
}

TEST(LocalTurnsTest, ASphereWithoutPointsTurnsAsItsNeighbour) {
  Arm arm;
  arm.set.spheres.push_back({Vec3(0.29, 0, 0), 0.001});  // deep inside of the last one
  arm.set.origins.push_back({});
  const LocalTurns turns(arm.points, arm.set, ThreadPool(1));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vec3::UnitZ()).toRotationMatrix();
  std::vector<Vec3> now;
  for (const Vec3& p : arm.points) now.push_back(p.x() > 0.0 ? Vec3(turn * p) : p);
  const std::vector<Eigen::Matrix3d> at = turns.At(now);
  EXPECT_EQ(at[3], at[2]);
}

}  // namespace
}  // namespace capfit::motion
