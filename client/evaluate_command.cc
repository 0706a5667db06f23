#include "client/evaluate_command.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "absl/strings/str_cat.h"
#include "client/approximate_flags.h"
#include "client/exit_code.h"
#include "client/picture/file_bytes.h"
#include "client/picture/result_set.h"
#include "client/result_table.h"
#include "core/base/status.h"
#include "core/body/find_body.h"
#include "core/coverage/cover_vertices.h"
#include "core/mesh/prepare_mesh.h"
#include "core/mesh/read_mesh.h"
#include "core/metrics/measure.h"

namespace capfit::client {
namespace {

constexpr double kGapToleranceM = 1e-4;

struct EvaluateArguments {
  std::string body;
  std::string result;
  body::BodyOptions frame;
  std::vector<std::string> parts;
  int threads = 0;
  bool as_json = false;
};

absl::StatusOr<body::Body> LoadBody(const EvaluateArguments& arguments, const ThreadPool& pool) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string file, ReadFileBytes(arguments.body));
  CAPFIT_ASSIGN_OR_RETURN(
      const mesh::PolygonSoup soup,
      mesh::ReadMesh(std::as_bytes(std::span(file)), mesh::FormatFromFileName(arguments.body)));
  CAPFIT_ASSIGN_OR_RETURN(const mesh::PreparedMesh prepared, mesh::PrepareMesh(soup));
  return body::FindBody(prepared.mesh, arguments.frame, pool, NullObserver());
}

// Which part a word of "sphere_parts" means; the torso for words that are not known.
body::Part PartFromWord(const std::string& word) {
  for (int i = 0; i < body::kPartCount; ++i) {
    if (body::PartName(static_cast<body::Part>(i)) == word) return static_cast<body::Part>(i);
  }
  return body::Part::kTorso;
}

// The result as the core knows it, in the body frame.
capsule::PrimitiveSet InBodyFrame(const ResultSet& result, const geometry::Similarity& frame) {
  capsule::PrimitiveSet set;
  for (std::size_t i = 0; i < result.spheres.size(); ++i) {
    const geometry::Sphere& sphere = result.spheres[i];
    set.spheres.push_back({frame.Apply(sphere.center_m), frame.scale * sphere.radius_m});
    set.origins.push_back({PartFromWord(result.sphere_parts[i]), -1, -1});
  }
  for (const std::array<int, 2>& ends : result.capsules) {
    if (ends[0] != ends[1])
      set.capsules.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
  }
  return set;
}

// The parts that the result has spheres for; the default where it does not say.
body::PartSelection PartsOfResult(const ResultSet& result) {
  body::PartSelection parts{.torso = false, .arms = false, .legs = false};
  bool is_told = false;
  for (const std::string& word : result.sphere_parts) {
    if (word.empty()) continue;
    is_told = true;
    parts.torso |= word == "torso";
    parts.arms |= word == "left_arm" || word == "right_arm";
    parts.legs |= word == "left_leg" || word == "right_leg";
    parts.head |= word == "head";
    parts.hands |= word == "left_hand" || word == "right_hand";
    parts.feet |= word == "left_foot" || word == "right_foot";
  }
  return is_told ? parts : body::PartSelection();
}

std::string MetricsJson(const metrics::Metrics& m) {
  return nlohmann::ordered_json{{"n_p", m.n_p},
                                {"E_r", m.E_r},
                                {"outside", m.outside},
                                {"uncovered", m.uncovered},
                                {"E_M", m.E_M},
                                {"hausdorff", m.hausdorff},
                                {"max_gap_m", m.max_gap_m},
                                {"volume_ratio", m.volume_ratio},
                                {"mirror_error", m.mirror_error},
                                {"vertices_out", m.vertices_out},
                                {"max_out_m", m.max_out_m}}
             .dump() +
         "\n";
}

absl::Status RunEvaluate(const EvaluateArguments& arguments) {
  const ThreadPool pool(arguments.threads);
  CAPFIT_ASSIGN_OR_RETURN(const std::string text, ReadFileBytes(arguments.result));
  CAPFIT_ASSIGN_OR_RETURN(const ResultSet result, ParseResultSet(text));
  CAPFIT_ASSIGN_OR_RETURN(const body::Body body, LoadBody(arguments, pool));
  const capsule::PrimitiveSet set = InBodyFrame(result, body.body_from_caller);
  metrics::MeasureOptions options;
  options.parts = arguments.parts.empty() ? PartsOfResult(result) : PartsOf(arguments.parts);
  metrics::Metrics metrics = metrics::Measure(body, set, options, pool, NullObserver());
  metrics.max_gap_m =
      coverage::CertifiedGap(coverage::TargetOf(body, options.parts), set, kGapToleranceM, pool);
  std::fputs((arguments.as_json ? MetricsJson(metrics) : MetricsTable(metrics)).c_str(), stdout);
  return absl::OkStatus();
}

}  // namespace

void AddEvaluateCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* const command =
      app.add_subcommand("evaluate", "Measure a result, of capfit or of any other program");
  command->add_option("BODY", arguments->body, "Mesh file")->required();
  command->add_option("RESULT", arguments->result, "RESULT.json with spheres and capsules")
      ->required();
  AddFrameFlags(*command, arguments->frame.unit, arguments->frame.up);
  AddPartsFlag(*command, arguments->parts);
  command->get_option("--parts")->description(
      "Parts that the set is meant to cover [those that RESULT names]");
  command->add_option("--threads", arguments->threads, "Threads; 0: one per core")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  command->add_flag("--json", arguments->as_json, "Print JSON instead of a table");
  command->callback([arguments, &exit_code] { exit_code = Report(RunEvaluate(*arguments)); });
}

}  // namespace capfit::client
