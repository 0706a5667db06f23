// `capfit render`: a picture of a body with its primitives.
#ifndef CAPFIT_CLIENT_PICTURE_RENDER_COMMAND_H_
#define CAPFIT_CLIENT_PICTURE_RENDER_COMMAND_H_

#include <CLI/CLI.hpp>

namespace capfit::client {

// Adds the subcommand to `app`. When it is chosen it runs while the arguments are parsed, and sets
// `exit_code`: 0 done, 1 a file cannot be read or written, 2 an input or option is refused (the
// reason goes to standard error). `exit_code` must outlive the parsing.
void AddRenderCommand(CLI::App& app, int& exit_code);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_RENDER_COMMAND_H_
