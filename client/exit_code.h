// How the subcommands end.
#ifndef CAPFIT_CLIENT_EXIT_CODE_H_
#define CAPFIT_CLIENT_EXIT_CODE_H_

#include "absl/status/status.h"

namespace capfit::client {

// 0 done; 1 the command line is wrong, or a file cannot be read or written; 2 an input or option is
// refused; 3 the server cannot be reached, is full, took too long or failed.
inline constexpr int kExitDone = 0;
inline constexpr int kExitUsage = 1;
inline constexpr int kExitRefused = 2;
inline constexpr int kExitServer = 3;

// The exit code for the outcome of a fit. Files: see FileProblem.
[[nodiscard]] int ExitCodeOf(const absl::Status& status);

// Prints an error that is not OK to stderr, with its code, and gives its exit code.
[[nodiscard]] int Report(const absl::Status& status);

// A status whose exit code is 1, with the message of `status`; OK stays OK.
[[nodiscard]] absl::Status FileProblem(const absl::Status& status);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_EXIT_CODE_H_
