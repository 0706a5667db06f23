// `capfit mannequin`: writes the built-in mannequin to a file.
#ifndef CAPFIT_CLIENT_PICTURE_MANNEQUIN_COMMAND_H_
#define CAPFIT_CLIENT_PICTURE_MANNEQUIN_COMMAND_H_

#include <CLI/CLI.hpp>

namespace capfit::client {

// Adds the subcommand to `app`. When it is chosen it runs while the arguments are parsed, and sets
// `exit_code`: 0 done, 1 the file cannot be written, 2 an option is refused (the reason goes to
// standard error). `exit_code` must outlive the parsing.
void AddMannequinCommand(CLI::App& app, int& exit_code);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_MANNEQUIN_COMMAND_H_
