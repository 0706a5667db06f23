// The contract's names of options, as the command line calls them.
#ifndef CAPFIT_CLIENT_FLAG_NAMES_H_
#define CAPFIT_CLIENT_FLAG_NAMES_H_

#include <span>
#include <string>
#include <string_view>

#include "absl/status/status.h"

namespace capfit::client {

struct FlagName {
  std::string_view path;  // "options.budget.max_primitives"
  std::string_view flag;  // "--max-primitives"
};

// All of them: each option of the contract that the command line has, and the members that
// commands check for themselves.
[[nodiscard]] std::span<const FlagName> FlagNames();

// The message of `status` with flags for paths: "options.budget.max_primitives is 3, must be in
// [15, 1000]" becomes "--max-primitives is 3, must be in [15, 1000]". Names without a dot are
// replaced only where they are the field at fault.
[[nodiscard]] std::string InFlags(const absl::Status& status);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_FLAG_NAMES_H_
