#include "client/picture/mannequin_command.h"

#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/exit_code.h"
#include "client/picture/file_bytes.h"
#include "client/picture/write_mesh.h"
#include "client/word_option.h"
#include "core/base/status.h"
#include "core/mannequin/mannequin.h"

namespace capfit::client {
namespace {

using mannequin::MannequinOptions;
using mannequin::MannequinPose;
using mannequin::MannequinSex;

struct Arguments {
  std::string output;
  std::string sex = "female";
  std::string pose = "a";
  double height_m = 1.70;
  std::optional<double> bust_m;
  std::optional<double> waist_m;
  std::optional<double> hip_m;
  std::optional<double> arm_angle_deg;
  int faces = 20'000;
  bool triangles = false;
  std::vector<std::string> parts = {"all"};
};

// "all", or a list that names the torso, the arms and the legs and whatever else is wanted.
absl::Status SetParts(const std::vector<std::string>& parts, MannequinOptions& options) {
  const auto has = [&](const char* name) {
    return std::find(parts.begin(), parts.end(), name) != parts.end();
  };
  if (has("all")) return absl::OkStatus();
  for (const char* const name : {"torso", "arms", "legs"}) {
    if (!has(name))
      return InvalidField(ErrorReason::kMissing, "parts", absl::StrCat("must name ", name));
  }
  options.with_head = has("head");
  options.with_hands = has("hands");
  options.with_feet = has("feet");
  return absl::OkStatus();
}

// In degrees, as it was asked for: 0.15 to 2 radians, cut to whole tenths.
absl::Status CheckArmAngle(double angle_deg) {
  constexpr double kLowest = 8.6;
  constexpr double kHighest = 114.5;
  if (angle_deg >= kLowest && angle_deg <= kHighest) return absl::OkStatus();
  return OutOfRange("arm_angle_deg", angle_deg, kLowest, kHighest);
}

absl::StatusOr<MannequinOptions> ToOptions(const Arguments& arguments) {
  MannequinOptions options;
  options.sex = arguments.sex == "male" ? MannequinSex::kMale : MannequinSex::kFemale;
  options.pose = arguments.pose == "t"   ? MannequinPose::kT
                 : arguments.pose == "a" ? MannequinPose::kA
                                         : MannequinPose::kSides;
  options.height_m = arguments.height_m;
  options.bust_m = arguments.bust_m;
  options.waist_m = arguments.waist_m;
  options.hip_m = arguments.hip_m;
  if (arguments.arm_angle_deg) {
    CAPFIT_RETURN_IF_ERROR(CheckArmAngle(*arguments.arm_angle_deg));
    options.arm_angle_rad = *arguments.arm_angle_deg * std::numbers::pi / 180.0;
  }
  options.faces = arguments.faces;
  options.quads = !arguments.triangles;
  CAPFIT_RETURN_IF_ERROR(SetParts(arguments.parts, options));
  return options;
}

absl::Status Run(const Arguments& arguments) {
  const std::string ending = arguments.output == "-" ? ".obj" : FileEnding(arguments.output);
  if (ending != ".obj" && ending != ".ply") {
    return InvalidField(ErrorReason::kUnknownValue, "output",
                        absl::StrCat("is ", arguments.output, ", must end in .obj or .ply"));
  }
  CAPFIT_ASSIGN_OR_RETURN(const MannequinOptions options, ToOptions(arguments));
  CAPFIT_ASSIGN_OR_RETURN(const formats::PolygonSoup soup, mannequin::MakeMannequin(options));
  return WriteFileBytes(arguments.output, ending == ".obj" ? ObjText(soup) : PlyBytes(soup));
}

}  // namespace

void AddMannequinCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* const command =
      app.add_subcommand("mannequin", "Write the built-in mannequin to an OBJ or PLY file");
  command->add_option("-o,--output", arguments->output, "File to write: .obj or .ply; - is OBJ")
      ->required()
      ->type_name("FILE");
  AddWordOption(*command, "--sex", arguments->sex, {"female", "male"}, "Whose proportions");
  command->add_option("--height-m", arguments->height_m, "Body height in metres [0.8, 2.3]")
      ->capture_default_str();
  command->add_option("--bust-m", arguments->bust_m, "Bust girth in metres; follows the height");
  command->add_option("--waist-m", arguments->waist_m, "Waist girth in metres");
  command->add_option("--hip-m", arguments->hip_m, "Hip girth in metres");
  AddWordOption(*command, "--pose", arguments->pose, {"t", "a", "sides"},
                "Arms level, half way down, or at the sides");
  command->add_option("--arm-angle-deg", arguments->arm_angle_deg,
                      "Angle of the arms from straight down, in place of the pose's [8.6, 114.5]");
  command->add_option("--faces", arguments->faces, "About this many faces [2000, 500000]")
      ->capture_default_str();
  command->add_flag("--triangles", arguments->triangles, "Triangles instead of quads");
  AddWordList(*command, "--parts", arguments->parts,
              {"all", "torso", "arms", "legs", "head", "hands", "feet"},
              "all, or torso, arms, legs and any of head, hands, feet [all]");
  command->callback([arguments, &exit_code] { exit_code = Report(Run(*arguments)); });
}

}  // namespace capfit::client
