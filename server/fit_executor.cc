#include "server/fit_executor.h"

#include <utility>

namespace capfit::server {

FitExecutor::FitExecutor(int concurrent_fits, int queued_fits)
    : place_count_(concurrent_fits + queued_fits) {
  for (int i = 0; i < concurrent_fits; ++i) threads_.emplace_back([this] { Work(); });
}

FitExecutor::~FitExecutor() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

FitExecutor::Place FitExecutor::TryTakePlace() {
  int taken = taken_.load();
  while (taken < place_count_) {
    if (taken_.compare_exchange_weak(taken, taken + 1)) {
      return {&taken_, [](std::atomic<int>* count) { count->fetch_sub(1); }};
    }
  }
  return nullptr;
}

void FitExecutor::Submit(std::function<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  wake_.notify_one();
}

void FitExecutor::Work() {
  for (;;) {
    std::function<void()> job;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
      if (jobs_.empty()) return;
      job = std::move(jobs_.front());
      jobs_.pop_front();
    }
    job();
  }
}

}  // namespace capfit::server
