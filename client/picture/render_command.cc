#include "client/picture/render_command.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/exit_code.h"
#include "client/picture/belongs.h"
#include "client/picture/centers_file.h"
#include "client/picture/figure.h"
#include "client/picture/file_bytes.h"
#include "client/picture/flat_polygon.h"
#include "client/picture/gaps_file.h"
#include "client/picture/picture.h"
#include "client/picture/render_arguments.h"
#include "client/picture/result_body.h"
#include "client/picture/result_set.h"
#include "client/picture/result_words.h"
#include "core/base/enum_index.h"
#include "core/base/status.h"
#include "core/metrics/measure.h"

namespace capfit::client {
namespace {

using Eigen::Vector3d;

struct NamedView {
  double yaw_deg;
  const char* caption;
};
const std::map<std::string, NamedView>& Views() {
  static const auto* const views = new std::map<std::string, NamedView>{
      {"front", {0, "front"}},     {"three-quarter", {38, "three-quarter"}},
      {"side", {90, "left side"}}, {"back-quarter", {142, "back, three-quarter"}},
      {"back", {180, "back"}},     {"right", {270, "right side"}}};
  return *views;
}

// What the polygons are drawn from is there.
absl::Status CheckPolygons(const ResultSet& result) {
  if (result.polygons.empty()) {
    return InvalidField(ErrorReason::kMalformedFile, "feature_polygons",
                        "are not in the result: `capfit approximate --polygons` writes them");
  }
  for (std::size_t i = 0; i < result.polygons.size(); ++i) {
    const std::size_t points = result.polygons[i].outline.size();
    if (points >= 3) continue;
    return InvalidField(ErrorReason::kMalformedFile,
                        absl::StrCat("feature_polygons[", i, "].outline"),
                        absl::StrCat("has ", points, " points, must have at least 3"));
  }
  return absl::OkStatus();
}

// Faces must stay within the vertices: a picture takes any other soup.
absl::Status CheckSoup(const formats::PolygonSoup& soup) {
  if (soup.positions.empty())
    return InvalidField(ErrorReason::kMalformedFile, "body", "has no vertices");
  for (std::size_t i = 0; i < soup.positions.size(); ++i) {
    if (!soup.positions[i].allFinite()) {
      return InvalidField(ErrorReason::kMalformedFile, absl::StrCat("body.positions[", i, "]"),
                          "must be finite");
    }
  }
  for (std::size_t i = 0; i < soup.face_vertices.size(); ++i) {
    if (soup.face_vertices[i] < soup.positions.size()) continue;
    return InvalidField(
        ErrorReason::kMalformedFile, absl::StrCat("body.face_vertices[", i, "]"),
        absl::StrCat("is ", soup.face_vertices[i], ", must be below ", soup.positions.size()));
  }
  return absl::OkStatus();
}

// Frame `frame` of little-endian float32, frames x `count` things of `numbers` each.
absl::StatusOr<std::vector<float>> FrameFloats(const std::string& bytes, std::size_t frame,
                                               std::size_t count, std::size_t numbers,
                                               const std::string& field) {
  const std::size_t frame_bytes = count * numbers * sizeof(float);
  if (frame_bytes == 0 || bytes.size() % frame_bytes != 0) {
    return InvalidField(
        ErrorReason::kMalformedFile, field,
        absl::StrCat("has ", bytes.size(), " bytes, must be a multiple of ", frame_bytes, " (",
                     count, numbers == 3 ? " points" : " numbers", " in each frame)"));
  }
  if (frame >= bytes.size() / frame_bytes) {
    return InvalidField(ErrorReason::kMalformedFile, "show",
                        absl::StrCat("has frame ", frame, ", must be below ",
                                     bytes.size() / frame_bytes, " for ", field));
  }
  std::vector<float> values(count * numbers);
  std::memcpy(values.data(), bytes.data() + frame * frame_bytes, frame_bytes);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    return InvalidField(ErrorReason::kMalformedFile,
                        absl::StrCat(field, "[", frame, "][", i / numbers, "]"), "must be finite");
  }
  return values;
}

absl::StatusOr<std::vector<Vector3d>> FramePoints(const std::string& bytes, std::size_t frame,
                                                  std::size_t points, const std::string& field) {
  CAPFIT_ASSIGN_OR_RETURN(const std::vector<float> values,
                          FrameFloats(bytes, frame, points, 3, field));
  std::vector<Vector3d> positions;
  for (std::size_t i = 0; i < points; ++i) {
    positions.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  }
  return positions;
}

// 22 degrees from above, cross sections are seen as such and the body still as a body.
constexpr double kPolygonPitchRad = 0.384;

// What is drawn, and under which words.
struct Scene {
  std::vector<std::unique_ptr<Figure>> figures;
  std::vector<PictureColumn> columns;
};

struct Inputs {
  formats::PolygonSoup soup;
  ResultSet result;
  std::optional<body::Body> body;
  Eigen::Matrix3d turn;
};

Scene StillScene(const RenderArguments& arguments, const Inputs& in,
                 const std::vector<Vector3d>& centers) {
  Scene scene;
  scene.figures.push_back(std::make_unique<Figure>(
      MakeFigure(in.soup, in.result, in.soup.positions, centers, in.turn)));
  for (const std::string& name : arguments.views) {
    const NamedView& view = Views().at(name);
    scene.columns.push_back(
        {scene.figures.back().get(), view.yaw_deg * std::numbers::pi / 180.0, view.caption});
    if (!arguments.polygons) continue;
    scene.columns.back().pitch_rad = kPolygonPitchRad;
    scene.columns.back().caption += ", from above";
  }
  return scene;
}

absl::StatusOr<Scene> AnimatedScene(const RenderArguments& arguments, const Inputs& in) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string frames, ReadFileBytes(arguments.frames));
  CAPFIT_ASSIGN_OR_RETURN(const std::string centers, ReadCenters(arguments.centers));
  std::string radii;
  if (!arguments.radii.empty()) {
    CAPFIT_ASSIGN_OR_RETURN(radii, ReadRadii(arguments.radii));
  }
  ResultSet result = in.result;
  Scene scene;
  for (const std::size_t frame : arguments.show) {
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<Vector3d> positions,
                            FramePoints(frames, frame, in.soup.positions.size(), "frames"));
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<Vector3d> moved,
                            FramePoints(centers, frame, in.result.spheres.size(), "centers"));
    if (!arguments.radii.empty()) {
      CAPFIT_ASSIGN_OR_RETURN(const std::vector<float> of_frame,
                              FrameFloats(radii, frame, result.spheres.size(), 1, "radii"));
      for (std::size_t i = 0; i < of_frame.size(); ++i) {
        if (!(of_frame[i] > 0.0F)) {
          return InvalidField(ErrorReason::kMalformedFile,
                              absl::StrCat("radii[", frame, "][", i, "]"), "must be above 0");
        }
        result.spheres[i].radius_m = of_frame[i];
      }
    }
    scene.figures.push_back(
        std::make_unique<Figure>(MakeFigure(in.soup, result, positions, moved, in.turn)));
    const NamedView& view =
        Views().at(arguments.views.size() == 1 ? arguments.views.front() : "three-quarter");
    scene.columns.push_back({scene.figures.back().get(), view.yaw_deg * std::numbers::pi / 180.0,
                             absl::StrCat("frame ", frame)});
  }
  return scene;
}

