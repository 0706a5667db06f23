#include "core/motion/cover_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace capfit::motion {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double kRadius = 0.05;

// A bent pipe along x: a capsule on each side of 0, and points on tubes around them.
struct Pipe {
  tighten::CoverTarget target;
  capsule::PrimitiveSet set;

  Pipe() {
    for (int i = -40; i <= 40; ++i) {
      for (int k = 0; k < 16; ++k) {
        const double angle = k * 0.39269908169872414;
        target.points_m.own().emplace_back(0.01 * i, kRadius * std::cos(angle),
                                           kRadius * std::sin(angle));
      }
    }
    for (std::uint32_t i = 0; i + 17 < target.points_m.size(); ++i) {
      target.triangles.own().push_back({i, i + 1, i + 16});
    }
    for (const double x : {-0.4, 0.0, 0.4}) {
      set.spheres.push_back({Vec3(x, 0, 0), kRadius + 1e-4});
      set.origins.push_back({});
    }
    set.capsules = {{0, 1}, {1, 2}};
  }

  // Points beyond 0 moved out from the axis by a bulge around x.
  [[nodiscard]] std::vector<Vec3> Bulging(double x, double by) const {
    std::vector<Vec3> points(target.points_m.begin(), target.points_m.end());
    for (Vec3& p : points) {
      const double share = by * std::exp(-std::pow((p.x() - x) / 0.08, 2.0));
      p.tail<2>() *= 1.0 + share / kRadius;
    }
    return points;
  }
};

// Centres that stay where they are.
Carry Still(std::size_t frames) {
  return [frames](const capsule::PrimitiveSet& at_rest) {
    std::vector<Vec3> centers;
    for (const geometry::Sphere& sphere : at_rest.spheres) centers.push_back(sphere.center_m);
    return std::vector<std::vector<Vec3>>(frames, centers);
  };
}

double FurthestOut(const capsule::PrimitiveSet& set, std::span<const Vec3> points) {
  double furthest = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) {
    double least = std::numeric_limits<double>::infinity();
    for (const geometry::TaperedCapsule& solid : capsule::Solids(set)) {
      least = std::min(least, solid.SignedDistance(p));
    }
    furthest = std::max(furthest, least);
  }
  return furthest;
}

TEST(CoverMotionTest, RadiiThatHoldInAllFrames) {
  Pipe pipe;
  const MotionFrames frames = {pipe.Bulging(-0.4, 0.0), pipe.Bulging(-0.4, 0.02),
                               pipe.Bulging(0.4, 0.03)};
  NullObserver observer;
  const MotionReport report =
      CoverMotion(pipe.target, frames, Still(3), {}, ThreadPool(2), observer, pipe.set);
  EXPECT_EQ(report.frame_count, 3);
  EXPECT_NEAR(report.max_out_before_m, 0.03, 1e-3);
  EXPECT_TRUE(report.radii_m.empty());
  for (const auto& frame : frames) EXPECT_LE(FurthestOut(pipe.set, frame), 0.0);
  EXPECT_GE(pipe.set.spheres[2].radius_m, kRadius + 0.025);
  EXPECT_GT(report.volume_ratio, 1.1);
  EXPECT_NEAR(report.mean_volume_ratio, report.volume_ratio, 1e-6);  // nothing moves
}

TEST(CoverMotionTest, RadiiOfEachFrameAreTighter) {
  Pipe constant;
  Pipe own;
  const MotionFrames frames = {own.Bulging(-0.4, 0.0), own.Bulging(-0.4, 0.02),
                               own.Bulging(0.4, 0.03)};
  NullObserver observer;
  const MotionReport all =
      CoverMotion(constant.target, frames, Still(3), {}, ThreadPool(2), observer, constant.set);
  const MotionReport each =
      CoverMotion(own.target, frames, Still(3), {.cover = {}, .radii = MotionRadii::kPerFrame},
                  ThreadPool(2), observer, own.set);
  ASSERT_EQ(each.radii_m.size(), 3U);
  EXPECT_LT(each.mean_volume_ratio, 0.95 * all.mean_volume_ratio);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    capsule::PrimitiveSet posed = own.set;  // its centres stay
    for (std::size_t i = 0; i < posed.spheres.size(); ++i) {
      posed.spheres[i].radius_m = each.radii_m[f][i];
    }
    EXPECT_LE(FurthestOut(posed, frames[f]), 0.0) << f;
  }
  EXPECT_LE(FurthestOut(own.set, own.target.points_m), 0.0);  // and at rest
}

TEST(CoverMotionTest, SameBitsForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    Pipe pipe;
    NullObserver observer;
    (void)CoverMotion(pipe.target, {pipe.Bulging(0.2, 0.02), pipe.Bulging(-0.3, 0.03)}, Still(2),
                      {.cover = {}, .radii = MotionRadii::kPerFrame}, ThreadPool(threads), observer,
                      pipe.set);
    std::vector<double> numbers;
    for (const geometry::Sphere& s : pipe.set.spheres) {
      numbers.insert(numbers.end(), {s.center_m.x(), s.center_m.y(), s.center_m.z(), s.radius_m});
    }
    return numbers;
  };
  EXPECT_EQ(run(1), run(3));
}

}  // namespace
}  // namespace capfit::motion
