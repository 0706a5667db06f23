#include "client/picture/render_arguments.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "client/picture/file_bytes.h"
#include "client/word_option.h"
#include "core/base/number_in.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

constexpr double kMostColumns = 8;

void AddAnimationOptions(CLI::App& command, RenderArguments& arguments) {
  command.add_option("--frames", arguments.frames,
                     "Deformed vertices: float32, frames x vertices x 3");
  command.add_option("--centers", arguments.centers, "Sphere centres, as `animate` writes them");
  command
      .add_option("--radii", arguments.radii,
                  "Radii of each frame, as `animate` and `approximate --frame-radii` write them")
      ->needs("--centers");
  command.add_option("--show", arguments.show, "Frames to show, e.g. 0,20,60")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(NumberIn(0.0, 1e6));
}

}  // namespace

void AddRenderOptions(CLI::App& command, RenderArguments& arguments) {
  command.add_option("body", arguments.body, "Mesh file")->required();
  command.add_option("result", arguments.result,
                     "RESULT.json of this body; without it the body is drawn alone");
  command.add_option("-o,--output", arguments.output, "Picture to write, .png or .svg; - is PNG")
      ->required();
  AddWordOption(command, "--up", arguments.up, {"auto", "x", "y", "z"},
                "Axis of the mesh that points up");
  AddWordList(command, "--views", arguments.views,
              {"front", "three-quarter", "side", "back-quarter", "back", "right"},
              "Columns, separated by commas or blanks")
      ->default_str(absl::StrJoin(arguments.views, ","));
  command.add_option("--title", arguments.title, "Title; the body's file name without it");
  command.add_option("--width", arguments.width, "Pixels")->capture_default_str();
  command.add_option("--height", arguments.height,
                     "Pixels [1100; with --polygons as many as they take]");
  command.add_flag("--heat,--heat-map", arguments.heat,
                   "Colour the body by its gap to the primitives");
  command.add_option("--gaps", arguments.gaps,
                     "RESULT.gaps.json whose gaps are shown, instead of measuring them");
  command.add_flag("--polygons", arguments.polygons,
                   "Draw the feature polygons with their circles: on the body, which is pale as "
                   "glass, and below it flat, side by side, with their outside areas. The result "
                   "must have them (`approximate --polygons`)");
  command.add_option("--heat-limit-mm", arguments.heat_limit_mm, "Gap of the strongest colour")
      ->capture_default_str();
  command.add_option("--mm-per-unit", arguments.mm_per_unit,
                     "Length of the mesh's unit in mm [what RESULT or the body tells]");
  AddAnimationOptions(command, arguments);
}

absl::Status CheckRenderArguments(const RenderArguments& arguments) {
  const std::string ending = FileEnding(arguments.output);
  if (ending != ".png" && ending != ".svg" && arguments.output != "-") {
    return InvalidField(ErrorReason::kMalformedFile, "output",
                        absl::StrCat("is ", arguments.output, ", must end in .png or .svg"));
  }
  const auto check = [](const char* field, double value, double low, double high) {
    if (value >= low && value <= high) return absl::OkStatus();
    return InvalidField(ErrorReason::kMalformedFile, field,
                        absl::StrCat("is ", value, ", must be in [", low, ", ", high, "]"));
  };
  CAPFIT_RETURN_IF_ERROR(check("width", arguments.width, 200, 6000));
  CAPFIT_RETURN_IF_ERROR(check("height", arguments.height.value_or(300), 300, 6000));
  const auto views = static_cast<double>(arguments.views.size());
  CAPFIT_RETURN_IF_ERROR(check("views", views, 1, kMostColumns));
  const auto frames = static_cast<double>(arguments.show.size());
  CAPFIT_RETURN_IF_ERROR(check("show", frames, 1, kMostColumns));
  CAPFIT_RETURN_IF_ERROR(check("heat_limit_mm", arguments.heat_limit_mm, 0.01, 1e4));
  CAPFIT_RETURN_IF_ERROR(check("mm_per_unit", arguments.mm_per_unit.value_or(1.0), 1e-6, 1e6));
  if (!arguments.gaps.empty() && !arguments.frames.empty()) {
    return InvalidField(ErrorReason::kMalformedFile, "gaps",
                        "are those of the body at rest: not with --frames");
  }
  if (arguments.result.empty() &&
      (arguments.heat || arguments.polygons || !arguments.frames.empty())) {
    return InvalidField(ErrorReason::kMalformedFile, "result",
                        "is missing: --heat, --polygons and --frames need it");
  }
  if (arguments.frames.empty() != arguments.centers.empty()) {
    return InvalidField(ErrorReason::kMalformedFile,
                        arguments.frames.empty() ? "frames" : "centers",
                        "is missing: an animation needs both frames and centers");
  }
  if (arguments.polygons &&
      (arguments.heat || !arguments.gaps.empty() || !arguments.frames.empty())) {
    return InvalidField(ErrorReason::kMalformedFile, "polygons",
                        "are drawn on the body at rest: not with --heat, --gaps or --frames");
  }
  return absl::OkStatus();
}

}  // namespace capfit::client
