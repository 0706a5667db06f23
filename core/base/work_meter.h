// How far long work has come, counted by whatever threads do it.
#ifndef CAPFIT_CORE_BASE_WORK_METER_H_
#define CAPFIT_CORE_BASE_WORK_METER_H_

#include <atomic>
#include <cstdint>
#include <thread>

#include "core/base/fit_observer.h"

namespace capfit {

// The work of one stage, in parts that follow one another. Each part is announced with the fraction
// of the stage at its end and with its own amount of work, in any unit; then its work is added up
// as it is done. The observer hears of it from the thread that made the meter, which is the one
// that runs the fit and takes its share of every parallel loop; fractions never fall.
class WorkMeter {
 public:
  explicit WorkMeter(FitObserver& observer) : observer_(observer) {}

  // What was announced before is done; `work` of the next part brings the stage to `until`.
  void Expect(double until, std::int64_t work);
  // The next part takes this share of all that is left up to `end`: for rounds of which nobody
  // knows how many there will be.
  void ExpectShare(double share, double end, std::int64_t work) {
    Expect(until_ + share * (end - until_), work);
  }
  // Any thread. What is more than expected counts for nothing.
  void Add(std::int64_t work) const;

  // Where the part that is under way ends.
  [[nodiscard]] double until() const { return until_; }
  [[nodiscard]] bool IsCancelled() const { return observer_.IsCancelled(); }
  [[nodiscard]] FitObserver& observer() const { return observer_; }

 private:
  FitObserver& observer_;
  std::thread::id owner_ = std::this_thread::get_id();
  double from_ = 0.0;
  double until_ = 0.0;
  std::int64_t expected_ = 0;
  mutable std::atomic<std::int64_t> done_ = 0;
};

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_WORK_METER_H_
