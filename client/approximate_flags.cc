#include "client/approximate_flags.h"

#include "absl/strings/ascii.h"
#include "client/landmarks_file.h"
#include "client/option_words.h"
#include "client/picture/file_bytes.h"
#include "client/picture/result_body.h"
#include "client/picture/result_set.h"
#include "client/word_option.h"
#include "core/base/number_in.h"
#include "core/base/status.h"
#include "core/pipeline/engines.h"
#include "core/refine/layouts/standard_layouts.h"

namespace capfit::client {
namespace {

constexpr char kWhatToFit[] = "What to fit";
constexpr char kInput[] = "Input";
constexpr char kOutput[] = "Output";
constexpr char kBudget[] = "Budget (one of primitives, spheres and capsules, or polygon error)";

void AddBudget(CLI::App& command, FitFlags& flags) {
  pipeline::FitOptions& options = flags.options;
  CLI::Option* const primitives = command.add_option("--max-primitives", options.max_primitives,
                                                     "Spheres and cones together, at most [64]");
  CLI::Option* const error =
      command.add_option("--polygon-error", options.polygon_error,
                         "As many as bring outside area / polygon area down to this");
  CLI::Option* const spheres =
      command.add_option("--max-spheres", options.max_spheres, "Spheres, at most");
  CLI::Option* const capsules =
      command.add_option("--max-capsules", options.max_capsules, "Capsules, at most");
  CLI::Option* const engine =
      command.add_option("--engine", options.engine,
                         "Cloth engine whose limits and capsules hold: " + pipeline::EngineNames());
  engine->type_name("NAME")->transform([](std::string text) {
    const std::string word = absl::AsciiStrToLower(text);
    return pipeline::FindEngine(word) != nullptr ? word : text;  // others are refused by name
  });
  CLI::Option* const layout =
      command.add_option("--layout", flags.layout,
                         "Keep the spheres, names and capsules of a former RESULT.json, or of a "
                         "standard layout: " +
                             refine::StandardLayoutNames());
  layout->type_name("FILE|NAME");
  layout->excludes(primitives)->excludes(error)->excludes(spheres)->excludes(capsules);
  primitives->excludes(error)->excludes(spheres)->excludes(capsules);
  error->excludes(spheres)->excludes(capsules);
  for (CLI::Option* const option : {primitives, error, spheres, capsules, engine, layout}) {
    option->group(kBudget);
  }
}

CLI::Option* AddPartWords(CLI::App& command, const char* flag, std::vector<std::string>& parts,
                          const char* help) {
  std::vector<std::string> words = {"all"};
  for (const auto& [word, member] : PartWords()) words.push_back(word);
  return AddWordList(command, flag, parts, words, help);
}

body::PartSelection Selection(const std::vector<std::string>& words) {
  body::PartSelection parts{.torso = false, .arms = false, .legs = false};
  for (const auto& [name, member] : PartWords()) {
    for (const std::string& word : words) parts.*member |= word == name || word == "all";
  }
  return parts;
}

// A name, or a file.
absl::Status ReadLayout(const FitFlags& flags, pipeline::FitOptions& options) {
  if (const refine::KeptLayout* const known =
          refine::FindStandardLayout(absl::AsciiStrToLower(flags.layout))) {
    options.layout = *known;
    if (flags.parts.empty()) options.parts = known->parts();
    return absl::OkStatus();
  }
  const absl::StatusOr<std::string> text = ReadFileBytes(flags.layout);
  if (!text.ok()) {
    return absl::NotFoundError(absl::StrCat("cannot read ", flags.layout,
                                            ", which is no standard layout either; those are ",
                                            refine::StandardLayoutNames()));
  }
  CAPFIT_ASSIGN_OR_RETURN(const ResultSet result, ParseResultSet(*text));
  CAPFIT_ASSIGN_OR_RETURN(options.layout, LayoutOf(result));
  if (flags.parts.empty()) options.parts = PartsOfResult(result);
  return absl::OkStatus();
}

}  // namespace

void AddFrameFlags(CLI::App& command, body::Unit& unit, body::UpAxis& up) {
  AddWordOption(command, "--unit", unit, UnitWords(), "Unit of the file; auto: from the height")
      ->group(kInput);
  AddWordOption(command, "--up", up, UpWords(), "Axis that points up; auto: from the body")
      ->group(kInput);
}

void AddPartsFlag(CLI::App& command, std::vector<std::string>& parts) {
  AddPartWords(command, "--parts", parts,
               "Parts, separated by blanks or commas [torso, arms, legs]")
      ->group(kWhatToFit);
}

void AddCharacterFlags(CLI::App& command, character::CharacterOptions& options) {
  // A name may hold blanks and commas: one for each flag.
  const auto add_names = [&](const char* flag, std::vector<std::string>& names, const char* help) {
    command.add_option(flag, names, help)
        ->type_name("NAME")
        ->expected(1)
        ->allow_extra_args(false)
        ->group(kWhatToFit);
  };
  add_names("--include", options.include,
            "Mesh or material of the file that is the body's, * and ? allowed; repeat for more");
  add_names("--exclude", options.exclude,
            "Mesh or material of the file that is not; see `capfit inspect`");
  command.add_flag("--hair", options.hair, "Enclose the hair too")->group(kWhatToFit);
  command.add_flag("--skirt", options.skirt, "Enclose skirts and dresses too")->group(kWhatToFit);
}

void AddFitFlags(CLI::App& command, FitFlags& flags) {
  pipeline::FitOptions& options = flags.options;
  AddFrameFlags(command, options.unit, options.up);
  command
      .add_option(
          "--landmarks", flags.landmarks_file,
          "JSON file of known landmarks, {\"left_wrist\": [x, y, z], ...}, or a RESULT.json")
      ->type_name("FILE")
      ->group(kInput);
  AddPartsFlag(command, flags.parts);
  AddCharacterFlags(command, options.character);
  AddPartWords(command, "--require-parts", flags.require_parts,
               "Refuse a body without these, instead of a warning")
      ->group(kWhatToFit);
  AddWordOption(command, "--fit", options.fit, FitModeWords(),
                "enclose: nothing outside; best: the least volume error")
      ->group(kWhatToFit);
  AddWordOption(command, "--quality", options.quality, QualityWords(),
                "paper: the published method; tight: less volume error, more time; balanced: "
                "almost as little in less time than tight")
      ->group(kWhatToFit);
  command
      .add_option("--tolerance-mm", flags.tolerance_mm,
                  "How far a vertex may stick out, in millimetres of the body [0, 100]")
      ->check(NumberIn(0.0, 1000.0 * pipeline::kMaxToleranceM))
      ->type_name("MM")
      ->capture_default_str()
      ->group(kWhatToFit);
  AddWordOption(command, "--sex", options.sex, SexWords(),
                "Whether the bust is split in three: female at any valley, male never")
      ->group(kWhatToFit);
  command.add_option("--seed", options.seed, "Seed of the random restarts")
      ->check(SeedCheck())
      ->capture_default_str()
      ->group(kWhatToFit);
  AddBudget(command, flags);
  AddWordOption(
      command, "--skinning", options.skinning, SkinningWords(),
      "What carries the centres when the body moves. sparse: weights of some 100 vertices each; "
      "bones: of the file's joints; both in RESULT.json; dense: of all vertices, beside it")
      ->group(kOutput);
  AddWordList(command, "--export", flags.exports, ExportWords(),
              "Files for engines beside RESULT.json, as `capfit export` writes them")
      ->group(kOutput);
  command
      .add_flag("--heat-map", options.want_vertex_gaps,
                "Each vertex's signed distance to the set beside RESULT.json")
      ->group(kOutput);
  command
      .add_flag("--polygons", options.want_polygons,
                "The feature polygons with their circles in RESULT.json too")
      ->group(kOutput);
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
    CAPFIT_ASSIGN_OR_RETURN(const std::string text, ReadFileBytes(flags.landmarks_file));
    CAPFIT_ASSIGN_OR_RETURN(options.landmarks, ParseLandmarks(text));
  }
  for (const std::string& format : flags.exports) options.exports.push_back({format, {}});
  if (!flags.layout.empty()) CAPFIT_RETURN_IF_ERROR(ReadLayout(flags, options));
  return options;
}

}  // namespace capfit::client
