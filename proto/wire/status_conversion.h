// Errors over the wire: canonical code, message, and google.rpc details.
#ifndef CAPFIT_PROTO_WIRE_STATUS_CONVERSION_H_
#define CAPFIT_PROTO_WIRE_STATUS_CONVERSION_H_

#include <grpcpp/support/status.h>

#include <string>

#include "absl/status/status.h"

namespace capfit::wire {

// ErrorInfo.domain of every error.
inline constexpr char kErrorDomain[] = "capfit";

// The one function that makes a wire status. The details (trailer grpc-status-details-bin) are a
// google.rpc.Status with ErrorInfo (reason: the one that CannotFit named, else a word that follows
// from the code) and, where InvalidField named a field, BadRequest.
[[nodiscard]] grpc::Status ToGrpcStatus(const absl::Status& status);

// The way back: the same code and message, and the same FieldOf and ReasonOf.
[[nodiscard]] absl::Status FromGrpcStatus(const grpc::Status& status);

// ErrorInfo.reason of a status: stable UPPER_SNAKE_CASE words.
[[nodiscard]] std::string ErrorReason(const absl::Status& status);

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_STATUS_CONVERSION_H_
