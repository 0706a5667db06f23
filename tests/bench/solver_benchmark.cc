// How long the programme of a tightening step takes: rows, and one thread beside two.
#include <benchmark/benchmark.h>

#include "core/base/random.h"
#include "core/base/thread_pool.h"
#include "core/tighten/penalty_program.h"

namespace capfit::tighten {
namespace {

constexpr int kGroups = 42;  // of variables: 128 primitives of a mirrored body
constexpr int kRowsInBatch = 64;

// Spheres in a row, tied by capsules, that shrink until points hold them.
PenaltyProgram Chain(int rows) {
  Random random(11);
  PenaltyProgram program;
  program.gradient = Eigen::VectorXd::Zero(4 * kGroups);
  for (int g = 0; g < kGroups; ++g) program.gradient[4 * g + 3] = random.NextIn(0.5, 1.5);
  program.hessian = Eigen::VectorXd::Constant(4 * kGroups, 0.1);
  program.lower = Eigen::VectorXd::Constant(4 * kGroups, -0.01);
  program.upper = Eigen::VectorXd::Constant(4 * kGroups, 0.01);
  for (int i = 0; i < rows; ++i) {
    if (i % kRowsInBatch == 0) program.batches.emplace_back().penalty_factor = 100.0 / rows;
    const int a = static_cast<int>(i * std::int64_t{kGroups} / rows);
    const double t = a + 1 < kGroups ? random.NextUnit() : 0.0;
    const Eigen::Vector3d normal =
        Eigen::Vector3d(random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(-1, 1))
            .normalized();
    PenaltyRow row;
    row.first = {4 * a, a + 1 < kGroups ? 4 * (a + 1) : -1};
    for (int c = 0; c < 4; ++c) {
      const double speed = c < 3 ? normal[c] : 1.0;
      row.coefficients[c] = -(1.0 - t) * speed;
      row.coefficients[c + 4] = -t * speed;
    }
    row.value = random.NextIn(-0.015, 0.003);
    program.batches.back().rows.push_back(row);
  }
  return program;
}

void SolveTo(benchmark::State& state, const struct SolveTo& to) {
  const PenaltyProgram program = Chain(static_cast<int>(state.range(0)));
  const ThreadPool pool(static_cast<int>(state.range(1)));
  PenaltySolver solver(pool);
  for (auto _ : state) benchmark::DoNotOptimize(solver.Solve(program, to));
}
void BM_SolveRoughly(benchmark::State& state) {
  SolveTo(state, {.relative_gap = 0.05, .most_iterations = 8});
}
void BM_SolveToCentre(benchmark::State& state) { SolveTo(state, {.centrality = 1e-3}); }
void BM_SolveFully(benchmark::State& state) { SolveTo(state, {}); }

void RowsAndThreads(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"rows", "threads"})->UseRealTime()->Unit(benchmark::kMicrosecond);
  for (const int rows : {1000, 2000, 4000, 8000, 16000}) {
    for (const int threads : {1, 2}) benchmark->Args({rows, threads});
  }
}
BENCHMARK(BM_SolveRoughly)->Apply(RowsAndThreads);
BENCHMARK(BM_SolveToCentre)->Apply(RowsAndThreads);
BENCHMARK(BM_SolveFully)->Apply(RowsAndThreads);

}  // namespace
}  // namespace capfit::tighten

BENCHMARK_MAIN();
