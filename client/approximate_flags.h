// The flags of `capfit approximate` that say what is wanted.
#ifndef CAPFIT_CLIENT_APPROXIMATE_FLAGS_H_
#define CAPFIT_CLIENT_APPROXIMATE_FLAGS_H_

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/pipeline/fit.h"

namespace capfit::client {

struct FitFlags {
  pipeline::FitOptions options;
  std::vector<std::string> parts;          // words; empty: torso, arms, legs
  std::vector<std::string> require_parts;  // words; empty: none
  double tolerance_mm = 0.0;
  std::string landmarks_file;        // empty: none
  std::vector<std::string> exports;  // formats
  std::string layout;                // name of a standard layout, or a RESULT.json; empty: none
};

// Adds the flags to `command`, in groups; CLI11 checks words and that there is one budget at most.
// Ranges of numbers are checked by pipeline::ValidateOptions, but for those whose unit differs.
void AddFitFlags(CLI::App& command, FitFlags& flags);
// --unit and --up alone, for commands that only look at a body.
void AddFrameFlags(CLI::App& command, body::Unit& unit, body::UpAxis& up);
// --include, --exclude, --hair and --skirt alone.
void AddCharacterFlags(CLI::App& command, character::CharacterOptions& options);
// --parts alone.
void AddPartsFlag(CLI::App& command, std::vector<std::string>& parts);

// "torso", "arms", ...; "all" for all six. No words: the default selection.
[[nodiscard]] body::PartSelection PartsOf(const std::vector<std::string>& words);

// The options, with landmarks and layout read. A layout is fitted for the parts that it was made
// for where the caller names none. NOT_FOUND and INVALID_ARGUMENT for these files.
[[nodiscard]] absl::StatusOr<pipeline::FitOptions> OptionsOf(const FitFlags& flags);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_APPROXIMATE_FLAGS_H_
