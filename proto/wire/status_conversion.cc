#include "proto/wire/status_conversion.h"

#include <optional>

#include "core/base/status.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "proto/wire/result_conversion.h"

namespace capfit::wire {
namespace {

// What the details say of the field and the reason.
struct Details {
  std::optional<std::string> field;
  std::optional<std::string> reason;
};

Details DetailsOf(const grpc::Status& status) {
  Details details;
  google::rpc::Status rich;
  if (!rich.ParseFromString(status.error_details())) return details;
  for (const google::protobuf::Any& any : rich.details()) {
    google::rpc::BadRequest bad_request;
    if (any.UnpackTo(&bad_request) && bad_request.field_violations_size() > 0) {
      details.field = bad_request.field_violations(0).field();
    }
    google::rpc::ErrorInfo info;
    if (any.UnpackTo(&info)) details.reason = info.reason();
  }
  return details;
}

}  // namespace

std::string ErrorReason(const absl::Status& status) {
  if (const std::optional<std::string> reason = ReasonOf(status)) return *reason;
  switch (status.code()) {
    case absl::StatusCode::kInvalidArgument:
      return "INVALID_INPUT";
    case absl::StatusCode::kFailedPrecondition:
      return "CANNOT_FIT";
    case absl::StatusCode::kUnimplemented:
      return "NOT_IMPLEMENTED";
    case absl::StatusCode::kResourceExhausted:
      return "QUEUE_FULL";
    case absl::StatusCode::kCancelled:
      return "CANCELLED";
    case absl::StatusCode::kDeadlineExceeded:
      return "DEADLINE_EXCEEDED";
    case absl::StatusCode::kUnavailable:
      return "UNAVAILABLE";
    default:
      return "INTERNAL";
  }
}

grpc::Status ToGrpcStatus(const absl::Status& status) {
  if (status.ok()) return grpc::Status::OK;
  google::rpc::Status rich;
  rich.set_code(static_cast<int>(status.code()));
  rich.set_message(PlainText(std::string(status.message())));
  google::rpc::ErrorInfo info;
  info.set_reason(ErrorReason(status));
  info.set_domain(kErrorDomain);
  rich.add_details()->PackFrom(info);
  if (const std::optional<std::string> field = FieldOf(status)) {
    google::rpc::BadRequest bad_request;
    google::rpc::BadRequest::FieldViolation& violation = *bad_request.add_field_violations();
    violation.set_field(PlainText(*field));
    violation.set_description(rich.message());
    rich.add_details()->PackFrom(bad_request);
  }
  return {static_cast<grpc::StatusCode>(rich.code()), rich.message(), rich.SerializeAsString()};
}

absl::Status FromGrpcStatus(const grpc::Status& status) {
  if (status.ok()) return absl::OkStatus();
  const std::string& message = status.error_message();
  const Details details = DetailsOf(status);
  const auto code = static_cast<absl::StatusCode>(status.error_code());
  if (code == absl::StatusCode::kInvalidArgument && details.field &&
      message.rfind(*details.field + " ", 0) == 0) {
    return InvalidField(*details.field, message.substr(details.field->size() + 1));
  }
  if (code == absl::StatusCode::kFailedPrecondition && details.reason) {
    return CannotFit(*details.reason, message);
  }
  return {code, message};
}

}  // namespace capfit::wire
