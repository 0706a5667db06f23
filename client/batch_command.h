// `capfit batch`: a catalogue of bodies through one server or many.
#ifndef CAPFIT_CLIENT_BATCH_COMMAND_H_
#define CAPFIT_CLIENT_BATCH_COMMAND_H_

#include <CLI/CLI.hpp>

namespace capfit::client {

// Adds the subcommand; running it sets `exit_code`.
void AddBatchCommand(CLI::App& app, int& exit_code);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_BATCH_COMMAND_H_
