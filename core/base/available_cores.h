// How many cores a process may keep busy.
#ifndef CAPFIT_CORE_BASE_AVAILABLE_CORES_H_
#define CAPFIT_CORE_BASE_AVAILABLE_CORES_H_

#include <filesystem>

namespace capfit {

// What control groups (Linux, versions 1 and 2) grant this process of the processors' time, in
// cores: the least quota of its group and of those above it, as `docker run --cpus` and a
// Kubernetes limit set one. 0 where there is none or it cannot be read. `root`: the folder that
// has proc/self/cgroup and sys/fs/cgroup.
[[nodiscard]] double QuotaOfCores(const std::filesystem::path& root = "/");

// The cores that this process may run on, but no more than its quota, rounded up; at least 1.
// Threads beyond a quota use it up sooner in each period, and all wait for the next one.
[[nodiscard]] int AvailableCores();

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_AVAILABLE_CORES_H_
