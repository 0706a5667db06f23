#include "client/approximate_command.h"

#include <cstdio>
#include <memory>
#include <span>
#include <string>

#include "client/approximate_flags.h"
#include "client/body_client.h"
#include "client/exit_code.h"
#include "client/picture/file_bytes.h"
#include "client/picture/gaps_file.h"
#include "client/progress_line.h"
#include "client/result_json.h"
#include "client/result_table.h"
#include "client/weights_output.h"
#include "core/base/status.h"
#include "core/mesh/read_mesh.h"

namespace capfit::client {
namespace {

struct ApproximateArguments {
  std::string body;
  std::string output;
  std::string server = "127.0.0.1:50051";
  bool is_local = false;
  int threads = 0;
  double timeout_seconds = 300.0;
  std::string request_id;
  bool progress = false;
  bool quiet = false;
  FitFlags fit;
};

absl::StatusOr<pipeline::FitResult> FitHere(std::span<const std::byte> bytes,
                                            mesh::MeshFormat format,
                                            const pipeline::FitOptions& options,
                                            const ApproximateArguments& arguments,
                                            ProgressLine& progress) {
  CAPFIT_RETURN_IF_ERROR(pipeline::ValidateOptions(options));
  CAPFIT_ASSIGN_OR_RETURN(const mesh::PolygonSoup soup, mesh::ReadMesh(bytes, format));
  return pipeline::Fit(soup, options, ThreadPool(arguments.threads), progress);
}

absl::StatusOr<pipeline::FitResult> FitThere(std::span<const std::byte> bytes,
                                             mesh::MeshFormat format,
                                             const pipeline::FitOptions& options,
                                             const ApproximateArguments& arguments,
                                             ProgressLine& progress) {
  CallOptions call;
  call.timeout_seconds = arguments.timeout_seconds;
  call.request_id = arguments.request_id;
  call.on_progress = [&progress](Stage stage, double done) { progress.OnStage(stage, done); };
  return BodyClient::Connect(arguments.server).ApproximateFile(bytes, format, options, call);
}

absl::StatusOr<pipeline::FitResult> FitBody(const ApproximateArguments& arguments) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string file, ReadFileBytes(arguments.body));
  CAPFIT_ASSIGN_OR_RETURN(const pipeline::FitOptions options, OptionsOf(arguments.fit));
  const mesh::MeshFormat format = mesh::FormatFromFileName(arguments.body);
  const std::span<const std::byte> bytes = std::as_bytes(std::span(file));
  ProgressLine progress(arguments.progress || (StderrIsTerminal() && !arguments.quiet));
  return arguments.is_local ? FitHere(bytes, format, options, arguments, progress)
                            : FitThere(bytes, format, options, arguments, progress);
}

absl::Status RunApproximate(const ApproximateArguments& arguments) {
  CAPFIT_ASSIGN_OR_RETURN(const pipeline::FitResult result, FitBody(arguments));
  CAPFIT_RETURN_IF_ERROR(FileProblem(WriteFileBytes(arguments.output, FormatResult(result))));
  if (result.weights) {
    CAPFIT_RETURN_IF_ERROR(WriteWeights(*result.weights, arguments.output));
  }
  if (!result.vertex_gaps.empty()) {
    CAPFIT_RETURN_IF_ERROR(FileProblem(
        WriteVertexGaps(result.vertex_gaps, result.body_from_caller.scale, arguments.output)));
  }
  if (!arguments.quiet) std::fputs(ResultTable(result).c_str(), stdout);
  return absl::OkStatus();
}

void AddPlaceFlags(CLI::App& command, ApproximateArguments& arguments) {
  CLI::Option* const server =
      command.add_option("--server", arguments.server, "HOST:PORT of the server that fits")
          ->capture_default_str();
  CLI::Option* const local =
      command.add_flag("--local", arguments.is_local, "Fit in this process, without a server");
  local->excludes(server);
  command.add_option("--threads", arguments.threads, "With --local: threads; 0: one per core")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  command
      .add_option("--timeout", arguments.timeout_seconds,
                  "With a server: seconds that the whole call may take")
      ->check(CLI::Range(0.001, 86'400.0))
      ->capture_default_str();
  command.add_option("--request-id", arguments.request_id,
                     "With a server: name of this job in its logs");
}

}  // namespace

void AddApproximateCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<ApproximateArguments>();
  CLI::App* const command = app.add_subcommand(
      "approximate", "Fit spheres and tapered capsules to a body; write RESULT.json");
  command->add_option("BODY", arguments->body, "Mesh file: .obj, .ply, .stl, .off or .glb")
      ->required();
  command->add_option("-o,--output", arguments->output, "RESULT.json to write")->required();
  AddPlaceFlags(*command, *arguments);
  AddFitFlags(*command, arguments->fit);
  command->add_flag("--polygons", arguments->fit.options.want_polygons,
                    "Write the feature polygons with their circles too");
  command->add_flag("--progress", arguments->progress, "Show progress though no terminal reads it");
  command->add_flag("--quiet", arguments->quiet, "Print no table");
  command->callback([arguments, &exit_code] { exit_code = Report(RunApproximate(*arguments)); });
}

}  // namespace capfit::client
