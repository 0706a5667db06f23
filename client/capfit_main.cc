// The command line `capfit`.
#include <CLI/CLI.hpp>

#include "client/animate_command.h"
#include "client/approximate_command.h"
#include "client/evaluate_command.h"
#include "client/exit_code.h"
#include "client/info_command.h"
#include "client/picture/mannequin_command.h"
#include "client/picture/render_command.h"
#include "core/base/version.h"

int main(int argc, char** argv) {
  CLI::App app{"capfit: human bodies as few spheres and tapered capsules"};
  app.set_version_flag("--version", std::string(capfit::Version()));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done; 1 the command line is wrong, or a file cannot be read or written;\n"
      "2 an input or option is refused; 3 the server cannot be reached, is full, took too long or "
      "failed.");
  int exit_code = capfit::client::kExitDone;
  capfit::client::AddApproximateCommand(app, exit_code);
  capfit::client::AddEvaluateCommand(app, exit_code);
  capfit::client::AddAnimateCommand(app, exit_code);
  capfit::client::AddRenderCommand(app, exit_code);
  capfit::client::AddMannequinCommand(app, exit_code);
  capfit::client::AddInfoCommand(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? capfit::client::kExitDone : capfit::client::kExitUsage;
  }
  return exit_code;
}
