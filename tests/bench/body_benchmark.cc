// The whole body room on mannequins of growing density: must grow no faster than n log n.
#include <benchmark/benchmark.h>

#include "core/body/find_body.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"

namespace capfit::body {
namespace {

void BM_FindBody(benchmark::State& state) {
  mannequin::MannequinOptions options;
  options.faces = static_cast<int>(state.range(0));
  options.quads = false;
  const auto soup = mannequin::MakeMannequin(options);
  const auto prepared = mesh::PrepareMesh(*soup);
  const ThreadPool pool(1);
  const NullObserver observer;
  for (auto _ : state) {
    benchmark::DoNotOptimize(FindBody(prepared->mesh, {}, pool, observer));
  }
  const auto triangles = static_cast<std::int64_t>(prepared->mesh.triangles().size());
  state.SetItemsProcessed(state.iterations() * triangles);
  state.SetComplexityN(triangles);
}
BENCHMARK(BM_FindBody)
    ->Unit(benchmark::kMillisecond)
    ->Arg(5'000)
    ->Arg(16'000)
    ->Arg(64'000)
    ->Arg(200'000)
    ->Complexity(benchmark::oNLogN);

}  // namespace
}  // namespace capfit::body

BENCHMARK_MAIN();
