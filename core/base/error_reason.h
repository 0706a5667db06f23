// Why something was refused: one vocabulary for the core, the server and every client.
#ifndef CAPFIT_CORE_BASE_ERROR_REASON_H_
#define CAPFIT_CORE_BASE_ERROR_REASON_H_

#include <optional>
#include <span>
#include <string_view>

#include "absl/status/status.h"

namespace capfit {

// Meanings: docs/errors.md. The first group goes with INVALID_ARGUMENT, the second with
// FAILED_PRECONDITION, the third with the code that ErrorReasons() names.
enum class ErrorReason {
  kMissing,
  kOutOfRange,
  kNotFinite,
  kUnknownValue,
  kDuplicate,
  kConflict,
  kOutOfOrder,
  kTooLarge,
  kCountMismatch,
  kMalformedFile,
  kUnsupportedFile,
  kBudgetTooSmall,
  kContradictsBody,
  kMalformedMessage,

  kNotABody,
  kUnitUnknown,
  kPartMissing,
  kNothingToFit,
  kNoSurface,
  kNoVolume,
  kTwoBodies,
  kNotOrientable,
  kHoleNotClosed,
  kOpenSurface,
  kNotManifold,

  kNotImplemented,
  kUnauthenticated,
  kServerFull,
  kOutOfMemory,
  kServerStopping,
  kCancelled,
  kDeadlineExceeded,
  kUploadTooSlow,
  kReaderTooSlow,
  kFitTooLong,
  kInternal
};

struct KnownReason {
  ErrorReason reason;
  std::string_view name;  // "OUT_OF_RANGE": the word on the wire
  absl::StatusCode code;
};

// All of them, in the order of the enum.
[[nodiscard]] std::span<const KnownReason> ErrorReasons();

[[nodiscard]] std::string_view ErrorReasonName(ErrorReason reason);
// Nothing for a word that this version does not know.
[[nodiscard]] std::optional<ErrorReason> ErrorReasonFromName(std::string_view name);

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_ERROR_REASON_H_
