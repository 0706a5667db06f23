// `capfit completion bash`: completion of commands, flags and words for a shell.
#ifndef CAPFIT_CLIENT_COMPLETION_COMMAND_H_
#define CAPFIT_CLIENT_COMPLETION_COMMAND_H_

#include <CLI/CLI.hpp>
#include <string>

namespace capfit::client {

// A script for bash, made from the commands and flags of `app` as they are: a flag that takes one
// of a few words completes to those, everything else to file names.
[[nodiscard]] std::string BashCompletion(const CLI::App& app);

// Adds the subcommand to `app`. It prints the script for all of the app's commands.
void AddCompletionCommand(CLI::App& app, int& exit_code);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_COMPLETION_COMMAND_H_