// The gaps of the file, which knows the unit best.
absl::Status UseGapsFile(RenderArguments& arguments, const Inputs& in, Figure& figure) {
  CAPFIT_ASSIGN_OR_RETURN(const VertexGaps file, ReadVertexGaps(arguments.gaps));
  CAPFIT_RETURN_IF_ERROR(CheckGapsBelong(file, in.result, in.soup));
  figure.gaps.assign(file.gaps.begin(), file.gaps.end());
  arguments.mm_per_unit = 1000.0 * file.metres_per_unit;
  return absl::OkStatus();
}

// Measured on the body, as a fit does it: parts that the result does not stand for have no gap.
void MeasureGaps(const Inputs& in, const body::Body& body, const ThreadPool& pool, Figure& figure) {
  const geometry::Similarity& frame = body.body_from_caller;
  const std::vector<double> gaps_m =
      metrics::SignedGaps(body, InBodyFrame(in.result, frame), PartsOfResult(in.result), pool);
  for (const std::int32_t vertex : body.enclosed().vertex_of_source) {
    figure.gaps.push_back(vertex < 0 ? std::numeric_limits<double>::quiet_NaN()
                                     : gaps_m[vertex] / frame.scale);
  }
}

// Which of the caller's vertices lie on parts that the result stands for.
std::vector<bool> FittedVertices(const ResultSet& result, const body::Body& body) {
  const PartFlags parts = FittedParts(result);
  const body::EnclosedSurface surface = body.enclosed();
  std::vector<bool> is_fitted;
  for (const std::int32_t vertex : surface.vertex_of_source) {
    if (vertex < 0) {
      // Of one surface, what mending dropped; of many shells, hair and what else was left out.
      is_fitted.push_back(!body.shells.has_value());
      continue;
    }
    const body::Segment segment = surface.vertex_segments[vertex];
    is_fitted.push_back(parts[Index(body::PartOf(segment))]);
  }
  return is_fitted;
}

