// How the subcommands end.
#ifndef CAPFIT_CLIENT_EXIT_CODE_H_
#define CAPFIT_CLIENT_EXIT_CODE_H_

#include <span>

#include "absl/status/status.h"
#include "core/base/warning.h"

namespace capfit::client {

// 0 done; 1 the command line is wrong, or a file cannot be read or written; 2 an input or option is
// refused; 3 the server cannot be reached, is full, took too long or failed.
inline constexpr int kExitDone = 0;
inline constexpr int kExitUsage = 1;
inline constexpr int kExitRefused = 2;
inline constexpr int kExitServer = 3;

// NOT_FOUND is what file_bytes.h says of files.
[[nodiscard]] int ExitCodeOf(const absl::Status& status);

// Prints an error that is not OK to stderr, after the warnings that travel with it, and gives its
// exit code. Options are called by their flags (see flag_names.h); the code stands before the
// message, but for problems with files.
[[nodiscard]] int Report(const absl::Status& status);

// Prints each warning to stderr: "capfit: warning: 2 holes were closed (HOLES_CLOSED)".
void PrintWarnings(std::span<const Warning> warnings);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_EXIT_CODE_H_
