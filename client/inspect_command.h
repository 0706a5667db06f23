// `capfit inspect`: what is in a file, and what a fit would make of it.
#ifndef CAPFIT_CLIENT_INSPECT_COMMAND_H_
#define CAPFIT_CLIENT_INSPECT_COMMAND_H_

#include <CLI/CLI.hpp>

namespace capfit::client {

// Adds the subcommand; after parsing, it has run and left its exit code.
void AddInspectCommand(CLI::App& app, int& exit_code);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_INSPECT_COMMAND_H_
