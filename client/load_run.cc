#include "client/load_run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "core/base/random.h"

namespace capfit::client {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLate{10};

double Seconds(Clock::duration time) { return std::chrono::duration<double>(time).count(); }

class LoadRun {
 public:
  LoadRun(const std::vector<LoadBody>& bodies, const LoadPlan& plan, const LoadCall& call)
      : bodies_(bodies), plan_(plan), call_(call), first_results_(bodies.size()) {
    tally_.by_body.resize(bodies.size());
  }

  LoadTally Run() {
    std::vector<std::thread> clients;
    for (int i = 0; i < plan_.clients; ++i) clients.emplace_back([this] { Work(); });
    for (std::thread& client : clients) client.join();
    tally_.seconds = Seconds(Clock::now() - begin_);
    return std::move(tally_);
  }

 private:
  // Calls are numbered; which body a call has and when it is due follows from its number alone.
  void Work() {
    for (;;) {
      const std::int64_t number = next_call_++;
      const Clock::time_point due = DueTime(number);
      if (Seconds(due - begin_) >= plan_.seconds) return;
      std::this_thread::sleep_until(due);
      const bool is_late = Clock::now() - due > kLate;
      const std::size_t body = BodyOf(number);
      const LoadAnswer answer = call_(bodies_[body]);
      Count(body, answer, Seconds(Clock::now() - due), is_late);
    }
  }

  Clock::time_point DueTime(std::int64_t number) const {
    if (plan_.rate <= 0.0) return Clock::now();
    const std::chrono::duration<double> since(static_cast<double>(number) / plan_.rate);
    return begin_ + std::chrono::duration_cast<Clock::duration>(since);
  }

  std::size_t BodyOf(std::int64_t number) const {
    Random random(plan_.seed * 0x9E3779B97F4A7C15ull + static_cast<std::uint64_t>(number));
    return static_cast<std::size_t>(random.NextBelow(bodies_.size()));
  }

  void Count(std::size_t body, const LoadAnswer& answer, double seconds, bool is_late) {
    const std::lock_guard lock(mutex_);
    const std::string code = absl::StatusCodeToString(answer.status.code());
    ++tally_.codes[code];
    if (is_late) ++tally_.late_calls;
    if (answer.status.ok()) {
      tally_.answered.Add(seconds);
      tally_.by_body[body].Add(seconds);
      CountResult(body, answer);
      return;
    }
    tally_.refused.Add(seconds);
    tally_.first_message.try_emplace(code, answer.status.message());
    if (absl::IsResourceExhausted(answer.status) && !answer.has_pushback) {
      ++tally_.refused_without_pushback;
    }
  }

  void CountResult(std::size_t body, const LoadAnswer& answer) {
    tally_.bytes_sent += static_cast<std::int64_t>(bodies_[body].bytes.size());
    tally_.bytes_received += answer.bytes;
    if (answer.result.empty()) ++tally_.empty_results;
    std::string& first = first_results_[body];
    if (first.empty()) first = answer.result;
    if (answer.result != first) ++tally_.differing_results;
  }

  const std::vector<LoadBody>& bodies_;
  const LoadPlan& plan_;
  const LoadCall& call_;
  const Clock::time_point begin_ = Clock::now();
  std::atomic<std::int64_t> next_call_{0};
  std::mutex mutex_;
  std::vector<std::string> first_results_;
  LoadTally tally_;
};

}  // namespace

bool LoadTally::IsGood(bool strict) const {
  if (empty_results + differing_results + refused_without_pushback > 0) return false;
  for (const auto& [code, count] : codes) {
    const bool may_be = code == "OK" || (!strict && code == "RESOURCE_EXHAUSTED");
    if (!may_be) return false;
  }
  return answered.count() > 0;
}

LoadTally RunLoad(const std::vector<LoadBody>& bodies, const LoadPlan& plan, const LoadCall& call) {
  return LoadRun(bodies, plan, call).Run();
}

}  // namespace capfit::client
