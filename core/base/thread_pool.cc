#include "core/base/thread_pool.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <thread>

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
  arena_->arena.execute(
      [&] { tbb::parallel_for(std::size_t{0}, chunks, run, tbb::simple_partitioner()); });
}

}  // namespace capfit
