// Work that can wait, for the time in which other work leaves a thread idle.
#ifndef CAPFIT_CORE_BASE_BACKLOG_H_
#define CAPFIT_CORE_BASE_BACKLOG_H_

#include <cstddef>
#include <deque>
#include <functional>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"

namespace capfit {

// Loops that are to be done one after the other. For one caller at a time.
class Backlog {
 public:
  // Keeps references to both. Once the observer cancels, what is left is dropped.
  Backlog(const ThreadPool& pool, const FitObserver& observer);
  Backlog(const Backlog&) = delete;
  Backlog& operator=(const Backlog&) = delete;

  // Calls step(i) once for each i in [0, count), some of them at the same time, after all that was
  // added before. A step should take some ten microseconds: work beside it waits for its end. One
  // that is the only one of its loop may add more.
  void Add(std::size_t count, std::function<void(std::size_t)> step);

  // The same in chunks, as ThreadPool::ForChunks.
  void AddChunks(std::size_t count, std::size_t chunk,
                 std::function<void(std::size_t begin, std::size_t end)> step);

  // Does `work` on this thread and, beside it on another, as much of the backlog as there is time
  // for. Best where `work` runs on one thread alone; its loops get the other one once the backlog
  // is done.
  void Beside(const std::function<void()>& work);

  // Does what is left, on all threads.
  void Finish();

 private:
  struct Loop {
    std::size_t count = 0;
    std::function<void(std::size_t)> step;
  };

  // Drops loops that are done; whether there is one that is not.
  [[nodiscard]] bool HasMore();

  const ThreadPool& pool_;
  const FitObserver& observer_;
  std::deque<Loop> loops_;  // stay where they are while more are added
  std::size_t next_ = 0;    // step of the first
};

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_BACKLOG_H_
