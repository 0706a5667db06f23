#include "client/approximate_command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "client/approximate_flags.h"
#include "client/body_client.h"
#include "client/exit_code.h"
#include "client/export_command.h"
#include "client/motion_input.h"
#include "client/picture/centers_file.h"
#include "client/picture/file_bytes.h"
#include "client/picture/gaps_file.h"
#include "client/progress_line.h"
#include "client/result_json.h"
#include "client/result_table.h"
#include "client/server_flags.h"
#include "client/weights_output.h"
#include "core/base/number_in.h"
#include "core/base/status.h"
#include "core/formats/read_mesh.h"
#include "core/pipeline/colliders.h"

namespace capfit::client {
namespace {

struct ApproximateArguments {
  std::string body;
  std::string output;
  ServerFlags server;
  bool is_local = false;
  int threads = 0;
  double timeout_seconds = 300.0;
  std::string request_id;
  bool progress = false;
  bool quiet = false;
  std::string cover_motion;  // empty: none
  std::string frame_radii;   // file; empty: radii hold in all frames
  double fps = 30.0;
  FitFlags fit;
};

absl::StatusOr<pipeline::FitResult> FitHere(std::span<const std::byte> bytes,
                                            formats::MeshFormat format,
                                            const pipeline::FitOptions& asked,
                                            const ApproximateArguments& arguments,
                                            ProgressLine& progress) {
  CAPFIT_RETURN_IF_ERROR(pipeline::ValidateOptions(asked));
  CAPFIT_RETURN_IF_ERROR(pipeline::CheckExports(asked.exports, bytes));
  const ThreadPool pool(arguments.threads);  // its threads start while the file is read
  CAPFIT_ASSIGN_OR_RETURN(const formats::PolygonSoup soup, formats::ReadMesh(bytes, format));
  pipeline::FitOptions options = asked;
  if (!arguments.cover_motion.empty()) {
    CAPFIT_ASSIGN_OR_RETURN(
        options.motion, ReadMotion(arguments.cover_motion, arguments.fps,
                                   arguments.frame_radii.empty() ? motion::MotionRadii::kConstant
                                                                 : motion::MotionRadii::kPerFrame,
                                   bytes, soup));
  }
  CAPFIT_ASSIGN_OR_RETURN(pipeline::FitResult result, pipeline::Fit(soup, options, pool, progress));
  const std::string source =
      arguments.body == "-" ? "body" : std::filesystem::path(arguments.body).stem().string();
  CAPFIT_RETURN_IF_ERROR(pipeline::AddExports(options.exports, bytes, source, result));
  return result;
}

absl::StatusOr<pipeline::FitResult> FitThere(std::span<const std::byte> bytes,
                                             formats::MeshFormat format,
                                             const pipeline::FitOptions& options,
                                             const ApproximateArguments& arguments,
                                             ProgressLine& progress) {
  CallOptions call;
  call.timeout_seconds = arguments.timeout_seconds;
  call.request_id = arguments.request_id;
  call.on_progress = [&progress](Stage stage, double done) { progress.OnStage(stage, done); };
  CAPFIT_ASSIGN_OR_RETURN(const BodyClient client, ConnectTo(arguments.server));
  return client.ApproximateFile(bytes, format, options, call);
}

absl::StatusOr<pipeline::FitResult> FitBody(const ApproximateArguments& arguments) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string file, ReadFileBytes(arguments.body));
  CAPFIT_ASSIGN_OR_RETURN(const pipeline::FitOptions options, OptionsOf(arguments.fit));
  const formats::MeshFormat format = formats::FormatFromFileName(arguments.body);
  const std::span<const std::byte> bytes = std::as_bytes(std::span(file));
  ProgressLine progress(arguments.progress || (StderrIsTerminal() && !arguments.quiet));
  return arguments.is_local ? FitHere(bytes, format, options, arguments, progress)
                            : FitThere(bytes, format, options, arguments, progress);
}

// Everything that will be written; NOT_FOUND names what cannot be.
absl::Status CheckOutputs(const ApproximateArguments& arguments) {
  const bool is_stream = arguments.output == "-";
  const bool has_weights = arguments.fit.options.skinning == pipeline::SkinningMode::kDense;
  const bool has_gaps = arguments.fit.options.want_vertex_gaps;
  const bool has_exports = !arguments.fit.exports.empty();
  if (is_stream && (has_weights || has_gaps || has_exports)) {
    return InvalidField(ErrorReason::kConflict,
                        has_weights ? "options.skinning"
                        : has_gaps  ? "options.want_vertex_gaps"
                                    : "exports",
                        "writes files beside RESULT.json, so --output must be a file name");
  }
  std::vector<std::string> paths = {arguments.output};
  if (has_weights) {
    for (const std::string& path : WeightsPaths(arguments.output)) paths.push_back(path);
  }
  if (has_gaps) {
    for (const std::string& path : GapsPaths(arguments.output)) paths.push_back(path);
  }
  if (!arguments.frame_radii.empty()) paths.push_back(arguments.frame_radii);
  for (const std::string& path : paths) CAPFIT_RETURN_IF_ERROR(CheckWritable(path));
  return absl::OkStatus();
}

absl::Status WriteOutputs(const pipeline::FitResult& result,
                          const ApproximateArguments& arguments) {
  CAPFIT_RETURN_IF_ERROR(
      WriteFileBytes(arguments.output, FormatResult(result, arguments.request_id)));
  if (result.weights) {
    CAPFIT_RETURN_IF_ERROR(WriteWeights(*result.weights, arguments.output));
  }
  const std::string folder = std::filesystem::path(arguments.output).parent_path().string();
  for (const pipeline::ExportedFile& exported : result.exports) {
    CAPFIT_RETURN_IF_ERROR(WriteExportFile(exported.file, folder, arguments.quiet));
  }
  if (result.vertex_gaps.empty()) return absl::OkStatus();
  return WriteVertexGaps(result.vertex_gaps, result.body_from_caller.scale, arguments.output);
}

