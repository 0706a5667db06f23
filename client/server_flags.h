// Flags and words of the commands that call a server.
#ifndef CAPFIT_CLIENT_SERVER_FLAGS_H_
#define CAPFIT_CLIENT_SERVER_FLAGS_H_

#include <CLI/CLI.hpp>
#include <string>

#include "absl/status/status.h"

namespace capfit::client {

inline constexpr char kDefaultServer[] = "127.0.0.1:50051";

// --server: an address as WithPort (core/base/host_and_port.h) takes it, made whole.
CLI::Option* AddServerFlag(CLI::App& command, std::string& server);

// --timeout, in seconds.
CLI::Option* AddTimeoutFlag(CLI::App& command, double& seconds, const std::string& help);

// Where nobody answers at `server`: the same error with what to try. `without` is the flag that
// does without a server; "" for none.
[[nodiscard]] absl::Status WithServerAdvice(const absl::Status& status, const std::string& server,
                                            const std::string& without);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_SERVER_FLAGS_H_
