#include "core/base/available_cores.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_split.h"
#include "absl/strings/string_view.h"

namespace capfit {
namespace {

namespace fs = std::filesystem;

// The numbers of a file's first line; "max" is none.
std::vector<double> NumbersIn(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<double> numbers;
  for (const absl::string_view word : absl::StrSplit(line, ' ', absl::SkipWhitespace())) {
    double number = 0.0;
    if (!absl::SimpleAtod(word, &number)) return {};
    numbers.push_back(number);
  }
  return numbers;
}

// Of one group: microseconds of processor time in each period. 0: no limit.
double QuotaOfGroup(const fs::path& group) {
  std::vector<double> quota = NumbersIn(group / "cpu.max");
  if (quota.empty()) {  // version 1
    quota = NumbersIn(group / "cpu.cfs_quota_us");
    const std::vector<double> period = NumbersIn(group / "cpu.cfs_period_us");
    quota.insert(quota.end(), period.begin(), period.end());
  }
  const bool is_limit = quota.size() == 2 && quota[0] > 0.0 && quota[1] > 0.0;
  return is_limit ? quota[0] / quota[1] : 0.0;
}

// The less of two quotas of which either may be 0, none.
double LesserQuota(double a, double b) { return a > 0.0 && b > 0.0 ? std::min(a, b) : a + b; }

// From the group up to the top of its tree. Within a container the tree begins at the container's
// own group, whatever the group is called outside.
double LeastQuota(const fs::path& top, const fs::path& group) {
  double least = 0.0;
  for (fs::path below = group.relative_path();; below = below.parent_path()) {
    least = LesserQuota(least, QuotaOfGroup(top / below));
    if (below.empty()) return least;
  }
}

}  // namespace

double QuotaOfCores(const fs::path& root) {
  const fs::path mounts = root / "sys/fs/cgroup";
  std::ifstream groups(root / "proc/self/cgroup");
  double least = 0.0;
  for (std::string line; std::getline(groups, line);) {  // HIERARCHY:CONTROLLERS:GROUP
    const std::vector<std::string> parts = absl::StrSplit(line, absl::MaxSplits(':', 2));
    if (parts.size() != 3) continue;
    const std::vector<std::string> controllers = absl::StrSplit(parts[1], ',');
    // The one tree of version 2 has no name, and its mount is one of several beside version 1.
    const bool is_unified = parts[1].empty();
    if (!is_unified &&
        std::find(controllers.begin(), controllers.end(), "cpu") == controllers.end())
      continue;
    for (const fs::path& top : is_unified ? std::vector{mounts, mounts / "unified"}
                                          : std::vector{mounts / parts[1], mounts / "cpu"}) {
      least = LesserQuota(least, LeastQuota(top, parts[2]));
    }
  }
  return least;
}

int AvailableCores() {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const double quota = QuotaOfCores();
  return quota > 0.0 && quota < cores ? std::max(1, static_cast<int>(std::ceil(quota))) : cores;
}

}  // namespace capfit
