#include "core/base/side_by_side.h"

#include <future>

namespace capfit {

class SideBySide::Work final : public FitObserver {
 public:
  Work(const SideBySide& all, double share) : all_(all), share_(share) {}

  void OnStage(Stage, double) override {}
  void OnFraction(double fraction) override {
    done_ = share_ * fraction;
    if (std::this_thread::get_id() == all_.owner_) all_.Tell();
  }
  [[nodiscard]] bool IsCancelled() const override { return all_.observer_.IsCancelled(); }

  [[nodiscard]] double done() const { return done_; }

 private:
  const SideBySide& all_;
  double share_;
  std::atomic<double> done_ = 0.0;
};

SideBySide::SideBySide(FitObserver& observer, double from, double until,
                       const std::vector<double>& shares)
    : observer_(observer), from_(from), until_(until) {
  for (const double share : shares) works_.push_back(std::make_unique<Work>(*this, share));
}

SideBySide::~SideBySide() = default;

// Not as a loop of the pool: a thread that waits for the end of another caller's loop would take up
// a whole work and come back to its own only at the end of that, even where it was given up.
void SideBySide::Run(const ThreadPool& pool,
                     const std::function<void(std::size_t, FitObserver&)>& work) {
  if (pool.threads() == 1) {
    for (std::size_t i = 0; i < works_.size(); ++i) work(i, of(i));
    return;
  }
  std::vector<std::future<void>> others;
  for (std::size_t i = 1; i < works_.size(); ++i) {
    others.push_back(std::async(std::launch::async, [&work, this, i] { work(i, of(i)); }));
  }
  work(0, of(0));
  for (std::future<void>& other : others) other.get();
}

FitObserver& SideBySide::of(std::size_t work) { return *works_[work]; }

void SideBySide::Tell() const {
  double done = 0.0;
  for (const auto& work : works_) done += work->done();
  observer_.OnFraction(from_ + done * (until_ - from_));
}

}  // namespace capfit
