#include "core/base/error_reason.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/enum_index.h"

namespace capfit {
namespace {

using absl::StatusCode;

constexpr std::array kReasons = {
    KnownReason{ErrorReason::kMissing, "MISSING", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kOutOfRange, "OUT_OF_RANGE", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kNotFinite, "NOT_FINITE", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kUnknownValue, "UNKNOWN_VALUE", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kDuplicate, "DUPLICATE", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kConflict, "CONFLICT", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kOutOfOrder, "OUT_OF_ORDER", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kTooLarge, "TOO_LARGE", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kCountMismatch, "COUNT_MISMATCH", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kMalformedFile, "MALFORMED_FILE", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kUnsupportedFile, "UNSUPPORTED_FILE", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kBudgetTooSmall, "BUDGET_TOO_SMALL", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kContradictsBody, "CONTRADICTS_BODY", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kMalformedMessage, "MALFORMED_MESSAGE", StatusCode::kInvalidArgument},
    KnownReason{ErrorReason::kNotABody, "NOT_A_BODY", StatusCode::kFailedPrecondition},
    KnownReason{ErrorReason::kUnitUnknown, "UNIT_UNKNOWN", StatusCode::kFailedPrecondition},
    KnownReason{ErrorReason::kPartMissing, "PART_MISSING", StatusCode::kFailedPrecondition},
    KnownReason{ErrorReason::kNothingToFit, "NOTHING_TO_FIT", StatusCode::kFailedPrecondition},
    KnownReason{ErrorReason::kNoSurface, "NO_SURFACE", StatusCode::kFailedPrecondition},
    KnownReason{ErrorReason::kNoVolume, "NO_VOLUME", StatusCode::kFailedPrecondition},
    KnownReason{ErrorReason::kTwoBodies, "TWO_BODIES", StatusCode::kFailedPrecondition},
    KnownReason{ErrorReason::kNotOrientable, "NOT_ORIENTABLE", StatusCode::kFailedPrecondition},
    KnownReason{ErrorReason::kHoleNotClosed, "HOLE_NOT_CLOSED", StatusCode::kFailedPrecondition},
    KnownReason{ErrorReason::kOpenSurface, "OPEN_SURFACE", StatusCode::kFailedPrecondition},
    KnownReason{ErrorReason::kNotManifold, "NOT_MANIFOLD", StatusCode::kFailedPrecondition},
    KnownReason{ErrorReason::kNotImplemented, "NOT_IMPLEMENTED", StatusCode::kUnimplemented},
    KnownReason{ErrorReason::kUnauthenticated, "UNAUTHENTICATED", StatusCode::kUnauthenticated},
    KnownReason{ErrorReason::kServerFull, "SERVER_FULL", StatusCode::kResourceExhausted},
    KnownReason{ErrorReason::kOutOfMemory, "OUT_OF_MEMORY", StatusCode::kResourceExhausted},
    KnownReason{ErrorReason::kServerStopping, "SERVER_STOPPING", StatusCode::kUnavailable},
    KnownReason{ErrorReason::kCancelled, "CANCELLED", StatusCode::kCancelled},
    KnownReason{ErrorReason::kDeadlineExceeded, "DEADLINE_EXCEEDED", StatusCode::kDeadlineExceeded},
    KnownReason{ErrorReason::kUploadTooSlow, "UPLOAD_TOO_SLOW", StatusCode::kDeadlineExceeded},
    KnownReason{ErrorReason::kReaderTooSlow, "READER_TOO_SLOW", StatusCode::kDeadlineExceeded},
    KnownReason{ErrorReason::kFitTooLong, "FIT_TOO_LONG", StatusCode::kDeadlineExceeded},
    KnownReason{ErrorReason::kInternal, "INTERNAL", StatusCode::kInternal},
};
static_assert(kReasons.size() == Index(ErrorReason::kInternal) + 1);

}  // namespace

std::span<const KnownReason> ErrorReasons() { return kReasons; }

std::string_view ErrorReasonName(ErrorReason reason) { return kReasons[Index(reason)].name; }

std::optional<ErrorReason> ErrorReasonFromName(std::string_view name) {
  const auto found = std::find_if(kReasons.begin(), kReasons.end(),
                                  [&](const KnownReason& known) { return known.name == name; });
  if (found == kReasons.end()) return std::nullopt;
  return found->reason;
}

}  // namespace capfit
