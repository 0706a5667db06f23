// Calls somebody when a time has passed.
#ifndef CAPFIT_SERVER_WATCHDOG_H_
#define CAPFIT_SERVER_WATCHDOG_H_

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

namespace capfit::server {

// One thread for the time limits of all calls. Set and Drop cost O(log n) and no system call worth
// the name, so that each message of an upload may push its limit back.
class Watchdog {
 public:
  using Clock = std::chrono::steady_clock;
  using Alarm = std::pair<Clock::time_point, std::uint64_t>;

  // Times as the settings give them.
  [[nodiscard]] static Clock::time_point After(double seconds) {
    return Clock::now() +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }
  [[nodiscard]] static double SecondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  Watchdog();
  // Alarms that have not rung never will.
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  // Calls `ring` once at `when` or soon after it, from the watchdog's thread; it must not block,
  // and must find out by itself whether it comes too late.
  Alarm Set(Clock::time_point when, std::function<void()> ring);
  // Does not wait for an alarm that is ringing.
  void Drop(const Alarm& alarm);

 private:
  void Run();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::map<Alarm, std::function<void()>> alarms_;
  std::uint64_t last_ = 0;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_WATCHDOG_H_
