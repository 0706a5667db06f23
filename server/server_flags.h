// The command line of capfit-server.
#ifndef CAPFIT_SERVER_SERVER_FLAGS_H_
#define CAPFIT_SERVER_SERVER_FLAGS_H_

#include <optional>

#include "absl/status/status.h"
#include "server/server_config.h"

namespace capfit::server {

// Fills `config` from the flags, the environment and the file of settings (see settings.h). Gives
// the exit code where the program has to end here: 0 after --help, --version, --print-config and a
// good --check-config, 1 for a wrong setting, named on stderr. `capfit-server --help` lists all.
[[nodiscard]] std::optional<int> ParseFlags(int argc, const char* const* argv,
                                            ServerConfig& config);

// What can be known to be wrong before anything is listened on: an address that is open to others
// without protection (FAILED_PRECONDITION), certificates and tokens (INVALID_ARGUMENT).
[[nodiscard]] absl::Status CheckConfig(const ServerConfig& config);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_SERVER_FLAGS_H_
