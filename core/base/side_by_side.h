// How far works have come that run at the same time, told as one.
#ifndef CAPFIT_CORE_BASE_SIDE_BY_SIDE_H_
#define CAPFIT_CORE_BASE_SIDE_BY_SIDE_H_

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"

namespace capfit {

// A part of a stage that several long works bring to its end together. Each gets an observer to
// make its WorkMeter with; the stage's observer hears of them all from the thread that made this,
// whenever the work that it does itself goes on. Fractions never fall; all of the works are
// cancelled with the stage.
class SideBySide {
 public:
  // From `from` to `until` of the stage. `shares`: of each work in that, together 1.
  SideBySide(FitObserver& observer, double from, double until, const std::vector<double>& shares);
  ~SideBySide();
  SideBySide(const SideBySide&) = delete;
  SideBySide& operator=(const SideBySide&) = delete;

  // Calls work(i, of(i)) for each work and waits for all: the first on this thread, each other on
  // one of its own, which uses the pool as another caller would; one after the other where the pool
  // has but one thread. Not for works of a few milliseconds: those are a loop of the pool.
  void Run(const ThreadPool& pool, const std::function<void(std::size_t, FitObserver&)>& work);

  // Of one work. Valid as long as this. From one thread at a time.
  [[nodiscard]] FitObserver& of(std::size_t work);

 private:
  class Work;
  void Tell() const;

  FitObserver& observer_;
  std::thread::id owner_ = std::this_thread::get_id();
  double from_;
  double until_;
  std::vector<std::unique_ptr<Work>> works_;
};

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_SIDE_BY_SIDE_H_
