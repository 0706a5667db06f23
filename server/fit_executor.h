// Where fits run: a small fixed number of threads, never gRPC's, and the admission in front of
// them.
#ifndef CAPFIT_SERVER_FIT_EXECUTOR_H_
#define CAPFIT_SERVER_FIT_EXECUTOR_H_

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace capfit::server {

// Runs jobs in the order in which they come. Each job may use the whole ThreadPool; more than one
// at a time keeps the cores busy while another is in a serial stretch.
class FitExecutor {
 public:
  // Admits `concurrent_fits` + `queued_fits` calls at a time.
  FitExecutor(int concurrent_fits, int queued_fits);
  // Runs what is queued, then stops. All places must have been given back.
  ~FitExecutor();
  FitExecutor(const FitExecutor&) = delete;
  FitExecutor& operator=(const FitExecutor&) = delete;

  // A call's right to upload, wait and compute; given back on destruction. Taken when the call
  // begins, not when its upload ends, so that a full server refuses before bytes are sent, and
  // uploads and unread results in memory are bounded by the number of places.
  using Place = std::shared_ptr<void>;

  // Nothing when all are taken.
  [[nodiscard]] Place TryTakePlace();

  // Never blocks.
  void Submit(std::function<void()> job);

 private:
  void Work();

  const int place_count_;
  std::atomic<int> taken_{0};
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> jobs_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_FIT_EXECUTOR_H_
