#include "client/inspect_command.h"

#include <cstdio>
#include <memory>
#include <string>

#include "client/approximate_flags.h"
#include "client/exit_code.h"
#include "client/inspection.h"
#include "client/picture/result_body.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

struct InspectArguments {
  std::string body;
  pipeline::FitOptions options;
  bool as_json = false;
};

absl::Status RunInspect(const InspectArguments& arguments) {
  CAPFIT_ASSIGN_OR_RETURN(const formats::PolygonSoup soup, ReadBodyFile(arguments.body));
  const Inspection inspection = Inspect(soup, arguments.options, ThreadPool());
  const std::string report =
      arguments.as_json ? InspectionJson(inspection) : InspectionTable(inspection);
  std::fputs(report.c_str(), stdout);
  return inspection.status;
}

}  // namespace

void AddInspectCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<InspectArguments>();
  CLI::App* const command = app.add_subcommand(
      "inspect", "Show parts, skeleton, unit and pose of a file, and what a fit makes of them");
  command->add_option("BODY", arguments->body, "Mesh file")->required()->type_name("FILE");
  AddFrameFlags(*command, arguments->options.unit, arguments->options.up);
  AddCharacterFlags(*command, arguments->options.character);
  command->add_flag("--json", arguments->as_json, "Print JSON instead of a table");
  command->callback([arguments, &exit_code] { exit_code = Report(RunInspect(*arguments)); });
}

}  // namespace capfit::client
