// Progress on stderr: one line that is written over and over.
#ifndef CAPFIT_CLIENT_PROGRESS_LINE_H_
#define CAPFIT_CLIENT_PROGRESS_LINE_H_

#include "core/base/fit_observer.h"

namespace capfit::client {

// Whether stderr is a terminal.
[[nodiscard]] bool StderrIsTerminal();

// Shows stage and percentage while a fit runs, as a bar on a terminal and as one line for each
// stage elsewhere; removes the bar when destroyed.
class ProgressLine final : public FitObserver {
 public:
  // Not shown: keeps silent.
  explicit ProgressLine(bool is_shown);
  ~ProgressLine() override;
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void OnStage(Stage stage, double fraction_done) override;
  [[nodiscard]] bool IsCancelled() const override { return false; }

 private:
  const bool is_shown_;
  const bool is_terminal_;
  int last_stage_ = -1;
};

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PROGRESS_LINE_H_
