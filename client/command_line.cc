#include "client/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>

#include "client/animate_command.h"
#include "client/approximate_command.h"
#include "client/arguments.h"
#include "client/batch_command.h"
#include "client/completion_command.h"
#include "client/evaluate_command.h"
#include "client/exit_code.h"
#include "client/export_command.h"
#include "client/help_format.h"
#include "client/info_command.h"
#include "client/inspect_command.h"
#include "client/load_command.h"
#include "client/picture/mannequin_command.h"
#include "client/picture/render_command.h"
#include "core/base/version.h"

namespace capfit::client {
namespace {

void AddCommands(CLI::App& app, int& exit_code) {
  app.set_version_flag("--version", std::string(Version()));
  app.set_help_all_flag("--help-all", "Print the help of all commands and exit");
  app.require_subcommand(1);
  app.footer(
      "\"-\" is standard input or output where one file is read or written.\n"
      "Lists may be separated by blanks or commas, words may be in any case.\n"
      "Exit codes: 0 done; 1 the command line is wrong, or a file cannot be read or written;\n"
      "2 an input or option is refused; 3 the server cannot be reached, is full, took too long or "
      "failed.");
  AddApproximateCommand(app, exit_code);
  AddInspectCommand(app, exit_code);
  AddEvaluateCommand(app, exit_code);
  AddExportCommand(app, exit_code);
  AddAnimateCommand(app, exit_code);
  AddRenderCommand(app, exit_code);
  AddMannequinCommand(app, exit_code);
  AddBatchCommand(app, exit_code);
  AddLoadCommand(app, exit_code);
  AddInfoCommand(app, exit_code);
  AddCompletionCommand(app, exit_code);
}

int RefuseUsage(const CLI::App& app, const std::vector<std::string>& arguments,
                const std::string& problem) {
  const CLI::App* const command = CommandOf(app, arguments);
  std::cerr << "capfit: " << problem << "\nRun 'capfit"
            << (command == nullptr ? "" : " " + command->get_name()) << " --help' for help.\n";
  return kExitUsage;
}

// A full disk or a closed pipe shows when what was printed leaves the process.
int AfterPrinting(int exit_code) {
  const bool is_streamed = !std::cout.flush().fail();
  const bool is_written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if ((is_streamed && is_written) || exit_code != kExitDone) return exit_code;
  std::cerr << "capfit: cannot write standard output\n";
  return kExitUsage;
}

}  // namespace

int RunCommandLine(const std::vector<std::string>& arguments) {
  CLI::App app{"capfit: human bodies as few spheres and tapered capsules", "capfit"};
  int exit_code = kExitDone;
  app.formatter(std::make_shared<HelpFormat>());
  AddCommands(app, exit_code);
  if (const std::string problem = UnknownName(app, arguments); !problem.empty()) {
    return RefuseUsage(app, arguments, problem);
  }
  std::vector<std::string> words = JoinLists(app, arguments);
  std::reverse(words.begin(), words.end());  // as CLI11 takes them
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return AfterPrinting(app.exit(error));  // help and version
    return RefuseUsage(app, arguments, Complaint(app, arguments, error));
  }
  return AfterPrinting(exit_code);
}

}  // namespace capfit::client
