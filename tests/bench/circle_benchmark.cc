// How long the hot functions of core/circle take, and how they grow with the outline.
#include <benchmark/benchmark.h>

#include <vector>

#include "core/circle/approximate_polygon.h"
#include "core/circle/circle_outside_area.h"
#include "core/circle/partition.h"
#include "core/circle/sample_points.h"
#include "tests/core/circle/outlines.h"

namespace capfit::circle {
namespace {

void BM_CircleOutsideArea(benchmark::State& state) {
  Random random(1);
  const section::Polygon outline = MirroredTrunk(random, static_cast<int>(state.range(0)), 0.1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(CircleOutsideAreaWithGradient({{0.03, 0.01}, 0.12}, outline));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));  // vertices per second
  state.SetComplexityN(state.range(0));
}
BENCHMARK(BM_CircleOutsideArea)->RangeMultiplier(4)->Range(16, 4096)->Complexity(benchmark::oN);

void BM_Partition(benchmark::State& state) {
  Random random(2);
  const section::Polygon outline = MirroredTrunk(random, 64, 0.1);
  std::vector<Eigen::Vector2d> points(outline.vertices().begin(), outline.vertices().end());
  const std::vector<Eigen::Vector2d> interior = InteriorPoints(outline, 100);
  points.insert(points.end(), interior.begin(), interior.end());
  std::vector<Seed> seeds;
  for (int i = 0; i < state.range(0); ++i) {
    seeds.push_back({{random.NextIn(-0.15, 0.15), random.NextIn(-0.08, 0.08)}, Place::kFree});
  }
  for (auto _ : state) benchmark::DoNotOptimize(Partition(points, seeds, outline));
}
BENCHMARK(BM_Partition)->DenseRange(2, 8, 2);

void ApproximateTrunk(benchmark::State& state, bool symmetric) {
  Random random(3);
  const section::FeaturePolygon polygon = AsFeature(MirroredTrunk(random, 128, 0.1));
  CircleOptions options;
  options.symmetric = symmetric;
  const NullObserver observer;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        ApproximatePolygon(polygon, static_cast<int>(state.range(0)), options, observer));
  }
}
void BM_ApproximatePolygon(benchmark::State& state) { ApproximateTrunk(state, false); }
BENCHMARK(BM_ApproximatePolygon)->DenseRange(1, 8)->Unit(benchmark::kMicrosecond);
void BM_ApproximateMirroredPolygon(benchmark::State& state) { ApproximateTrunk(state, true); }
BENCHMARK(BM_ApproximateMirroredPolygon)->DenseRange(1, 8)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace capfit::circle

BENCHMARK_MAIN();
