#include "client/approximate_flags.h"

#include <set>

#include "client/exit_code.h"
#include "client/landmarks_file.h"
#include "client/option_words.h"
#include "client/picture/file_bytes.h"
#include "core/base/status.h"
#include "core/pipeline/engines.h"

namespace capfit::client {
namespace {

template <typename Value>
void AddWord(CLI::App& command, const char* flag, Value& target, const Words<Value>& words,
             const char* help) {
  command.add_option(flag, target, help)
      ->transform(CLI::CheckedTransformer(words).description(""))
      ->type_name("WORD")
      ->default_str(WordOf(words, target));
}

void AddBudget(CLI::App& command, pipeline::FitOptions& options) {
  CLI::Option* const primitives = command.add_option("--max-primitives", options.max_primitives,
                                                     "Spheres and cones together, at most [64]");
  CLI::Option* const error =
      command.add_option("--polygon-error", options.polygon_error,
                         "As many as bring outside area / polygon area down to this");
  CLI::Option* const spheres =
      command.add_option("--max-spheres", options.max_spheres, "Spheres, at most");
  CLI::Option* const capsules =
      command.add_option("--max-capsules", options.max_capsules, "Capsules, at most");
  command
      .add_option("--engine", options.engine,
                  "Cloth engine whose limits and capsules hold: " + pipeline::EngineNames())
      ->type_name("NAME");
  primitives->excludes(error)->excludes(spheres)->excludes(capsules);
  error->excludes(spheres)->excludes(capsules);
}

void AddPartWords(CLI::App& command, const char* flag, std::vector<std::string>& parts,
                  const char* help) {
  std::set<std::string> words = {"all"};
  for (const auto& [word, member] : PartWords()) words.insert(word);
  command.add_option(flag, parts, help)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(words).description(""))
      ->type_name("WORD,...");
}

body::PartSelection Selection(const std::vector<std::string>& words) {
  body::PartSelection parts{.torso = false, .arms = false, .legs = false};
  for (const auto& [name, member] : PartWords()) {
    for (const std::string& word : words) parts.*member |= word == name || word == "all";
  }
  return parts;
}

}  // namespace

void AddFrameFlags(CLI::App& command, body::Unit& unit, body::UpAxis& up) {
  AddWord(command, "--unit", unit, UnitWords(), "Unit of the file: auto, m, cm, mm, in");
  AddWord(command, "--up", up, UpWords(), "Axis that points up: auto, x, y, z");
}

void AddPartsFlag(CLI::App& command, std::vector<std::string>& parts) {
  AddPartWords(command, "--parts", parts, "all, or a list of torso,arms,legs,head,hands,feet");
}

void AddFitFlags(CLI::App& command, FitFlags& flags) {
  AddBudget(command, flags.options);
  AddPartsFlag(command, flags.parts);
  AddPartWords(command, "--require-parts", flags.require_parts,
               "Refuse a body without these, instead of a warning");
  AddWord(command, "--fit", flags.options.fit, FitModeWords(), "enclose (nothing outside) or best");
  AddWord(command, "--quality", flags.options.quality, QualityWords(), "paper or tight");
  command
      .add_option("--tolerance-mm", flags.tolerance_mm,
                  "How far a vertex may stick out, in millimetres of the body")
      ->capture_default_str();
  AddWord(command, "--skinning", flags.options.skinning, SkinningWords(),
          "none, or dense: mean value coordinates beside the result");
  command.add_option("--landmarks", flags.landmarks_file,
                     "JSON file of known landmarks: {\"left_wrist\": [x, y, z], ...}");
  AddWord(command, "--sex", flags.options.sex, SexWords(),
          "auto, female (split the bust), male or none (do not)");
  command.add_flag("--heat-map", flags.options.want_vertex_gaps,
                   "Each vertex's signed distance to the set beside the result");
  AddFrameFlags(command, flags.options.unit, flags.options.up);
  command.add_option("--seed", flags.options.seed, "Seed of the random restarts")
      ->capture_default_str();
}

body::PartSelection PartsOf(const std::vector<std::string>& words) {
  return words.empty() ? body::PartSelection() : Selection(words);
}

absl::StatusOr<pipeline::FitOptions> OptionsOf(const FitFlags& flags) {
  pipeline::FitOptions options = flags.options;
  options.parts = PartsOf(flags.parts);
  options.require_parts = Selection(flags.require_parts);
  options.tolerance_m = 1e-3 * flags.tolerance_mm;
  if (!flags.landmarks_file.empty()) {
    const absl::StatusOr<std::string> text = ReadFileBytes(flags.landmarks_file);
    if (!text.ok()) return FileProblem(text.status());
    CAPFIT_ASSIGN_OR_RETURN(options.landmarks, ParseLandmarks(*text));
  }
  return options;
}

}  // namespace capfit::client
