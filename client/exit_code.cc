#include "client/exit_code.h"

#include <cstdio>
#include <string>

#include "client/flag_names.h"
#include "core/base/status.h"

namespace capfit::client {

int ExitCodeOf(const absl::Status& status) {
  switch (status.code()) {
    case absl::StatusCode::kOk:
      return kExitDone;
    case absl::StatusCode::kNotFound:
      return kExitUsage;
    case absl::StatusCode::kInvalidArgument:
    case absl::StatusCode::kFailedPrecondition:
    case absl::StatusCode::kOutOfRange:
    case absl::StatusCode::kUnimplemented:
      return kExitRefused;
    default:
      return kExitServer;
  }
}

int Report(const absl::Status& status) {
  PrintWarnings(WarningsOf(status));
  if (!status.ok()) {
    const std::string code =
        absl::IsNotFound(status) ? "" : absl::StatusCodeToString(status.code()) + ": ";
    std::fprintf(stderr, "capfit: %s%s\n", code.c_str(), InFlags(status).c_str());
  }
  return ExitCodeOf(status);
}

void PrintWarnings(std::span<const Warning> warnings) {
  for (const Warning& warning : warnings) {
    std::fprintf(stderr, "capfit: warning: %s (%s)\n", warning.message.c_str(),
                 warning.code.c_str());
  }
}

}  // namespace capfit::client
