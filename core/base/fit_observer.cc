#include "core/base/fit_observer.h"

#include <array>

namespace capfit {

std::string_view StageName(Stage stage) {
  static constexpr std::array<std::string_view, kStageCount> kNames = {
      "mesh", "body", "section", "circle", "capsule", "refine", "coverage", "metrics", "skinning"};
  return kNames[static_cast<std::size_t>(stage)];
}

}  // namespace capfit
