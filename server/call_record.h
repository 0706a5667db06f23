// What is told of a call when it is over: one log line, and the metrics.
#ifndef CAPFIT_SERVER_CALL_RECORD_H_
#define CAPFIT_SERVER_CALL_RECORD_H_

#include <array>
#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "core/base/fit_observer.h"

namespace capfit::server {

// Who kept the result of a call that was answered without a fit.
enum class Cached { kNo, kMemory, kRedis };

// Nothing of the body itself. Texts of callers are as they came: whoever writes them escapes them.
struct CallRecord {
  std::string method;
  std::string request_id;
  std::string trace;   // traceparent, empty without one
  std::string client;  // see caller.h
  std::string peer;
  std::string options;  // the budget, mode and quality that were asked for; empty without a header
  bool is_bulk = false;
  Cached cached = Cached::kNo;
  std::int64_t received_bytes = 0;
  std::int64_t faces = 0;  // of a file that was not read, guessed from its size
  double queued_seconds = 0.0;
  double fit_seconds = 0.0;
  double seconds = 0.0;                             // from its begin to its end
  std::array<double, kStageCount> stage_seconds{};  // of a fit that came to its end
  absl::Status status;
};

enum class LogFormat { kText, kJson };

// One line without its end. Text is `METHOD key=value ...`, where texts that came from outside
// stand in quotes with quotes, backslashes and control characters escaped as in JSON; JSON is one
// object of the same keys. What is not UTF-8 is replaced.
[[nodiscard]] std::string CallLine(const CallRecord& record, LogFormat format);

// `text` as it stands in a line of text.
[[nodiscard]] std::string QuotedText(const std::string& text);

// Seconds that were computed for nobody: the fit ran, and its call ended without its result.
[[nodiscard]] double WastedSeconds(const CallRecord& record);

// "no", "memory" or "redis".
[[nodiscard]] const char* CachedName(Cached cached);

// "OK", "CANCELLED", ...: the code's name.
[[nodiscard]] std::string CodeName(const CallRecord& record);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_CALL_RECORD_H_
