// Which stage a fit is in: told to the observer, with the time of each.
#ifndef CAPFIT_CORE_PIPELINE_STAGE_CLOCK_H_
#define CAPFIT_CORE_PIPELINE_STAGE_CLOCK_H_

#include <array>
#include <chrono>
#include <optional>

#include "core/base/fit_observer.h"
#include "core/pipeline/fit.h"

namespace capfit::pipeline {

// The observer of the rooms: their own fractions become the whole fit's, which never falls, also
// where stages are entered again. Writes the times into `result`.
class StageClock final : public FitObserver {
 public:
  // `options` say which stages there will be.
  StageClock(const FitOptions& options, FitObserver& observer, FitResult& result);

  // Ends the stage before.
  void Begin(Stage stage);
  void End();

  void OnStage(Stage stage, double) override { Begin(stage); }
  void OnFraction(double fraction_of_stage) override;
  [[nodiscard]] bool IsCancelled() const override { return observer_.IsCancelled(); }

 private:
  using Clock = std::chrono::steady_clock;

  FitObserver& observer_;
  FitResult& result_;
  std::array<double, kStageCount> shares_{};  // of the whole time, estimated; they add up to 1
  std::optional<Stage> current_;
  double fraction_done_ = 0.0;  // as told last
  Clock::time_point start_ = Clock::now();
  Clock::time_point stage_start_ = start_;
};

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_STAGE_CLOCK_H_
