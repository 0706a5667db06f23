// Mesh preparation and the whole body room on mannequins of growing density: together they must
// stay below 40 ms for 64k triangles on one core, and grow no faster than n log n.
//
// BM_Call does what a call does in a process of its own: the memory is given back to the system in
// between, so that every page is touched for the first time again. With CAPFIT_BENCHMARK_MESH set
// to the path of a mesh, BM_Call/0 takes that in place of a mannequin: a real body has more
// fingers and toes.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <cstdlib>

#include "core/body/find_body.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/bench/read_body.h"

namespace capfit::body {
namespace {

formats::PolygonSoup Mannequin(std::int64_t faces) {
  mannequin::MannequinOptions options;
  options.faces = static_cast<int>(faces);
  options.quads = false;
  return *mannequin::MakeMannequin(options);
}

formats::PolygonSoup NamedMesh() {
  const char* const named = std::getenv("CAPFIT_BENCHMARK_MESH");
  if (named == nullptr) return Mannequin(64'000);
  return bench::ReadBodyOrExit(named);
}

void CountTriangles(std::int64_t triangles, benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * triangles);
  state.SetComplexityN(triangles);
}

void BM_PrepareMesh(benchmark::State& state) {
  const formats::PolygonSoup soup = Mannequin(state.range(0));
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
  const formats::PolygonSoup soup = Mannequin(state.range(0));
  const ThreadPool pool(1);
  const NullObserver observer;
  for (auto _ : state) {
    const auto prepared = mesh::PrepareMesh(soup);
    benchmark::DoNotOptimize(FindBody(prepared->mesh, {}, pool, observer));
  }
  CountTriangles(static_cast<std::int64_t>(soup.face_vertices.size() / 3), state);
}

void BM_Call(benchmark::State& state) {
  const formats::PolygonSoup soup = state.range(0) > 0 ? Mannequin(state.range(0)) : NamedMesh();
  const ThreadPool pool(1);
  const NullObserver observer;
  for (auto _ : state) {
    state.PauseTiming();
    malloc_trim(0);
    state.ResumeTiming();
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
BENCHMARK(BM_Call)->Unit(benchmark::kMillisecond)->Arg(0)->Arg(64'000);

}  // namespace
}  // namespace capfit::body

BENCHMARK_MAIN();
