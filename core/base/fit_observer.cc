#include "core/base/fit_observer.h"

#include <array>

#include "core/base/enum_index.h"
#include "core/base/status.h"

namespace capfit {

std::string_view StageName(Stage stage) {
  static constexpr std::array<std::string_view, kStageCount> kNames = {
      "mesh", "body", "section", "circle", "capsule", "refine", "coverage", "metrics", "skinning"};
  return kNames[Index(stage)];
}

absl::Status CheckCancelled(const FitObserver& observer) {
  if (!observer.IsCancelled()) return absl::OkStatus();
  return Refused(ErrorReason::kCancelled, "the caller gave up");
}

}  // namespace capfit
