// The command line of capfit-server.
#ifndef CAPFIT_SERVER_SERVER_FLAGS_H_
#define CAPFIT_SERVER_SERVER_FLAGS_H_

#include <optional>

#include "server/server_config.h"

namespace capfit::server {

// Fills `config`. Gives the exit code where the program has to end here: 0 after --help and
// --version, 1 for a wrong flag, named on stderr. `capfit-server --help` lists the flags.
[[nodiscard]] std::optional<int> ParseFlags(int argc, const char* const* argv,
                                            ServerConfig& config);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_SERVER_FLAGS_H_
