// Errors as values: what, where and the limit, with the offending field as a payload.
#ifndef CAPFIT_CORE_BASE_STATUS_H_
#define CAPFIT_CORE_BASE_STATUS_H_

#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace capfit {

// INVALID_ARGUMENT "<field> <problem>", e.g. InvalidField("triangle_indices[17]", "is 90210, must
// be below 6890"). The field name travels as a payload, so that the server can fill
// google.rpc.BadRequest.
[[nodiscard]] absl::Status InvalidField(const std::string& field, const std::string& problem);

// FAILED_PRECONDITION for input that is well formed but that capfit cannot fit ("not a human
// body"). `reason` is a stable UPPER_SNAKE_CASE word (e.g. "NOT_A_BODY") that travels as a payload
// and becomes google.rpc.ErrorInfo.reason.
[[nodiscard]] absl::Status CannotFit(const std::string& reason, const std::string& message);

// The payloads of the two above, where present.
[[nodiscard]] std::optional<std::string> FieldOf(const absl::Status& status);
[[nodiscard]] std::optional<std::string> ReasonOf(const absl::Status& status);

}  // namespace capfit

#define CAPFIT_CONCAT_INNER(a, b) a##b
#define CAPFIT_CONCAT(a, b) CAPFIT_CONCAT_INNER(a, b)

// Returns from the calling function when `expression` is not OK.
#define CAPFIT_RETURN_IF_ERROR(expression)                                  \
  do {                                                                      \
    if (absl::Status status_ = (expression); !status_.ok()) return status_; \
  } while (false)

// CAPFIT_ASSIGN_OR_RETURN(auto mesh, BodyMesh::Create(soup));
#define CAPFIT_ASSIGN_OR_RETURN(declaration, expression) \
  CAPFIT_ASSIGN_OR_RETURN_INNER(CAPFIT_CONCAT(status_or_, __LINE__), declaration, expression)
#define CAPFIT_ASSIGN_OR_RETURN_INNER(temporary, declaration, expression) \
  auto temporary = (expression);                                          \
  if (!temporary.ok()) return std::move(temporary).status();              \
  declaration = *std::move(temporary)

#endif  // CAPFIT_CORE_BASE_STATUS_H_
