#include "core/base/backlog.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>

namespace capfit {

Backlog::Backlog(const ThreadPool& pool, const FitObserver& observer)
    : pool_(pool), observer_(observer) {}

void Backlog::Add(std::size_t count, std::function<void(std::size_t)> step) {
  loops_.push_back({count, std::move(step)});
}

void Backlog::AddChunks(std::size_t count, std::size_t chunk,
                        std::function<void(std::size_t, std::size_t)> step) {
  Add((count + chunk - 1) / chunk, [count, chunk, step = std::move(step)](std::size_t i) {
    step(i * chunk, std::min(count, (i + 1) * chunk));
  });
}

bool Backlog::HasMore() {
  if (observer_.IsCancelled()) loops_.clear();
  while (!loops_.empty() && next_ >= loops_.front().count) {
    loops_.pop_front();
    next_ = 0;
  }
  return !loops_.empty();
}

void Backlog::Beside(const std::function<void()>& work) {
  if (pool_.threads() == 1 || !HasMore()) return work();
  const std::thread::id caller = std::this_thread::get_id();
  bool has_begun = false;  // known to the caller's thread alone
  std::atomic<bool> has_filler = false;
  std::atomic<bool> has_ended = false;
  const auto run_work = [&] {
    has_begun = true;
    work();
    has_ended = true;
  };
  pool_.ForEach(2, [&](std::size_t) {
    if (std::this_thread::get_id() == caller && !has_begun) return run_work();
    if (has_filler.exchange(true)) return;
    while (!has_ended && HasMore()) loops_.front().step(next_++);
  });
  if (!has_begun) run_work();  // others had taken both turns
}

void Backlog::Finish() {
  while (HasMore()) {
    const Loop& loop = loops_.front();
    const std::size_t first = std::exchange(next_, loop.count);
    pool_.ForEach(loop.count - first, [&](std::size_t i) { loop.step(first + i); });
  }
}

}  // namespace capfit