void PrintMotion(const pipeline::FitResult& result, std::FILE* out) {
  const motion::MotionReport& report = *result.motion;
  std::fprintf(
      out,
      "%d frames enclosed; before, up to %d vertices were outside, by %.1f mm at most; the set has "
      "%.1f %% more volume for it at rest and %.1f %% in the mean of the frames\n",
      report.frame_count, report.most_points_out_before,
      1e3 * std::max(0.0, report.max_out_before_m), 100.0 * (report.volume_ratio - 1.0),
      100.0 * (report.mean_volume_ratio - 1.0));
  if (result.weights || result.sparse_weights || result.bone_weights) return;
  std::fputs(
      "nothing tells what carries the set through the frames: --skinning sparse or bones does\n",
      out);
}

// In the caller's unit.
absl::Status WriteFrameRadii(const pipeline::FitResult& result, const std::string& path) {
  std::vector<std::vector<double>> radii = result.motion->radii_m;
  for (std::vector<double>& frame : radii) {
    for (double& radius : frame) radius /= result.body_from_caller.scale;
  }
  return WriteFileBytes(path, FormatRadii(radii, path));
}

absl::Status RunApproximate(const ApproximateArguments& arguments) {
  CAPFIT_RETURN_IF_ERROR(CheckOutputs(arguments));
  const absl::StatusOr<pipeline::FitResult> result = FitBody(arguments);
  if (!result.ok()) {
    return arguments.is_local
               ? result.status()
               : WithServerAdvice(result.status(), arguments.server.addresses, "--local");
  }
  PrintWarnings(result->warnings);
  CAPFIT_RETURN_IF_ERROR(WriteOutputs(*result, arguments));
  if (!arguments.frame_radii.empty()) {
    CAPFIT_RETURN_IF_ERROR(WriteFrameRadii(*result, arguments.frame_radii));
  }
  if (arguments.quiet) return absl::OkStatus();
  if (result->motion) PrintMotion(*result, arguments.output == "-" ? stderr : stdout);
  std::fputs(ResultTable(*result).c_str(), arguments.output == "-" ? stderr : stdout);
  return absl::OkStatus();
}

void AddPlaceFlags(CLI::App& command, ApproximateArguments& arguments) {
  CLI::Option* const server = AddServerFlags(command, arguments.server);
  CLI::Option* const local =
      command.add_flag("--local", arguments.is_local, "Fit in this process, without a server")
          ->excludes(server);
  CLI::Option* const threads =
      command
          .add_option("--threads", arguments.threads,
                      "With --local: threads; 0: one per core, within a container's quota")
          ->check(CLI::Range(0, 256))
          ->capture_default_str();
  CLI::Option* const motion = command.add_option(
      "--cover-motion", arguments.cover_motion,
      "With --local: enclose these poses too: moved vertices (little-endian float32, frames x "
      "vertices x 3), or the name or index of a clip of a GLB");
  motion->type_name("FILE|CLIP")->needs(local)->group("What to fit");
  command
      .add_option(
          "--frame-radii", arguments.frame_radii,
          "With --cover-motion: radii of each frame's own, which are tighter, to this file: "
          "little-endian float32, frames x spheres, or {\"frames\": [[r, ...], ...]} in a "
          "file that ends in .json")
      ->type_name("FILE")
      ->needs(motion)
      ->group("What to fit");
  command.add_option("--fps", arguments.fps, "With a clip: frames a second")
      ->check(NumberIn(0.1, 240.0))
      ->needs(motion)
      ->capture_default_str()
      ->group("What to fit");
  CLI::Option* const timeout = AddTimeoutFlag(command, arguments.timeout_seconds,
                                              "Seconds that the whole call to the server may take");
  CLI::Option* const request_id =
      command.add_option("--request-id", arguments.request_id,
                         "Name of this job, in RESULT.json and in the server's logs");
  for (CLI::Option* const option : {server, local, threads, timeout, request_id}) {
    option->group("Server");
  }
}

void AddOutputFlags(CLI::App& command, ApproximateArguments& arguments) {
  command.add_option("-o,--output", arguments.output, "RESULT.json to write")
      ->required()
      ->type_name("RESULT.json")
      ->group("Output");
  command.add_flag("--progress", arguments.progress, "Show progress though no terminal reads it")
      ->group("Output");
  command.add_flag("--quiet", arguments.quiet, "Print no table and no progress, only warnings")
      ->group("Output");
}

}  // namespace

void AddApproximateCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<ApproximateArguments>();
  CLI::App* const command = app.add_subcommand(
      "approximate", "Fit spheres and tapered capsules to a body; write RESULT.json");
  command->add_option("BODY", arguments->body, "Mesh file: .obj, .ply, .stl, .off or .glb")
      ->required()
      ->type_name("FILE")
      ->group("Input");  // the first group of the help
  AddOutputFlags(*command, *arguments);
  AddFitFlags(*command, arguments->fit);
  AddPlaceFlags(*command, *arguments);
  command->footer(
      "The table goes to standard output, with -o - to standard error; warnings go to "
      "standard error.");
  command->callback([arguments, &exit_code] { exit_code = Report(RunApproximate(*arguments)); });
}

}  // namespace capfit::client
