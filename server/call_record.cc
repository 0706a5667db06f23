#include "server/call_record.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::server {
namespace {

using Fields = nlohmann::ordered_json;

double Milli(double seconds) { return std::round(seconds * 1000.0) / 1000.0; }

// In the order in which they are written; what says nothing is left out.
Fields FieldsOf(const CallRecord& record) {
  Fields fields;
  fields["id"] = record.request_id;
  if (!record.trace.empty()) fields["traceparent"] = record.trace;
  fields["peer"] = record.peer;
  fields["client"] = record.client;
  if (!record.options.empty()) fields["options"] = record.options;
  fields["priority"] = record.is_bulk ? "bulk" : "interactive";
  fields["bytes"] = record.received_bytes;
  fields["faces"] = record.faces;
  fields["cached"] = CachedName(record.cached);
  fields["queued_seconds"] = Milli(record.queued_seconds);
  fields["fit_seconds"] = Milli(record.fit_seconds);
  fields["seconds"] = Milli(record.seconds);
  fields["status"] = CodeName(record);
  if (record.status.ok()) return fields;
  if (const std::optional<ErrorReason> reason = ReasonOf(record.status)) {
    fields["reason"] = std::string(ErrorReasonName(*reason));
  }
  fields["message"] = std::string(record.status.message());
  return fields;
}

// Escapes what is not ASCII too, so that no terminal and no reader of lines is misled.
std::string Dump(const Fields& value) {
  return value.dump(-1, ' ', /*ensure_ascii=*/true, Fields::error_handler_t::replace);
}

// Words of our own need no quotes.
bool IsOurOwn(const std::string& key) {
  return key == "priority" || key == "status" || key == "reason" || key == "traceparent" ||
         key == "cached";
}

}  // namespace

std::string CallLine(const CallRecord& record, LogFormat format) {
  if (format == LogFormat::kJson) {
    Fields line;
    line["method"] = record.method;
    line.update(FieldsOf(record));
    return Dump(line);
  }
  std::string line = record.method;
  const Fields fields = FieldsOf(record);
  for (const auto& [key, value] : fields.items()) {
    absl::StrAppend(&line, " ", key, "=", IsOurOwn(key) ? value.get<std::string>() : Dump(value));
  }
  return line;
}

std::string QuotedText(const std::string& text) { return Dump(text); }

double WastedSeconds(const CallRecord& record) {
  switch (record.status.code()) {
    case absl::StatusCode::kCancelled:
    case absl::StatusCode::kDeadlineExceeded:
    case absl::StatusCode::kUnavailable:
    case absl::StatusCode::kInternal:
      return record.fit_seconds;
    default:
      return 0.0;
  }
}

const char* CachedName(Cached cached) {
  switch (cached) {
    case Cached::kMemory:
      return "memory";
    case Cached::kRedis:
      return "redis";
    case Cached::kNo:
      break;
  }
  return "no";
}

std::string CodeName(const CallRecord& record) {
  return absl::StatusCodeToString(record.status.code());
}

}  // namespace capfit::server
