// core/solid: one surface of many shells, at most 40 ms for 64k triangles on two threads, and
// growth with the triangles; and telling floors of scans apart.
//
// The shells are a mannequin and a second one, a little larger, without head, hands and feet: its
// clothes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "core/mannequin/mannequin.h"
#include "core/solid/make_solid.h"
#include "core/solid/scan_parts.h"

namespace capfit::solid {
namespace {

struct Shells {
  std::vector<Eigen::Vector3d> positions;
  std::vector<mesh::Triangle> triangles;
};

void Add(const mannequin::MannequinOptions& options, double scale, Shells& shells) {
  const formats::PolygonSoup soup = *mannequin::MakeMannequin(options);
  const auto first = static_cast<std::uint32_t>(shells.positions.size());
  for (const Eigen::Vector3d& p : soup.positions) {
    shells.positions.emplace_back(scale * p.x(), p.y(), scale * p.z());
  }
  for (std::size_t f = 0; f < soup.face_vertices.size() / 3; ++f) {
    const std::uint32_t* const c = soup.face_vertices.data() + 3 * f;
    shells.triangles.push_back({c[0] + first, c[1] + first, c[2] + first});
  }
}

// About as many triangles as asked for.
Shells Dressed(std::int64_t triangles) {
  Shells shells;
  mannequin::MannequinOptions options;
  options.quads = false;
  options.faces = static_cast<int>(triangles / 2);
  Add(options, 1.0, shells);
  options.with_head = options.with_hands = options.with_feet = false;
  Add(options, 1.08, shells);
  return shells;
}

void BM_MakeSolid(benchmark::State& state) {
  const Shells shells = Dressed(state.range(0));
  const ThreadPool pool(static_cast<int>(state.range(1)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(MakeSolid(shells.positions, shells.triangles, {}, pool));
  }
  state.SetComplexityN(static_cast<std::int64_t>(shells.triangles.size()));
}

// As many squares as there are triangles, so that the result is as fine as the input.
void BM_MakeFineSolid(benchmark::State& state) {
  const Shells shells = Dressed(state.range(0));
  const ThreadPool pool(2);
  const SolidOptions options = {shells.triangles.size()};
  for (auto _ : state) {
    benchmark::DoNotOptimize(MakeSolid(shells.positions, shells.triangles, options, pool));
  }
  state.SetComplexityN(static_cast<std::int64_t>(shells.triangles.size()));
}

void BM_FindScanParts(benchmark::State& state) {
  const Shells shells = Dressed(state.range(0));
  const ThreadPool pool(2);
  const NullObserver observer;
  for (auto _ : state) {
    benchmark::DoNotOptimize(FindScanParts(shells.positions, shells.triangles, observer));
  }
  state.SetComplexityN(static_cast<std::int64_t>(shells.triangles.size()));
}

BENCHMARK(BM_MakeSolid)
    ->ArgsProduct({{16'000, 64'000, 256'000}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_MakeFineSolid)
    ->Arg(16'000)
    ->Arg(64'000)
    ->Arg(256'000)
    ->Arg(900'000)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oN);
BENCHMARK(BM_FindScanParts)
    ->Arg(16'000)
    ->Arg(64'000)
    ->Arg(256'000)
    ->Arg(900'000)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oN);

}  // namespace
}  // namespace capfit::solid

BENCHMARK_MAIN();
