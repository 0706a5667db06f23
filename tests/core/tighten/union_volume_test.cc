#include "core/tighten/union_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/core/tighten/tube_body.h"

namespace capfit::tighten {
namespace {

constexpr double kPi = std::numbers::pi;

// Exact along each column of a fine grid.
double ColumnVolume(const capsule::PrimitiveSet& set, double step) {
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(set);
  double volume = 0.0;
  std::vector<std::pair<double, double>> hits;
  for (double x = -1.0 + 0.5 * step; x < 1.0; x += step) {
    for (double y = -0.3 + 0.5 * step; y < 1.9; y += step) {
      hits.clear();
      for (const geometry::TaperedCapsule& solid : solids) {
        const auto inside = solid.Intersect({x, y, 0}, {0, 0, 1});
        if (inside) hits.emplace_back(inside->begin, inside->end);
      }
      std::sort(hits.begin(), hits.end());
      double reached = -1e9;
      for (const auto& [begin, end] : hits) {
        volume += std::max(0.0, end - std::max(begin, reached));
        reached = std::max(reached, end);
      }
    }
  }
  return volume * step * step;
}

TEST(UnionVolumeTest, OneBallInClosedForm) {
  capsule::PrimitiveSet set;
  set.spheres = {{{0.3, 1.0, -0.2}, 0.25}};
  set.origins.resize(1);
  const SetVariables variables(set);
  const VolumeGradient gradient = UnionVolumeGradient(set, variables, 0.01, 1, ThreadPool(1));
  EXPECT_NEAR(gradient.volume_m3, 4.0 / 3.0 * kPi * 0.015625, 1e-9);
  EXPECT_NEAR(gradient.area_m2, 4.0 * kPi * 0.0625, 1e-9);
  EXPECT_NEAR(gradient.by_sphere[0].w(), 4.0 * kPi * 0.0625, 1e-9);
  EXPECT_LT(gradient.by_sphere[0].head<3>().norm(), 1e-3);
}

TEST(UnionVolumeTest, AHiddenBallDoesNotCount) {
  capsule::PrimitiveSet set;
  set.spheres = {{{0, 1, 0}, 0.3}, {{0.1, 1, 0}, 0.1}};
  set.origins.resize(2);
  const SetVariables variables(set);
  const VolumeGradient gradient = UnionVolumeGradient(set, variables, 0.01, 1, ThreadPool(1));
  EXPECT_EQ(gradient.by_sphere[1].norm(), 0.0);
  EXPECT_NEAR(gradient.volume_m3, 4.0 / 3.0 * kPi * 0.027, 1e-6);  // sampled
}

TEST(UnionVolumeTest, ACapsuleHasItsVolumeAndItsLengthsDerivative) {
  capsule::PrimitiveSet set;
  set.spheres = {{{0, 0.5, 0}, 0.1}, {{0, 1.2, 0}, 0.1}};
  set.origins.resize(2);
  set.capsules = {{0, 1}};
  const SetVariables variables(set);
  const VolumeGradient gradient = UnionVolumeGradient(set, variables, 0.004, 1, ThreadPool(1));
  EXPECT_NEAR(gradient.volume_m3, set.Capsule(0).Volume_m3(), 2e-3 * gradient.volume_m3);
  EXPECT_NEAR(gradient.by_sphere[1].y(), kPi * 0.01, 1e-3);  // pi r^2 per metre of length
  EXPECT_NEAR(gradient.by_sphere[0].y(), -kPi * 0.01, 1e-3);
}

TEST(UnionVolumeTest, GradientMatchesDifferencesOfTheVolume) {
  const TubeBody body = MakeTubeBody(5, 0.0);
  capsule::PrimitiveSet set = body.set;
  const SetVariables variables(set);
  const VolumeGradient gradient = UnionVolumeGradient(set, variables, 0.003, 1, ThreadPool(2));
  EXPECT_NEAR(gradient.volume_m3, ColumnVolume(set, 0.004), 0.01 * gradient.volume_m3);
  const double step = 2e-3;
  for (const std::size_t sphere : {std::size_t{0}, std::size_t{2}, std::size_t{8}}) {
    for (int k = 0; k < 4; ++k) {
      const auto shifted = [&](double by) {
        capsule::PrimitiveSet moved = set;
        if (k < 3) {
          moved.spheres[sphere].center_m[k] += by;
        } else {
          moved.spheres[sphere].radius_m += by;
        }
        return ColumnVolume(moved, 0.004);
      };
      const double slope = (shifted(step) - shifted(-step)) / (2 * step);
      EXPECT_NEAR(gradient.by_sphere[sphere][k], slope, 2e-3) << sphere << " " << k;
    }
  }
}

// Balls around a hollow, all within a larger ball that should be full.
struct Shell {
  capsule::PrimitiveSet set;
  FullCells full;
};

Shell BallsAroundAHollow() {
  Shell shell;
  constexpr int kBalls = 60;
  const Eigen::Vector3d middle(0.1, 0.8, 0.0);
  for (int i = 0; i < kBalls; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / kBalls;
    const double r = std::sqrt(1.0 - z * z);
    const double turn = 2.0 * kPi * i / std::numbers::phi;
    const Eigen::Vector3d out(r * std::cos(turn), r * std::sin(turn), z);
    shell.set.spheres.push_back({middle + 0.3 * out, 0.11});
  }
  shell.set.origins.resize(kBalls);
  constexpr int kCells = 64;
  shell.full = {.origin_m = (middle.array() - 0.32).matrix().cast<float>(),
                .cells_per_m = 100.0f,
                .nx = kCells,
                .ny = kCells,
                .nz = kCells,
                .folded = false,
                .is_full = {}};
  for (int iy = 0; iy < kCells; ++iy) {
    for (int ix = 0; ix < kCells; ++ix) {
      for (int iz = 0; iz < kCells; ++iz) {
        const Eigen::Vector3d at = (Eigen::Array3d(ix, iy, iz) + 0.5) * 0.01 - 0.32;
        shell.full.is_full.push_back(at.norm() < 0.3 ? 1 : 0);
      }
    }
  }
  return shell;
}

// Of the cells of one edge length whose middles no ball holds.
double EmptyVolume(const Shell& shell, double radius_m, double step) {
  const Eigen::Vector3d middle(0.1, 0.8, 0.0);
  double empty = 0.0;
  for (double x = -radius_m; x < radius_m; x += step) {
    for (double y = -radius_m; y < radius_m; y += step) {
      for (double z = -radius_m; z < radius_m; z += step) {
        const Eigen::Vector3d at(x, y, z);
        if (at.norm() > radius_m) continue;
        const auto holds = [&](const geometry::Sphere& ball) {
          return (middle + at - ball.center_m).norm() <= ball.radius_m;
        };
        if (std::none_of(shell.set.spheres.begin(), shell.set.spheres.end(), holds)) ++empty;
      }
    }
  }
  return empty * step * step * step;
}

TEST(UnionVolumeTest, HollowsCountAsWhatIsLeftToFill) {
  Shell shell = BallsAroundAHollow();
  const SetVariables variables(shell.set);
  const auto at = [&](const FullCells* full) {
    return UnionVolumeGradient(shell.set, variables, 0.004, 1, ThreadPool(2), full);
  };
  const VolumeGradient plain = at(nullptr);
  const VolumeGradient filled = at(&shell.full);
  const double hollow = EmptyVolume(shell, 0.28, 0.005);
  ASSERT_GT(hollow, 0.02);
  EXPECT_NEAR(plain.volume_m3, ColumnVolume(shell.set, 0.004), 0.01 * plain.volume_m3);
  EXPECT_NEAR(filled.volume_m3, plain.volume_m3 + 2.0 * hollow, 0.01 * filled.volume_m3);
  EXPECT_EQ(filled.area_m2, plain.area_m2);  // that of the hollow too
  // A ball that moves inwards fills more of the hollow than it bares behind it.
  constexpr double kStep = 0.01;  // that samples do not hide the change
  for (const std::size_t i : {std::size_t{7}, std::size_t{30}, std::size_t{52}}) {
    const Eigen::Vector3d inwards =
        (Eigen::Vector3d(0.1, 0.8, 0.0) - shell.set.spheres[i].center_m).normalized();
    const double slope = filled.by_sphere[i].head<3>().dot(inwards);
    EXPECT_LT(slope, 0.0);
    EXPECT_GT(plain.by_sphere[i].head<3>().dot(inwards), slope);
    const geometry::Sphere before = shell.set.spheres[i];
    shell.set.spheres[i].center_m = before.center_m + kStep * inwards;
    const double further = at(&shell.full).volume_m3;
    shell.set.spheres[i].center_m = before.center_m - kStep * inwards;
    const double nearer = at(&shell.full).volume_m3;
    EXPECT_NEAR((further - nearer) / (2.0 * kStep), slope, 0.15 * std::abs(slope)) << i;
    shell.set.spheres[i] = before;
  }
}

// A trunk on the mid-plane, a bar across it and two legs.
capsule::PrimitiveSet MirroredSet() {
  capsule::PrimitiveSet set;
  set.spheres = {{{0, 1.2, 0.02}, 0.14},    {{0, 0.9, 0}, 0.12},    {{0.1, 0.8, 0.03}, 0.09},
                 {{-0.1, 0.8, 0.03}, 0.09}, {{0.15, 0.2, 0}, 0.05}, {{-0.15, 0.2, 0}, 0.05},
                 {{0.4, 1.2, 0}, 0.06},     {{-0.4, 1.2, 0}, 0.06}};
  set.capsules = {{0, 1}, {1, 2}, {1, 3}, {2, 4}, {3, 5}, {6, 7}};
  for (const int image : {0, 1, 3, 2, 5, 4, 7, 6}) {
    set.origins.push_back({body::Part::kTorso, -1, image});
  }
  return set;
}

TEST(UnionVolumeTest, HalfOfAMirroredSetTellsAll) {
  capsule::PrimitiveSet set = MirroredSet();
  const SetVariables variables(set);
  const VolumeGradient half = UnionVolumeGradient(set, variables, 0.004, 1, ThreadPool(1));
  capsule::PrimitiveSet plain = set;
  for (capsule::SphereOrigin& origin : plain.origins) origin.mirror = -1;
  const VolumeGradient whole = UnionVolumeGradient(plain, variables, 0.004, 1, ThreadPool(1));
  EXPECT_NEAR(half.volume_m3, whole.volume_m3, 2e-3 * whole.volume_m3);
  EXPECT_NEAR(half.volume_m3, ColumnVolume(set, 0.004), 0.01 * half.volume_m3);
  EXPECT_NEAR(half.area_m2, whole.area_m2, 5e-3 * whole.area_m2);
  for (std::size_t i = 0; i < set.spheres.size(); ++i) {
    EXPECT_LT((half.by_sphere[i] - whole.by_sphere[i]).norm(), 3e-3) << i;
    const auto image = static_cast<std::size_t>(set.origins[i].mirror);
    // The bar between the last two is its own image and sampled as a whole.
    if (image == i || i >= 6) continue;
    EXPECT_EQ(half.by_sphere[i].x(), -half.by_sphere[image].x()) << i;
    EXPECT_EQ(half.by_sphere[i].tail<3>(), half.by_sphere[image].tail<3>()) << i;
  }
}

// A slanting chain of spheres with short capsules, from each of which three more stick out: what
// capsules that share a sphere look like at large budgets.
capsule::PrimitiveSet BristlingChain() {
  capsule::PrimitiveSet set;
  for (int i = 0; i < 12; ++i) {
    const double at = 0.07 * i;
    set.spheres.push_back({{-0.4 + at, 0.2 + 1.6 * at, 0.02 * (i % 3)}, 0.06 + 0.01 * (i % 2)});
    const int hub = static_cast<int>(set.spheres.size()) - 1;
    if (i > 0) set.capsules.push_back({hub - 4, hub});
    for (int k = 0; k < 3; ++k) {
      const double angle = 2.1 * k + 0.4 * i;
      const Eigen::Vector3d off(0.05 * std::cos(angle), 0.0, 0.05 * std::sin(angle));
      set.spheres.push_back({set.spheres[hub].center_m + off, 0.04});
      set.capsules.push_back({hub, hub + k + 1});
    }
  }
  set.origins.resize(set.spheres.size());
  for (capsule::SphereOrigin& origin : set.origins) origin.mirror = -1;
  return set;
}

// Samples a third of the radius apart, as searches take them. Solids that run into a shared sphere
// once hid each other there: a tenth of the volume went missing, and searches made more such hubs.
TEST(UnionVolumeTest, CoarseSamplesTellTheVolumeWhereCapsulesShareSpheres) {
  capsule::PrimitiveSet set = BristlingChain();
  const SetVariables variables(set);
  const double volume = ColumnVolume(set, 0.004);
  double mean = 0.0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const double sampled = UnionVolumeGradient(set, variables, 0.02, seed, ThreadPool(1)).volume_m3;
    EXPECT_NEAR(sampled, volume, 0.03 * volume) << seed;
    mean += sampled / 16.0;
  }
  EXPECT_NEAR(mean, volume, 0.015 * volume);
}

// What a search would win by moving a pair onto the mid-plane if each capsule of one hid half of
// the other once more.
TEST(UnionVolumeTest, SpheresAtTheSamePlaceCountOnce) {
  for (const double apart_m : {0.0, 1e-5, 5e-4}) {
    capsule::PrimitiveSet set;
    set.spheres = {{{apart_m, 1, 0}, 0.15}, {{-apart_m, 1, 0}, 0.15}, {{0.3, 1.3, 0}, 0.05},
                   {{-0.3, 1.3, 0}, 0.05},  {{0.3, 0.7, 0}, 0.05},    {{-0.3, 0.7, 0}, 0.05}};
    set.origins.resize(6);
    set.capsules = {{0, 2}, {0, 4}, {1, 3}, {1, 5}};
    const SetVariables variables(set);
    const double exact = ColumnVolume(set, 0.002);
    const VolumeGradient gradient = UnionVolumeGradient(set, variables, 0.006, 1, ThreadPool(1));
    EXPECT_NEAR(gradient.volume_m3, exact, 0.005 * exact) << apart_m;
  }
}

TEST(UnionVolumeTest, TheVolumeIsTheSameFarFromTheOrigin) {
  capsule::PrimitiveSet set = BristlingChain();
  capsule::PrimitiveSet moved = set;
  for (geometry::Sphere& sphere : moved.spheres) sphere.center_m += Eigen::Vector3d(3, -2, 5);
  const SetVariables variables(set);
  const double here = UnionVolumeGradient(set, variables, 0.01, 1, ThreadPool(1)).volume_m3;
  const double there = UnionVolumeGradient(moved, variables, 0.01, 1, ThreadPool(1)).volume_m3;
  EXPECT_NEAR(here, there, 1e-9 * here);
}

TEST(UnionVolumeTest, SameBitsForAnyNumberOfThreads) {
  TubeBody body = MakeTubeBody(6, 0.0);
  const SetVariables variables(body.set);
  const VolumeGradient one = UnionVolumeGradient(body.set, variables, 0.01, 3, ThreadPool(1));
  const VolumeGradient seven = UnionVolumeGradient(body.set, variables, 0.01, 3, ThreadPool(7));
  EXPECT_EQ(one.volume_m3, seven.volume_m3);
  for (std::size_t i = 0; i < one.by_sphere.size(); ++i) {
    EXPECT_EQ(one.by_sphere[i], seven.by_sphere[i]);
  }
}

}  // namespace
}  // namespace capfit::tighten
