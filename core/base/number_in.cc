#include "core/base/number_in.h"

#include <cstdint>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"

namespace capfit {

std::function<std::string(const std::string&)> NumberIn(double low, double high) {
  return [low, high](const std::string& text) -> std::string {
    double value = 0.0;
    if (absl::SimpleAtod(text, &value) && value >= low && value <= high) return "";
    return absl::StrCat("'", text, "' must be a number in [", low, ", ", high, "]");
  };
}

std::function<std::string(const std::string&)> SeedCheck() {
  return [](const std::string& text) -> std::string {
    std::uint64_t value = 0;
    if (absl::SimpleAtoi(text, &value)) return "";
    return absl::StrCat("'", text, "' must be a whole number in [0, ", UINT64_MAX, "]");
  };
}

}  // namespace capfit
