// core/skinning: weights of 64 centres in both forms, on one thread, and applying the sparse ones.
#include <benchmark/benchmark.h>

#include <vector>

#include "core/body/find_body.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "core/skinning/sparse_weights.h"

namespace capfit::skinning {
namespace {

constexpr std::size_t kCenters = 64;

// A mannequin in the body frame, and centres along the middles of its limbs and trunk.
struct Subject {
  body::Body body;
  std::vector<Eigen::Vector3d> centers;
  std::vector<std::uint8_t> parts;
};

Subject Make(std::int64_t faces) {
  mannequin::MannequinOptions options;
  options.faces = static_cast<int>(faces);
  options.quads = false;
  const auto prepared = mesh::PrepareMesh(*mannequin::MakeMannequin(options));
  const ThreadPool pool(1);
  const NullObserver observer;
  Subject subject{*body::FindBody(prepared->mesh, {}, pool, observer), {}, {}};
  for (std::size_t i = 0; subject.centers.size() < kCenters; ++i) {
    const auto& chain = subject.body.chains[i % body::kChainCount];
    if (!chain) continue;
    const double share = static_cast<double>(i) / kCenters - static_cast<int>(i / kCenters);
    subject.centers.push_back(chain->PointAt(share * chain->length_m()));
  }
  for (const body::Segment segment : subject.body.vertex_segments) {
    subject.parts.push_back(static_cast<std::uint8_t>(segment));
  }
  return subject;
}

void BM_Dense(benchmark::State& state) {
  const Subject subject = Make(state.range(0));
  const ThreadPool pool(1);
  const NullObserver observer;
  for (auto _ : state) {
    benchmark::DoNotOptimize(MeanValueWeights(subject.body.mesh, subject.centers, pool, observer));
  }
}

void BM_Sparse(benchmark::State& state) {
  const Subject subject = Make(state.range(0));
  const ThreadPool pool(1);
  const NullObserver observer;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        SparseMeanValueWeights(subject.body.mesh, subject.centers, pool, observer, subject.parts));
  }
}

void BM_ApplySparse(benchmark::State& state) {
  const Subject subject = Make(state.range(0));
  const SparseWeights weights = SparseMeanValueWeights(
      subject.body.mesh, subject.centers, ThreadPool(1), NullObserver(), subject.parts);
  const std::vector<Eigen::Vector3d> vertices(weights.vertex_count, Eigen::Vector3d(1, 2, 3));
  for (auto _ : state) benchmark::DoNotOptimize(Apply(weights, vertices));
  state.counters["weights"] = static_cast<double>(weights.weights.size());
}

BENCHMARK(BM_Dense)->Arg(10'000)->Arg(25'000)->Arg(64'000)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Sparse)->Arg(10'000)->Arg(25'000)->Arg(64'000)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_ApplySparse)->Arg(25'000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace capfit::skinning

BENCHMARK_MAIN();
