#include "client/load_command.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/approximate_flags.h"
#include "client/exit_code.h"
#include "client/load_calls.h"
#include "client/load_report.h"
#include "client/load_run.h"
#include "client/picture/file_bytes.h"
#include "client/picture/write_mesh.h"
#include "client/server_flags.h"
#include "core/base/number_in.h"
#include "core/base/status.h"
#include "core/mannequin/mannequin.h"

namespace capfit::client {
namespace {

constexpr char kGroup[] = "Load";

struct LoadArguments {
  std::vector<std::string> files;
  std::vector<int> faces = {4'000, 20'000, 60'000};
  FitFlags fit;
  ServerFlags server;
  LoadPlan plan;
  double timeout_seconds = 300.0;
  int max_attempts = 1;
  bool is_streamed = false;
  bool is_local = false;
  bool is_strict = false;
  bool takes_kept = false;
  std::string json;
};

absl::StatusOr<std::vector<LoadBody>> Bodies(const LoadArguments& arguments) {
  std::vector<LoadBody> bodies;
  for (const std::string& path : arguments.files) {
    CAPFIT_ASSIGN_OR_RETURN(std::string bytes, ReadFileBytes(path));
    bodies.push_back({std::filesystem::path(path).filename().string(), std::move(bytes)});
  }
  if (!bodies.empty()) return bodies;
  for (const int faces : arguments.faces) {
    mannequin::MannequinOptions options;
    options.faces = faces;
    CAPFIT_ASSIGN_OR_RETURN(const formats::PolygonSoup soup, mannequin::MakeMannequin(options));
    bodies.push_back({absl::StrCat("mannequin_", faces), PlyBytes(soup)});
  }
  return bodies;
}

absl::StatusOr<LoadCall> CallOf(const LoadArguments& arguments) {
  LoadCallOptions options;
  CAPFIT_ASSIGN_OR_RETURN(options.fit, OptionsOf(arguments.fit));
  options.timeout_seconds = arguments.timeout_seconds;
  options.max_attempts = arguments.max_attempts;
  options.is_fresh = !arguments.takes_kept;
  if (arguments.is_local) return LocalLoad(options);
  return arguments.is_streamed ? StreamedLoad(arguments.server, options)
                               : UnaryLoad(arguments.server, options);
}

absl::Status RunLoadCommand(const LoadArguments& arguments) {
  CAPFIT_ASSIGN_OR_RETURN(const std::vector<LoadBody> bodies, Bodies(arguments));
  CAPFIT_ASSIGN_OR_RETURN(const LoadCall call, CallOf(arguments));
  if (!arguments.json.empty()) CAPFIT_RETURN_IF_ERROR(CheckWritable(arguments.json));
  const LoadTally tally = RunLoad(bodies, arguments.plan, call);
  if (!arguments.json.empty()) {
    CAPFIT_RETURN_IF_ERROR(WriteFileBytes(arguments.json, LoadJson(tally, bodies)));
  }
  std::fputs(LoadTable(tally, bodies).c_str(), arguments.json == "-" ? stderr : stdout);
  if (tally.IsGood(arguments.is_strict)) return absl::OkStatus();
  return absl::AbortedError("calls failed or results were wrong, see the table");
}

void AddPlanFlags(CLI::App& command, LoadArguments& arguments) {
  LoadPlan& plan = arguments.plan;
  command.add_option("--duration", plan.seconds, "Seconds within which calls begin")
      ->check(NumberIn(0.1, 86'400.0))
      ->capture_default_str()
      ->group(kGroup);
  command.add_option("--clients", plan.clients, "Calls at a time; with --rate at most")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--rate", plan.rate,
                  "Calls a second, whatever the answers do (open loop); without it each client "
                  "calls again when it has its answer (closed loop)")
      ->check(NumberIn(0.01, 100'000.0))
      ->group(kGroup);
  command.add_option("--order-seed", plan.seed, "Seed of the order of bodies")
      ->check(SeedCheck())
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--attempts", arguments.max_attempts,
                  "Attempts of a call that is refused or breaks; 1: each is counted")
      ->check(CLI::Range(1, 100))
      ->capture_default_str()
      ->group(kGroup);
  command.add_flag("--stream", arguments.is_streamed, "Upload in chunks, by the streamed call")
      ->group(kGroup);
  command
      .add_flag("--local", arguments.is_local,
                "Fit in this process on all its cores: what a server there is measured by")
      ->group(kGroup);
  command.add_flag("--strict", arguments.is_strict, "Refused calls are failures too")
      ->group(kGroup);
  command
      .add_flag("--cached", arguments.takes_kept,
                "Take results that the server has kept too; without it each call is a fit")
      ->group(kGroup);
  command.add_option("--json", arguments.json, "File for the figures as JSON, times in seconds")
      ->type_name("FILE")
      ->group(kGroup);
}

}  // namespace

void AddLoadCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<LoadArguments>();
  CLI::App* const command =
      app.add_subcommand("load", "Call a server many times; check and time every answer");
  command->add_option("BODY", arguments->files, "Mesh files; without any: mannequins")
      ->type_name("FILE")
      ->group("Input");
  command->add_option("--faces", arguments->faces, "Faces of the mannequins")
      ->delimiter(',')
      ->check(CLI::Range(2000, 500'000))
      ->capture_default_str()
      ->group("Input");
  AddPlanFlags(*command, *arguments);
  AddServerFlags(*command, arguments->server);
  AddTimeoutFlag(*command, arguments->timeout_seconds, "Seconds that one call may take")
      ->group("Server");
  AddFitFlags(*command, arguments->fit);
  command->footer(
      "Exit code 0: every result was right, the same bits for the same body, and calls failed only "
      "as a full server refuses them (RESOURCE_EXHAUSTED with the time to come again).");
  command->callback([arguments, &exit_code] { exit_code = Report(RunLoadCommand(*arguments)); });
}

}  // namespace capfit::client
