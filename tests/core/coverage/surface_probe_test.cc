#include "core/coverage/surface_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/base/random.h"
#include "core/coverage/cover_body.h"
#include "tests/core/tighten/tube_body.h"

namespace capfit::coverage {
namespace {

const ThreadPool& Alone() {
  static const ThreadPool pool(1);
  return pool;
}

// One large triangle over the gap between balls around its corners.
struct Tent {
  tighten::CoverTarget target;
  capsule::PrimitiveSet set;

  explicit Tent(double radius_m) {
    target.points_m.own() = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    target.triangles.own() = {{0, 1, 2}};
    for (const Eigen::Vector3d& p : target.points_m) {
      set.spheres.push_back({p, radius_m});
      set.origins.emplace_back();
    }
  }
};

Unproved FindUnproved(const tighten::CoverTarget& target, const capsule::PrimitiveSet& set,
                      double asked_m, double max_gap_m) {
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(set);
  const tighten::PointGrid grid(target.points_m);
  const tighten::UnionDistances at =
      InCallersOrder(grid, grid.DistancesTo(solids, -1.0, Alone()), Alone());
  return FindPointsOutside(target, at, solids, asked_m, max_gap_m, Alone());
}

std::vector<Eigen::Vector3d> PointsOutside(const Tent& tent, double asked_m, double max_gap_m) {
  return FindUnproved(tent.target, tent.set, asked_m, max_gap_m).points_m;
}

double Furthest(const tighten::CoverTarget& target, const capsule::PrimitiveSet& set, int n) {
  double furthest = 0.0;
  for (const mesh::Triangle& t : target.triangles) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Eigen::Vector3d p = (i * target.points_m[t[0]] + j * target.points_m[t[1]] +
                                   (n - i - j) * target.points_m[t[2]]) /
                                  n;
        furthest = std::max(furthest, tighten::DistanceToUnion(set, p));
      }
    }
  }
  return furthest;
}

TEST(SurfaceProbeTest, TheFarthestVertexIsThatOfAllChunks) {
  Random random(17);
  tighten::CoverTarget target;
  for (int i = 0; i < 10'000; ++i) {
    target.points_m.own().emplace_back(random.NextIn(-1, 1), random.NextIn(-1, 1),
                                       random.NextIn(-1, 1));
  }
  const Tent tent(0.6);
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(tent.set);
  const tighten::PointGrid grid(target.points_m);
  for (const bool holds_all : {false, true}) {
    std::vector<geometry::TaperedCapsule> larger = solids;
    const geometry::Sphere ball{{0, 0, 0}, 2.0};
    if (holds_all) larger.emplace_back(ball, ball);
    double most = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& p : target.points_m) {
      double distance = std::numeric_limits<double>::infinity();
      for (const auto& solid : larger) distance = std::min(distance, solid.SignedDistance(p));
      most = std::max(most, distance);
    }
    const tighten::UnionDistances at =
        InCallersOrder(grid, grid.DistancesTo(larger, -10.0, Alone()), Alone());
    const double found = MaxVertexDistance(target, at, larger, Alone());
    EXPECT_NEAR(found, most, 1e-12) << holds_all;
    EXPECT_EQ(MaxVertexDistance(target, at, larger, ThreadPool(2)), found);
  }
}

// The middle of the long side is 1 / sqrt(2) from the nearest corner.
TEST(SurfaceProbeTest, TheCertifiedGapOfATentIsWhatItIs) {
  for (const double radius : {0.2, 0.5, 0.7}) {
    const Tent tent(radius);
    const double gap = CertifiedGap(tent.target, tent.set, 1e-4, Alone());
    EXPECT_GE(gap, std::sqrt(0.5) - radius - 1e-12);
    EXPECT_LE(gap, std::sqrt(0.5) - radius + 2e-4);
  }
  EXPECT_LE(CertifiedGap(Tent(0.75).target, Tent(0.75).set, 1e-4, Alone()), 1e-4);
}

TEST(SurfaceProbeTest, TheGapBoundsEverySampleFromAboveAndNotByMuch) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const tighten::TubeBody body = tighten::MakeTubeBody(seed, 0.0);
    const double sampled = Furthest(body.target, body.set, 12);
    const double gap = CertifiedGap(body.target, body.set, 1e-4, Alone());
    EXPECT_GE(gap, sampled - 1e-9);
    EXPECT_LE(gap, sampled + 1e-3);
  }
}

TEST(SurfaceProbeTest, PointsOutsideAreOutsideAndNoneMeansProved) {
  const Tent loose(0.5);
  const std::vector<Eigen::Vector3d> found = PointsOutside(loose, 0.05, 0.06);
  ASSERT_FALSE(found.empty());
  for (const Eigen::Vector3d& p : found) {
    EXPECT_GT(tighten::DistanceToUnion(loose.set, p), 0.05);
    EXPECT_NEAR(p.z(), 0.0, 1e-12);
    EXPECT_TRUE(p.x() >= -1e-12 && p.y() >= -1e-12 && p.x() + p.y() <= 1.0 + 1e-12);
  }
  EXPECT_TRUE(PointsOutside(Tent(0.66), 0.05, 0.06).empty());
}

// Grown solids leave fewer triangles open, and those are among the ones that were.
TEST(SurfaceProbeTest, WhatWasOpenIsEnoughToLookAtAgain) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    tighten::TubeBody body = tighten::MakeTubeBody(seed, 0.0);
    const double out_m = std::max(0.0, Furthest(body.target, body.set, 1));
    for (geometry::Sphere& sphere : body.set.spheres) sphere.radius_m += out_m;
    const Unproved before = FindUnproved(body.target, body.set, 0.0008, 0.001);
    for (const double growth_m : {0.0, 0.001, 0.004}) {
      capsule::PrimitiveSet grown = body.set;
      for (geometry::Sphere& sphere : grown.spheres) sphere.radius_m += growth_m;
      const Unproved all = FindUnproved(body.target, grown, 0.0008, 0.001);
      const Unproved again = FindPointsOutside(body.target, before.triangles,
                                               capsule::Solids(grown), 0.0008, 0.001, Alone());
      for (const std::uint32_t triangle : all.triangles) {
        EXPECT_EQ(std::count(again.triangles.begin(), again.triangles.end(), triangle), 1)
            << "seed " << seed << " growth " << growth_m << " triangle " << triangle;
      }
    }
  }
}

TEST(SurfaceProbeTest, WithoutSolidsTheGapIsInfiniteAndWithoutPointsNothing) {
  EXPECT_EQ(CertifiedGap(Tent(0.5).target, {}, 1e-4, Alone()),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(CertifiedGap({}, Tent(0.5).set, 1e-4, Alone()), 0.0);
}

TEST(SurfaceProbeTest, CallersOrderIsThatOfThePoints) {
  Random random(4);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 500; ++i) {
    points.push_back({random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(-1, 1)});
  }
  const Tent tent(0.3);
  const tighten::PointGrid grid(points);
  const tighten::UnionDistances at =
      InCallersOrder(grid, grid.DistancesTo(capsule::Solids(tent.set), -9.0, Alone()), Alone());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(at.distance_m[i], tighten::DistanceToUnion(tent.set, points[i]), 2e-6);
  }
}

}  // namespace
}  // namespace capfit::coverage
