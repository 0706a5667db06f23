// `capfit evaluate`: the quality report of any result, of capfit or of another program.
#ifndef CAPFIT_CLIENT_EVALUATE_COMMAND_H_
#define CAPFIT_CLIENT_EVALUATE_COMMAND_H_

#include <CLI/CLI.hpp>

namespace capfit::client {

// Adds the subcommand to `app`. When it is chosen it runs while the arguments are parsed, and sets
// `exit_code` (see exit_code.h), which must outlive the parsing.
void AddEvaluateCommand(CLI::App& app, int& exit_code);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_EVALUATE_COMMAND_H_
