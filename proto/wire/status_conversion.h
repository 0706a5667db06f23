// Errors over the wire: canonical code, message, and google.rpc details.
#ifndef CAPFIT_PROTO_WIRE_STATUS_CONVERSION_H_
#define CAPFIT_PROTO_WIRE_STATUS_CONVERSION_H_

#include <grpcpp/support/status.h>

#include <optional>

#include "absl/status/status.h"

namespace capfit::wire {

// ErrorInfo.domain of every error.
inline constexpr char kErrorDomain[] = "capfit";

// The one function that makes a wire status. The details (trailer grpc-status-details-bin) are a
// google.rpc.Status with ErrorInfo (a reason of v1.ErrorReason; field, value and limit as
// metadata), BadRequest where a field is at fault, RetryInfo where `retry_ms` is given, and the
// warnings that WithWarnings put there, as many as 4 KiB hold.
[[nodiscard]] grpc::Status ToGrpcStatus(const absl::Status& status,
                                        std::optional<int> retry_ms = std::nullopt);

// The way back: the same code and message, and the same FieldOf, ReasonOf, FactsOf (in the order of
// their names) and WarningsOf.
[[nodiscard]] absl::Status FromGrpcStatus(const grpc::Status& status);

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_STATUS_CONVERSION_H_
