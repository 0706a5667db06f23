// Where fits run: a small fixed number of threads, never gRPC's, and the queue in front of them.
#ifndef CAPFIT_SERVER_FIT_EXECUTOR_H_
#define CAPFIT_SERVER_FIT_EXECUTOR_H_

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "server/fit_queue.h"

namespace capfit::server {

// Runs jobs in the order of FitQueue. Jobs share the ThreadPool (ThreadPool::Job): one alone has
// all of it, as many as it has threads have one each, which serves the most bodies a second. Where
// there are two threads or more, long fits never take the last one.
class FitExecutor {
 public:
  using Ticket = FitQueue::Ticket;

  // `concurrent_fits` >= 1 threads.
  explicit FitExecutor(int concurrent_fits);
  // Runs what is queued, then stops.
  ~FitExecutor();
  FitExecutor(const FitExecutor&) = delete;
  FitExecutor& operator=(const FitExecutor&) = delete;

  // Never blocks.
  Ticket Submit(WaitingFit fit, std::function<void()> job);
  // Takes a job that has not begun out of the queue and gives it back; empty when it has begun.
  [[nodiscard]] std::function<void()> Withdraw(Ticket ticket);
  // How long `fit` would wait for its turn if it came now and nobody after it, as expected: for
  // what goes before it, and for what is left of the fits that run.
  [[nodiscard]] double ExpectedWaitSeconds(const WaitingFit& fit) const;
  // Jobs that wait.
  [[nodiscard]] std::size_t waiting() const;
  // Jobs that run.
  [[nodiscard]] std::size_t running() const;

 private:
  struct Job {
    std::function<void()> run;
    double expected_seconds = 0.0;
    Ticket ticket = 0;
    [[nodiscard]] bool is_long() const { return expected_seconds > kLongFitSeconds; }
  };
  void Work();
  // The next job, as soon as one may run; one without a function at the end.
  [[nodiscard]] Job Next();
  void Done(const Job& job);

  const int most_long_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  FitQueue queue_;
  std::map<Ticket, Job> jobs_;
  std::map<Ticket, double> running_;  // when each is expected to end, in seconds of steady_clock
  int running_long_ = 0;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_FIT_EXECUTOR_H_
