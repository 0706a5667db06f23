// Where the lines of the log go: stderr, and what becomes of lines that cannot be written.
#ifndef CAPFIT_SERVER_LOG_SINK_H_
#define CAPFIT_SERVER_LOG_SINK_H_

#include <spdlog/sinks/ansicolor_sink.h>

#include <atomic>
#include <cstdint>
#include <mutex>

namespace capfit::server {

// spdlog's own sink for stderr, with its colours on a terminal, that notices lines which cannot be
// written (a full disk, a reader that is gone). They are lost and stop nothing; as soon as a line
// can be written again, the next one says how many were lost. Any thread.
class LogSink final : public spdlog::sinks::ansicolor_stderr_sink_mt {
 public:
  void log(const spdlog::details::log_msg& message) override;
  [[nodiscard]] std::int64_t lost_lines() const { return lost_lines_; }

 private:
  // Whether it is written.
  bool Write(const spdlog::details::log_msg& message);

  std::mutex mutex_;  // a line and its verdict belong together
  std::int64_t untold_lines_ = 0;
  std::atomic<std::int64_t> lost_lines_{0};
};

// Lines that the default logger has lost since the program began; 0 without a LogSink.
[[nodiscard]] std::int64_t LostLogLines();

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_LOG_SINK_H_
