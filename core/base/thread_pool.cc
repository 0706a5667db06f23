#include "core/base/thread_pool.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

namespace capfit {
namespace {

int EffectiveThreads(int threads) {
  if (threads > 0) return threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// oneTBB hands out no more workers than a process-wide limit, which defaults to the number of
// cores. Lifted once, so that "7 threads" means seven on any machine; arenas set the real shares.
void LiftProcessLimit() {
  static const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 256);
}

#ifdef CAPFIT_POOL_OF_STD_THREADS
// ThreadSanitizer cannot see how the packaged oneTBB hands work over and would call every loop a
// race. Under it, the same chunks run on threads whose start and end it understands.
void RunOnStdThreads(int threads, std::size_t chunks, const std::function<void(std::size_t)>& run) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < chunks; i = next++) run(i);
  };
  std::vector<std::thread> helpers;
  for (int i = 1; i < threads; ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
}
#endif

}  // namespace

struct ThreadPool::Arena {
  explicit Arena(int threads) : arena(threads, /*reserved_for_masters=*/1) {}
  tbb::task_arena arena;
};

ThreadPool::ThreadPool(int threads)
    : arena_(std::make_unique<Arena>(EffectiveThreads(threads))),
      threads_(EffectiveThreads(threads)) {
  LiftProcessLimit();
}

ThreadPool::~ThreadPool() = default;

void ThreadPool::ForEach(std::size_t count, const std::function<void(std::size_t)>& body) const {
  ForChunks(count, 1, [&body](std::size_t begin, std::size_t) { body(begin); });
}

void ThreadPool::ForChunks(std::size_t count, std::size_t chunk,
                           const std::function<void(std::size_t, std::size_t)>& body) const {
  const std::size_t chunks = (count + chunk - 1) / chunk;
  const auto run = [&](std::size_t index) {
    body(index * chunk, std::min(count, (index + 1) * chunk));
  };
  if (threads_ == 1 || chunks <= 1) {
    for (std::size_t i = 0; i < chunks; ++i) run(i);
    return;
  }
#ifdef CAPFIT_POOL_OF_STD_THREADS
  RunOnStdThreads(threads_, chunks, run);
#else
  // Begun in order, whichever of oneTBB's tasks comes to run: where the longest come first, the
  // last ones are short, and no thread is left alone with a long one.
  std::atomic<std::size_t> next = 0;
  const auto run_next = [&](std::size_t) { run(next.fetch_add(1, std::memory_order_relaxed)); };
  arena_->arena.execute(
      [&] { tbb::parallel_for(std::size_t{0}, chunks, run_next, tbb::simple_partitioner()); });
#endif
}

}  // namespace capfit
