#include "core/refine/best_fit/boundary_integral.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/tighten/union_volume.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

// By the other sampler of unions, finely; with equal seeds its errors are alike.
double VolumeOf(capsule::PrimitiveSet set) {
  const tighten::SetVariables variables(set);
  const ThreadPool alone(1);
  return tighten::UnionVolumeGradient(set, variables, 0.002, /*seed=*/1, alone).volume_m3;
}

TEST(BoundaryIntegralTest, ABallGrowsByItsSurfaceAndDoesNotCareWhereItIs) {
  capsule::MirroredSet graph;
  graph.AddSphere({{0.1, 0.2, 0.3}, 0.1}, false);
  const BoundaryIntegral b = IntegrateBoundary(graph, ConesOf(graph), {0.01, 0.3});
  const double surface = 4.0 * std::numbers::pi * 0.01;
  EXPECT_NEAR(b.area_m2[0], surface, 1e-9);
  EXPECT_NEAR(b.gradient_m2[0][3], surface, 1e-6);
  EXPECT_NEAR(b.gradient_m2[0].head<3>().norm(), 0.0, 0.02 * surface);
}

TEST(BoundaryIntegralTest, AHiddenBallHasNoGradient) {
  capsule::MirroredSet graph = LeggedGraph(false);
  graph.AddSphere({{0.0, 1.2, 0.01}, 0.05}, false);
  const BoundaryIntegral b = IntegrateBoundary(graph, ConesOf(graph), {});
  EXPECT_EQ(b.area_m2.back(), 0.0);
}

// The mean over many draws of samples, against differences of finely measured volumes.
TEST(BoundaryIntegralTest, GradientMatchesFiniteDifferencesOfVolume) {
  for (const bool symmetric : {false, true}) {
    const capsule::MirroredSet graph = LeggedGraph(symmetric);
    std::vector<Eigen::Vector4d> mean(graph.spheres().size(), Eigen::Vector4d::Zero());
    constexpr int kDraws = 40;
    for (int k = 0; k < kDraws; ++k) {
      const double phase = (k + 0.5) / kDraws;
      const BoundaryIntegral b = IntegrateBoundary(graph, ConesOf(graph), {0.006, phase});
      for (std::size_t v = 0; v < mean.size(); ++v) mean[v] += b.gradient_m2[v] / kDraws;
    }
    for (int v = 0; v < graph.sphere_count(); ++v) {
      if (!graph.IsRepresentative(v)) continue;
      for (int k = graph.IsOnPlane(v) ? 1 : 0; k < 4; ++k) {
        const auto volume = [&](double step) {
          capsule::MirroredSet moved = graph;
          geometry::Sphere& node = moved.sphere(v);
          if (k < 3) node.center_m[k] += step;
          if (k == 3) node.radius_m += step;
          moved.CopyToImages();
          return VolumeOf(moved.set());
        };
        const double difference = (volume(2e-3) - volume(-2e-3)) / 4e-3;
        EXPECT_NEAR(mean[static_cast<std::size_t>(v)][k], difference,
                    2e-3 + 0.03 * std::abs(difference))
            << "node " << v << " variable " << k << " symmetric " << symmetric;
      }
    }
  }
}

TEST(BoundaryIntegralTest, OnlyActiveNodesAreSampled) {
  const capsule::MirroredSet graph = LeggedGraph(false);
  std::vector<char> active(4, 0);
  active[3] = 1;
  BoundaryOptions options;
  options.active = &active;
  const BoundaryIntegral some = IntegrateBoundary(graph, ConesOf(graph), options);
  const BoundaryIntegral all = IntegrateBoundary(graph, ConesOf(graph), {});
  EXPECT_EQ(some.gradient_m2[3], all.gradient_m2[3]);
  EXPECT_EQ(some.area_m2[0], 0.0);
}

}  // namespace
}  // namespace capfit::refine
