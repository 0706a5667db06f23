// Mesh preparation and the whole body room on mannequins of growing density: together they must
// stay below 40 ms for 64k triangles on one core, and grow no faster than n log n.
#include <benchmark/benchmark.h>

#include "core/body/find_body.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"

namespace capfit::body {
namespace {

mesh::PolygonSoup Mannequin(std::int64_t faces) {
  mannequin::MannequinOptions options;
  options.faces = static_cast<int>(faces);
  options.quads = false;
  return *mannequin::MakeMannequin(options);
}

void CountTriangles(std::int64_t triangles, benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * triangles);
  state.SetComplexityN(triangles);
}

void BM_PrepareMesh(benchmark::State& state) {
  const mesh::PolygonSoup soup = Mannequin(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(mesh::PrepareMesh(soup));
  CountTriangles(static_cast<std::int64_t>(soup.face_vertices.size() / 3), state);
}

void BM_FindBody(benchmark::State& state) {
  const auto prepared = mesh::PrepareMesh(Mannequin(state.range(0)));
  const ThreadPool pool(1);
  const NullObserver observer;
  for (auto _ : state) benchmark::DoNotOptimize(FindBody(prepared->mesh, {}, pool, observer));
  CountTriangles(static_cast<std::int64_t>(prepared->mesh.triangles().size()), state);
}

void BM_Both(benchmark::State& state) {
  const mesh::PolygonSoup soup = Mannequin(state.range(0));
  const ThreadPool pool(1);
  const NullObserver observer;
  for (auto _ : state) {
    const auto prepared = mesh::PrepareMesh(soup);
    benchmark::DoNotOptimize(FindBody(prepared->mesh, {}, pool, observer));
  }
  CountTriangles(static_cast<std::int64_t>(soup.face_vertices.size() / 3), state);
}

void Sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Unit(benchmark::kMillisecond);
  for (const int faces : {5'000, 16'000, 64'000, 200'000}) benchmark->Arg(faces);
  benchmark->Complexity(benchmark::oNLogN);
}
BENCHMARK(BM_PrepareMesh)->Apply(Sizes);
BENCHMARK(BM_FindBody)->Apply(Sizes);
BENCHMARK(BM_Both)->Apply(Sizes);

}  // namespace
}  // namespace capfit::body

BENCHMARK_MAIN();
