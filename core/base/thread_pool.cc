#include "core/base/thread_pool.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "core/base/available_cores.h"

namespace capfit {
namespace {

int EffectiveThreads(int threads) { return threads > 0 ? threads : AvailableCores(); }

// The chunks of a loop, dealt among the threads: each begins with the same part of an array in loop
// after loop, which its own cache still holds, and helps the others when it is done.
class DealtChunks {
 public:
  DealtChunks(std::size_t chunks, std::size_t threads)
      : chunks_(chunks), hands_(std::min(threads, kMostHands)) {
    for (std::size_t i = 0; i < hands_; ++i) next_[i].chunk = i * chunks_ / hands_;
  }

  // To be called once for each chunk, by any thread.
  std::size_t NextFor(std::size_t thread) {
    for (std::size_t hand = thread % hands_;; hand = hand + 1 < hands_ ? hand + 1 : 0) {
      const std::size_t next = next_[hand].chunk.fetch_add(1, std::memory_order_relaxed);
      if (next < EndOf(hand)) return next;
    }
  }

 private:
  static constexpr std::size_t kMostHands = 16;
  struct alignas(64) Next {  // a cache line of its own
    std::atomic<std::size_t> chunk = 0;
  };

  [[nodiscard]] std::size_t EndOf(std::size_t hand) const { return (hand + 1) * chunks_ / hands_; }

  std::size_t chunks_;
  std::size_t hands_;
  std::array<Next, kMostHands> next_;
};

// oneTBB hands out no more workers than a process-wide limit, which defaults to the number of
// cores. Lifted once, so that "7 threads" means seven on any machine; arenas set the real shares.
void LiftProcessLimit() {
  static const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 256);
}

#ifdef CAPFIT_POOL_OF_STD_THREADS
// ThreadSanitizer cannot see how the packaged oneTBB hands work over and would call every loop a
// race. Under it, the same chunks run on threads whose start and end it understands.
void RunOnStdThreads(int threads, std::size_t count, const std::function<void(std::size_t)>& run) {
  std::atomic<std::size_t> begun = 0;
  const auto work = [&](int thread) {
    while (begun++ < count) run(static_cast<std::size_t>(thread));
  };
  std::vector<std::thread> helpers;
  for (int i = 1; i < threads; ++i) helpers.emplace_back(work, i);
  work(0);
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
#ifndef CAPFIT_POOL_OF_STD_THREADS
  // oneTBB starts threads when they are first asked for: now, so that no loop waits for them.
  if (threads_ > 1) arena_->arena.enqueue([] {});
#endif
}

ThreadPool::~ThreadPool() = default;

bool ThreadPool::Helps(std::size_t count) const {
  return count > 1 && threads_ > 1 && jobs_.load(std::memory_order_relaxed) < threads_;
}

template <typename Run>
void ThreadPool::RunSideBySide(std::size_t count, const Run& run) const {
#ifdef CAPFIT_POOL_OF_STD_THREADS
  RunOnStdThreads(threads_, count, run);
#else
  const auto run_one = [&](std::size_t) {
    run(static_cast<std::size_t>(tbb::this_task_arena::current_thread_index()));
  };
  arena_->arena.execute(
      [&] { tbb::parallel_for(std::size_t{0}, count, run_one, tbb::simple_partitioner()); });
#endif
}

void ThreadPool::ForEach(std::size_t count, const std::function<void(std::size_t)>& body) const {
  if (!Helps(count)) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  // Begun in order, whichever of oneTBB's tasks comes to run: where the longest come first, the
  // last ones are short, and no thread is left alone with a long one.
  std::atomic<std::size_t> next = 0;
  RunSideBySide(count, [&](std::size_t) { body(next.fetch_add(1, std::memory_order_relaxed)); });
}

void ThreadPool::ForChunks(std::size_t count, std::size_t chunk,
                           const std::function<void(std::size_t, std::size_t)>& body) const {
  const std::size_t chunks = (count + chunk - 1) / chunk;
  const auto run = [&](std::size_t index) {
    body(index * chunk, std::min(count, (index + 1) * chunk));
  };
  if (!Helps(chunks)) {
    for (std::size_t i = 0; i < chunks; ++i) run(i);
    return;
  }
  DealtChunks dealt(chunks, static_cast<std::size_t>(threads_));
  RunSideBySide(chunks, [&](std::size_t thread) { run(dealt.NextFor(thread)); });
}

}  // namespace capfit
