#include "core/export/ball_warnings.h"

#include <algorithm>

#include "absl/strings/str_cat.h"

namespace capfit::exports {

std::vector<Warning> BallWarnings(const std::vector<Solid>& solids, const std::string& engine) {
  const auto is_inner = [](const Solid& s) { return s.capsule.has_value() && s.IsBall(); };
  const auto count = std::count_if(solids.begin(), solids.end(), is_inner);
  if (count == 0) return {};
  const auto first = std::find_if(solids.begin(), solids.end(), is_inner);
  return {{"INNER_SPHERES",
           absl::StrCat(count, " capsules, the first '", first->name,
                        "', have one sphere inside the other: for ", engine,
                        " they are the larger sphere, which is the same solid"),
           count}};
}

}  // namespace capfit::exports
