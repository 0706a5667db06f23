#include "core/refine/best_fit/boundary_integral.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

// By cells, each filled by how deep its middle lies in the union, over one cell's width: flat
// surfaces come out exact.
double VolumeOf(const capsule::MirroredSet& graph) {
  constexpr double kCellM = 0.004;
  const Eigen::Array3i count(110, 350, 90);
  const Eigen::Array3d low(-0.22, 0.05, -0.18);
  std::vector<float> deepest(static_cast<std::size_t>(count.prod()), -1.0f);
  for (const Cone& cone : ConesOf(graph)) {
    std::size_t cell = 0;
    for (int j = 0; j < count[1]; ++j) {
      for (int i = 0; i < count[0]; ++i) {
        for (int k = 0; k < count[2]; ++k, ++cell) {
          const Eigen::Array3f p = (low + kCellM * (Eigen::Array3d(i, j, k) + 0.5)).cast<float>();
          deepest[cell] = std::max(deepest[cell], -cone.SignedDistance(p[0], p[1], p[2]));
        }
      }
    }
  }
  double cells = 0.0;
  for (const float depth : deepest) cells += std::clamp(0.5 + depth / kCellM, 0.0, 1.0);
  return cells * kCellM * kCellM * kCellM;
}

TEST(BoundaryIntegralTest, ABallGrowsByItsSurfaceAndDoesNotCareWhereItIs) {
  capsule::MirroredSet graph;
  graph.AddSphere({{0.1, 0.2, 0.3}, 0.1}, false);
  const BoundaryIntegral b = IntegrateBoundary(graph, {0.01}, 0.3);
  const double surface = 4.0 * std::numbers::pi * 0.01;
  EXPECT_NEAR(b.area_m2[0], surface, 1e-9);
  EXPECT_NEAR(b.gradient_m2[0][3], surface, 1e-6);
  EXPECT_NEAR(b.gradient_m2[0].head<3>().norm(), 0.0, 0.02 * surface);
}

TEST(BoundaryIntegralTest, AHiddenBallHasNoGradient) {
  capsule::MirroredSet graph = LeggedGraph(false);
  graph.AddSphere({{0.0, 1.2, 0.01}, 0.05}, false);
  const BoundaryIntegral b = IntegrateBoundary(graph, {}, 0.5);
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
      const BoundaryIntegral b = IntegrateBoundary(graph, {0.006}, phase);
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
          return VolumeOf(moved);
        };
        const double difference = (volume(2e-3) - volume(-2e-3)) / 4e-3;
        EXPECT_NEAR(mean[v][k], difference, 2e-3 + 0.03 * std::abs(difference))
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
  const BoundaryIntegral some = IntegrateBoundary(graph, options, 0.5);
  const BoundaryIntegral all = IntegrateBoundary(graph, {}, 0.5);
  EXPECT_EQ(some.gradient_m2[3], all.gradient_m2[3]);
  EXPECT_EQ(some.area_m2[0], 0.0);
}

}  // namespace
}  // namespace capfit::refine