std::string FileName(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

PictureUp ToUp(const std::string& word) {
  if (word == "x") return PictureUp::kX;
  if (word == "y") return PictureUp::kY;
  return word == "z" ? PictureUp::kZ : PictureUp::kAuto;
}

absl::StatusOr<Inputs> ReadInputs(const RenderArguments& arguments) {
  Inputs in;
  CAPFIT_ASSIGN_OR_RETURN(in.soup, ReadBodyFile(arguments.body));
  CAPFIT_RETURN_IF_ERROR(CheckSoup(in.soup));
  if (!arguments.result.empty()) {
    CAPFIT_ASSIGN_OR_RETURN(const std::string result, ReadFileBytes(arguments.result));
    CAPFIT_ASSIGN_OR_RETURN(in.result, ParseResultSet(result));
    CAPFIT_RETURN_IF_ERROR(CheckBelongs(in.result, in.soup));
  }
  // A mesh that is no body is drawn all the same, with less said about it.
  absl::StatusOr<pipeline::TakenBody> understood = UnderstandBody(
      in.soup, in.result.character, body::Unit::kAuto, body::UpAxis::kAuto, ThreadPool());
  if (understood.ok()) in.body = std::move(understood->body);
  in.turn = TurnUpright(in.soup.positions, in.result, ToUp(arguments.up));
  return in;
}

// What the picture says of the result.
void DescribeResult(const RenderArguments& arguments, const Inputs& in, PictureOptions& options) {
  options.subtitle = Caption(in.result);
  options.legend = arguments.polygons ? PolygonLegend(in.result) : PartLegend(in.result);
  if (!in.body) return;
  options.note = MissingParts(in.result, PartsOnBody(*in.body));
  const bool shows_missing =
      !arguments.polygons && options.note.find("not fitted") != std::string::npos;
  if (shows_missing) options.legend.push_back({"not fitted", kNotFitted});
}

PictureOptions ToPictureOptions(const RenderArguments& arguments, const Inputs& in) {
  PictureOptions options;
  options.width = arguments.width;
  options.height = arguments.height;
  if (arguments.heat || !arguments.gaps.empty()) options.rows.front() = PanelStyle::kHeat;
  if (arguments.result.empty()) options.rows = {PanelStyle::kBody};
  if (arguments.polygons) {
    options.rows = {PanelStyle::kGhost};
    options.polygons = Flatten(in.result.polygons, in.turn);
  }
  options.title = arguments.title.empty() ? FileName(arguments.body) : arguments.title;
  if (!arguments.result.empty()) DescribeResult(arguments, in, options);
  options.mm_per_unit = arguments.mm_per_unit;
  options.heat_limit = arguments.heat_limit_mm / arguments.mm_per_unit.value_or(1000.0);
  return options;
}

// The mesh's unit where no flag tells it.
std::optional<double> MillimetresPerUnit(const Inputs& in) {
  if (in.result.metres_per_unit) return 1000.0 * *in.result.metres_per_unit;
  if (in.body) return 1000.0 * in.body->body_from_caller.scale;
  return std::nullopt;
}

absl::StatusOr<Scene> MakeScene(RenderArguments& arguments, const Inputs& in) {
  if (!arguments.frames.empty()) return AnimatedScene(arguments, in);
  std::vector<Vector3d> centers;
  for (const geometry::Sphere& sphere : in.result.spheres) centers.push_back(sphere.center_m);
  Scene scene = StillScene(arguments, in, centers);
  Figure& figure = *scene.figures.back();
  if (!arguments.gaps.empty()) {
    CAPFIT_RETURN_IF_ERROR(UseGapsFile(arguments, in, figure));
  } else if (arguments.heat && in.body) {
    MeasureGaps(in, *in.body, ThreadPool(), figure);
  }
  if (arguments.polygons) {
    CAPFIT_RETURN_IF_ERROR(CheckPolygons(in.result));
    figure.solids.clear();
    figure.curves = CurvesOf(Flatten(in.result.polygons, in.turn));
  }
  return scene;
}

absl::Status RunRender(RenderArguments arguments) {
  CAPFIT_RETURN_IF_ERROR(CheckRenderArguments(arguments));
  CAPFIT_ASSIGN_OR_RETURN(const Inputs in, ReadInputs(arguments));
  if (!arguments.mm_per_unit) arguments.mm_per_unit = MillimetresPerUnit(in);
  CAPFIT_ASSIGN_OR_RETURN(const Scene scene, MakeScene(arguments, in));
  if (in.body && !arguments.result.empty()) {
    const std::vector<bool> is_fitted = FittedVertices(in.result, *in.body);
    for (const std::unique_ptr<Figure>& figure : scene.figures) figure->is_fitted = is_fitted;
  }
  const PictureFormat format =
      FileEnding(arguments.output) == ".svg" ? PictureFormat::kSvg : PictureFormat::kPng;
  CAPFIT_ASSIGN_OR_RETURN(
      const std::string bytes,
      DrawPicture(scene.columns, ToPictureOptions(arguments, in), format, ThreadPool()));
  return WriteFileBytes(arguments.output, bytes);
}

}  // namespace

void AddRenderCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App* const command =
      app.add_subcommand("render", "Draw a body with its primitives as a PNG or SVG picture");
  AddRenderOptions(*command, *arguments);
  command->callback([arguments, &exit_code] { exit_code = Report(RunRender(*arguments)); });
}

}  // namespace capfit::client
