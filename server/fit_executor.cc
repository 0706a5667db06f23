#include "server/fit_executor.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace capfit::server {
namespace {

double NowSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

FitExecutor::FitExecutor(int concurrent_fits) : most_long_(std::max(1, concurrent_fits - 1)) {
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

FitExecutor::Ticket FitExecutor::Submit(WaitingFit fit, std::function<void()> job) {
  Ticket ticket = 0;
  {
    const std::lock_guard lock(mutex_);
    const double expected_seconds = fit.expected_seconds;
    ticket = queue_.Add(std::move(fit), NowSeconds());
    jobs_.emplace(ticket, Job{std::move(job), expected_seconds, ticket});
  }
  // All: the one that is woken might be kept from a long fit while another is not.
  wake_.notify_all();
  return ticket;
}

std::function<void()> FitExecutor::Withdraw(Ticket ticket) {
  const std::lock_guard lock(mutex_);
  if (!queue_.Remove(ticket)) return {};
  return std::move(jobs_.extract(ticket).mapped().run);
}

std::size_t FitExecutor::waiting() const {
  const std::lock_guard lock(mutex_);
  return queue_.size();
}

std::size_t FitExecutor::running() const {
  const std::lock_guard lock(mutex_);
  return running_.size();
}

double FitExecutor::ExpectedWaitSeconds(const WaitingFit& fit) const {
  const std::lock_guard lock(mutex_);
  if (queue_.size() == 0 && running_.size() < threads_.size()) return 0.0;
  const double now = NowSeconds();
  double seconds = queue_.SecondsBefore(fit, now);
  for (const auto& [ticket, end] : running_) seconds += std::max(0.0, end - now);
  return seconds / static_cast<double>(threads_.size());
}

FitExecutor::Job FitExecutor::Next() {
  std::unique_lock lock(mutex_);
  for (;;) {
    const double now = NowSeconds();
    const std::optional<Ticket> ticket = queue_.TakeNext(now, running_long_ < most_long_);
    if (ticket) {
      Job job = std::move(jobs_.extract(*ticket).mapped());
      running_.emplace(*ticket, now + job.expected_seconds);
      if (job.is_long()) ++running_long_;
      return job;
    }
    if (stopping_ && queue_.size() == 0) return {};
    wake_.wait(lock);
  }
}

void FitExecutor::Done(const Job& job) {
  {
    const std::lock_guard lock(mutex_);
    running_.erase(job.ticket);
    if (job.is_long()) --running_long_;
  }
  if (job.is_long()) wake_.notify_all();
}

void FitExecutor::Work() {
  for (Job job = Next(); job.run; job = Next()) {
    job.run();
    Done(job);
  }
}

}  // namespace capfit::server
