#include "proto/wire/status_conversion.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/enum_index.h"
#include "core/base/status.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "proto/wire/result_conversion.h"

namespace capfit::wire {
namespace {

// ErrorInfo's names of what travels as payloads of their own.
constexpr char kFieldKey[] = "field";

// gRPC refuses trailers above 8 KiB; percent-encoding and the message itself take their share.
constexpr std::size_t kMaxWarningBytes = 4096;

// The reason of an error that names none of its own.
ErrorReason ReasonFor(absl::StatusCode code) {
  switch (code) {
    case absl::StatusCode::kInvalidArgument:
      return ErrorReason::kOutOfRange;
    case absl::StatusCode::kFailedPrecondition:
      return ErrorReason::kNotABody;
    case absl::StatusCode::kUnimplemented:
      return ErrorReason::kNotImplemented;
    case absl::StatusCode::kResourceExhausted:
      return ErrorReason::kServerFull;
    case absl::StatusCode::kCancelled:
      return ErrorReason::kCancelled;
    case absl::StatusCode::kDeadlineExceeded:
      return ErrorReason::kDeadlineExceeded;
    case absl::StatusCode::kUnavailable:
      return ErrorReason::kServerStopping;
    default:
      return ErrorReason::kInternal;
  }
}

// What a trailer may hold whole: gRPC writes three bytes for each that is not printable ASCII, so
// those become '?', and no text has more than 1000.
std::string AsciiText(const std::string& text) {
  constexpr std::size_t kMaxBytes = 1000;
  std::string ascii = text.substr(0, kMaxBytes);
  std::replace_if(
      ascii.begin(), ascii.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return ascii;
}

google::rpc::ErrorInfo InfoOf(const absl::Status& status) {
  google::rpc::ErrorInfo info;
  const ErrorReason reason = ReasonOf(status).value_or(ReasonFor(status.code()));
  info.set_reason(std::string(ErrorReasonName(reason)));
  info.set_domain(kErrorDomain);
  if (const std::optional<std::string> field = FieldOf(status)) {
    (*info.mutable_metadata())[kFieldKey] = AsciiText(*field);
  }
  for (const auto& [name, value] : FactsOf(status)) {
    (*info.mutable_metadata())[AsciiText(name)] = AsciiText(value);
  }
  return info;
}

void AddWarnings(const absl::Status& status, google::rpc::Status& rich) {
  std::size_t bytes = 0;
  for (const Warning& warning : WarningsOf(status)) {
    const v1::Warning wire = WarningToWire(warning);
    bytes += wire.ByteSizeLong();
    if (bytes > kMaxWarningBytes) return;
    rich.add_details()->PackFrom(wire);
  }
}

// What the details of an answer say.
struct Details {
  google::rpc::ErrorInfo info;
  std::vector<Warning> warnings;
};

Details DetailsOf(const grpc::Status& status) {
  Details details;
  google::rpc::Status rich;
  if (!rich.ParseFromString(status.error_details())) return details;
  for (const google::protobuf::Any& any : rich.details()) {
    v1::Warning warning;
    if (any.UnpackTo(&warning)) details.warnings.push_back(WarningFromWire(warning));
    any.UnpackTo(&details.info);
  }
  return details;
}

absl::Status StatusOf(const grpc::Status& status, const google::rpc::ErrorInfo& info) {
  const auto code = static_cast<absl::StatusCode>(status.error_code());
  const std::optional<ErrorReason> reason = ErrorReasonFromName(info.reason());
  const std::string& message = status.error_message();
  if (!reason || ErrorReasons()[Index(*reason)].code != code) {
    return {code, message};
  }
  ErrorFacts facts;
  for (const auto& [name, value] : info.metadata()) {
    if (name != kFieldKey) facts.emplace_back(name, value);
  }
  std::sort(facts.begin(), facts.end());  // a protobuf map has no order
  const auto field = info.metadata().find(kFieldKey);
  if (field != info.metadata().end() && message.rfind(field->second + " ", 0) == 0) {
    return InvalidField(*reason, field->second, message.substr(field->second.size() + 1), facts);
  }
  return Refused(*reason, message, facts);
}

}  // namespace

grpc::Status ToGrpcStatus(const absl::Status& status, std::optional<int> retry_ms) {
  if (status.ok()) return grpc::Status::OK;
  google::rpc::Status rich;
  rich.set_code(static_cast<int>(status.code()));
  rich.set_message(AsciiText(std::string(status.message())));
  rich.add_details()->PackFrom(InfoOf(status));
  if (const std::optional<std::string> field = FieldOf(status)) {
    google::rpc::BadRequest bad_request;
    google::rpc::BadRequest::FieldViolation& violation = *bad_request.add_field_violations();
    violation.set_field(AsciiText(*field));
    violation.set_description(rich.message());
    rich.add_details()->PackFrom(bad_request);
  }
  if (retry_ms) {
    google::rpc::RetryInfo retry;
    retry.mutable_retry_delay()->set_seconds(*retry_ms / 1000);
    retry.mutable_retry_delay()->set_nanos(*retry_ms % 1000 * 1'000'000);
    rich.add_details()->PackFrom(retry);
  }
  AddWarnings(status, rich);
  return {static_cast<grpc::StatusCode>(rich.code()), rich.message(), rich.SerializeAsString()};
}

absl::Status FromGrpcStatus(const grpc::Status& status) {
  if (status.ok()) return absl::OkStatus();
  const Details details = DetailsOf(status);
  return WithWarnings(StatusOf(status, details.info), details.warnings);
}

}  // namespace capfit::wire
