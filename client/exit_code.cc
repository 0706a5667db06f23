#include "client/exit_code.h"

#include <cstdio>
#include <string>

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
  if (!status.ok()) {
    std::fprintf(stderr, "capfit: %s: %s\n", absl::StatusCodeToString(status.code()).c_str(),
                 std::string(status.message()).c_str());
  }
  return ExitCodeOf(status);
}

absl::Status FileProblem(const absl::Status& status) {
  return status.ok() ? status : absl::NotFoundError(status.message());
}

}  // namespace capfit::client
