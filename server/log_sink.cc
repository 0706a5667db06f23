#include "server/log_sink.h"

#include <spdlog/details/log_msg.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"

namespace capfit::server {

// spdlog does not look at what fwrite returns; the stream remembers.
bool LogSink::Write(const spdlog::details::log_msg& message) {
  std::clearerr(stderr);
  ansicolor_sink::log(message);
  return std::ferror(stderr) == 0;
}

void LogSink::log(const spdlog::details::log_msg& message) {
  const std::lock_guard lock(mutex_);
  if (!Write(message)) {
    ++untold_lines_;
    ++lost_lines_;
    return;
  }
  if (untold_lines_ == 0) return;
  const std::string text =
      absl::StrCat(untold_lines_, " lines of the log could not be written and are lost");
  const spdlog::details::log_msg told(message.logger_name, spdlog::level::warn, text);
  if (Write(told)) untold_lines_ = 0;
}

std::int64_t LostLogLines() {
  std::int64_t lines = 0;
  for (const spdlog::sink_ptr& sink : spdlog::default_logger_raw()->sinks()) {
    if (const auto* const ours = dynamic_cast<const LogSink*>(sink.get())) {
      lines += ours->lost_lines();
    }
  }
  return lines;
}

}  // namespace capfit::server
