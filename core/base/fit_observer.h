// How long work tells of its progress and learns that nobody wants its result any more.
#ifndef CAPFIT_CORE_BASE_FIT_OBSERVER_H_
#define CAPFIT_CORE_BASE_FIT_OBSERVER_H_

#include <string_view>

#include "absl/status/status.h"

namespace capfit {

// The stages of a fit, in the order in which a fit goes through them. Each is the name of a room.
enum class Stage {
  kMesh,
  kBody,
  kSection,
  kCircle,
  kCapsule,
  kRefine,
  kCoverage,
  kMetrics,
  kSkinning
};
inline constexpr int kStageCount = 9;

// "mesh", "body", ...: the words used in results and logs.
[[nodiscard]] std::string_view StageName(Stage stage);

// The core calls it, the server and the command line implement it. All calls come from the thread
// that runs the fit, but for IsCancelled, which any worker thread may call.
class FitObserver {
 public:
  virtual ~FitObserver() = default;
  // `stage` begins or has come further. `fraction_done` in [0, 1] is an estimate for the whole fit
  // and never falls.
  virtual void OnStage(Stage stage, double fraction_done) = 0;
  // The stage that is under way has come this far, in [0, 1]: from the thread that runs the fit.
  virtual void OnFraction(double fraction_of_stage) { (void)fraction_of_stage; }
  // Polled between chunks of parallel work, every few milliseconds. Once true it stays so: what
  // work leaves behind then is whole enough to be let go of, and nothing more.
  [[nodiscard]] virtual bool IsCancelled() const = 0;
};

// Ignores progress and never cancels.
class NullObserver final : public FitObserver {
 public:
  void OnStage(Stage, double) override {}
  [[nodiscard]] bool IsCancelled() const override { return false; }
};

// For work on several threads at once: says nothing, and cancels when another does.
class QuietObserver final : public FitObserver {
 public:
  explicit QuietObserver(const FitObserver& other) : other_(other) {}
  void OnStage(Stage, double) override {}
  [[nodiscard]] bool IsCancelled() const override { return other_.IsCancelled(); }

 private:
  const FitObserver& other_;
};

// CANCELLED with its reason once the observer cancels. For between two steps that take some
// milliseconds each.
[[nodiscard]] absl::Status CheckCancelled(const FitObserver& observer);

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_FIT_OBSERVER_H_
