#include "core/base/backlog.h"

#include <algorithm>
#include <atomic>
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
  std::atomic<bool> has_ended = false;
  pool_.ForEach(2, [&](std::size_t half) {
    if (half == 0) {
      work();
      has_ended = true;
      return;
    }
    while (!has_ended && HasMore()) loops_.front().step(next_++);
  });
}

void Backlog::Finish() {
  while (HasMore()) {
    const Loop& loop = loops_.front();
    const std::size_t first = std::exchange(next_, loop.count);
    pool_.ForEach(loop.count - first, [&](std::size_t i) { loop.step(first + i); });
  }
}

}  // namespace capfit
