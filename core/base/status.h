// Errors as values: a reason, what, where and the limit, in the message for people and as payloads
// for programs.
#ifndef CAPFIT_CORE_BASE_STATUS_H_
#define CAPFIT_CORE_BASE_STATUS_H_

#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "core/base/error_reason.h"
#include "core/base/warning.h"

namespace capfit {

// What else an error tells, by name: "value" (what it is), "limit" (what it may be), for files
// "line", or "element" and "row".
using ErrorFacts = std::vector<std::pair<std::string, std::string>>;

// An error of the code that belongs to `reason`. The reason travels as a payload and becomes
// google.rpc.ErrorInfo.reason.
[[nodiscard]] absl::Status Refused(ErrorReason reason, const std::string& message,
                                   const ErrorFacts& facts = {});

// INVALID_ARGUMENT "<field> <problem>". The field is a path as in the wire's request
// ("options.budget.max_primitives", "mesh.arrays.positions[22]"; "mesh.file" for what is in a
// file); it travels as a payload and becomes google.rpc.BadRequest and metadata.
[[nodiscard]] absl::Status InvalidField(ErrorReason reason, const std::string& field,
                                        const std::string& problem, const ErrorFacts& facts = {});

// "<field> is <value>, must be in [<low>, <high>]". The value has as many digits as tell it from
// both ends; one that is not finite has a reason of its own.
[[nodiscard]] absl::Status OutOfRange(const std::string& field, double value, double low,
                                      double high);
template <std::integral Number>
[[nodiscard]] absl::Status OutOfRange(const std::string& field, Number value, Number low,
                                      Number high) {
  const std::string range = absl::StrCat("[", low, ", ", high, "]");
  return InvalidField(ErrorReason::kOutOfRange, field,
                      absl::StrCat("is ", value, ", must be in ", range),
                      {{"value", absl::StrCat(value)}, {"limit", range}});
}

// "<field> is <value>, must be below <end>": an index that refers to nothing.
template <typename Index, typename End>
[[nodiscard]] absl::Status IndexOutOfRange(const std::string& field, Index value, End end) {
  return InvalidField(ErrorReason::kOutOfRange, field,
                      absl::StrCat("is ", value, ", must be below ", end),
                      {{"value", absl::StrCat(value)}, {"limit", absl::StrCat("[0, ", end, ")")}});
}

// "<field> has <count> <what>, must have at most <limit>".
template <typename Count, typename Limit>
[[nodiscard]] absl::Status TooLarge(const std::string& field, Count count, const std::string& what,
                                    Limit limit) {
  return InvalidField(ErrorReason::kTooLarge, field,
                      absl::StrCat("has ", count, " ", what, ", must have at most ", limit),
                      {{"value", absl::StrCat(count)}, {"limit", absl::StrCat(limit)}});
}

// The same error about the same field under another name.
[[nodiscard]] absl::Status WithField(const absl::Status& status, const std::string& field);

// The payloads, where present.
[[nodiscard]] std::optional<std::string> FieldOf(const absl::Status& status);
[[nodiscard]] std::optional<ErrorReason> ReasonOf(const absl::Status& status);
[[nodiscard]] ErrorFacts FactsOf(const absl::Status& status);

// The same error with what had been noticed before it happened; OK stays OK.
[[nodiscard]] absl::Status WithWarnings(absl::Status status, std::span<const Warning> warnings);
[[nodiscard]] std::vector<Warning> WarningsOf(const absl::Status& status);

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
