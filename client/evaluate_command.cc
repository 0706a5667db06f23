#include "client/evaluate_command.h"

#include <cstdio>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "client/approximate_flags.h"
#include "client/exit_code.h"
#include "client/picture/belongs.h"
#include "client/picture/file_bytes.h"
#include "client/picture/result_body.h"
#include "client/picture/result_set.h"
#include "client/result_json.h"
#include "client/result_table.h"
#include "core/base/status.h"
#include "core/body/body_unit.h"
#include "core/body/find_body.h"
#include "core/coverage/cover_body.h"
#include "core/metrics/measure.h"

namespace capfit::client {
namespace {

constexpr double kGapToleranceM = 1e-5;

struct EvaluateArguments {
  std::string body;
  std::string result;
  body::BodyOptions frame;
  std::vector<std::string> parts;
  int threads = 0;
  bool as_json = false;
};

// The body, which must be that of the result; in the result's unit where nothing else is told.
absl::StatusOr<body::Body> LoadBody(const EvaluateArguments& arguments, const ResultSet& result,
                                    const ThreadPool& pool) {
  CAPFIT_ASSIGN_OR_RETURN(const formats::PolygonSoup soup, ReadBodyFile(arguments.body));
  CAPFIT_RETURN_IF_ERROR(CheckBelongs(result, soup));
  body::BodyOptions frame = arguments.frame;
  if (frame.unit == body::Unit::kAuto && result.metres_per_unit) {
    frame.unit = body::UnitOf(*result.metres_per_unit);
  }
  CAPFIT_ASSIGN_OR_RETURN(pipeline::TakenBody taken,
                          UnderstandBody(soup, result.character, frame.unit, frame.up, pool));
  return std::move(taken.body);
}

absl::Status RunEvaluate(const EvaluateArguments& arguments) {
  const ThreadPool pool(arguments.threads);
  CAPFIT_ASSIGN_OR_RETURN(const std::string text, ReadFileBytes(arguments.result));
  CAPFIT_ASSIGN_OR_RETURN(const ResultSet result, ParseResultSet(text));
  if (result.spheres.empty()) {
    return InvalidField(ErrorReason::kMissing, arguments.result,
                        "has no spheres, so there is nothing to measure");
  }
  CAPFIT_ASSIGN_OR_RETURN(const body::Body body, LoadBody(arguments, result, pool));
  const capsule::PrimitiveSet set = InBodyFrame(result, body.body_from_caller);
  metrics::MeasureOptions options;
  options.parts = arguments.parts.empty() ? PartsOfResult(result) : PartsOf(arguments.parts);
  metrics::Metrics metrics = metrics::Measure(body, set, options, pool, NullObserver());
  metrics.max_gap_m =
      coverage::CertifiedGap(tighten::TargetOf(body, options.parts), set, kGapToleranceM, pool);
  const std::string report = arguments.as_json ? FormatMetrics(metrics) + "\n"
                                               : PartsTable(metrics) + "\n" + MetricsTable(metrics);
  std::fputs(report.c_str(), stdout);
  return absl::OkStatus();
}

}  // namespace

void AddEvaluateCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* const command =
      app.add_subcommand("evaluate", "Measure a result, of capfit or of any other program");
  command->add_option("BODY", arguments->body, "Mesh file")->required()->type_name("FILE");
  command
      ->add_option("RESULT", arguments->result,
                   "RESULT.json of this body, of capfit or with spheres and capsules alone")
      ->required()
      ->type_name("FILE");
  AddFrameFlags(*command, arguments->frame.unit, arguments->frame.up);
  AddPartsFlag(*command, arguments->parts);
  command->get_option("--parts")->description(
      "Parts that the set is meant to cover [those that RESULT was asked for]");
  command
      ->add_option("--threads", arguments->threads,
                   "Threads; 0: one per core, within a container's quota")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  command->add_flag("--json", arguments->as_json,
                    "Print the object \"metrics\" of RESULT.json instead of a table");
  command->callback([arguments, &exit_code] { exit_code = Report(RunEvaluate(*arguments)); });
}

}  // namespace capfit::client
