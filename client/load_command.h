// `capfit load`: how much a server takes, and whether it stays right under it.
#ifndef CAPFIT_CLIENT_LOAD_COMMAND_H_
#define CAPFIT_CLIENT_LOAD_COMMAND_H_

#include <CLI/CLI.hpp>

namespace capfit::client {

// Adds the subcommand; running it sets `exit_code`.
void AddLoadCommand(CLI::App& app, int& exit_code);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_LOAD_COMMAND_H_
