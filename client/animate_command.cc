#include "client/animate_command.h"

#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/exit_code.h"
#include "client/picture/belongs.h"
#include "client/picture/centers_file.h"
#include "client/picture/file_bytes.h"
#include "client/picture/result_body.h"
#include "client/weights_output.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

struct AnimateArguments {
  std::string body;
  std::string weights;
  std::string frames;
  std::string output;
  int threads = 0;
};

using Centers = std::vector<Eigen::Vector3d>;

// That the weights are the body's and, where they were named by their result, the result's.
absl::Status CheckWeights(const AnimateArguments& arguments,
                          const skinning::DenseWeights& weights) {
  CAPFIT_ASSIGN_OR_RETURN(const formats::PolygonSoup soup, ReadBodyFile(arguments.body));
  CAPFIT_RETURN_IF_ERROR(CheckVertexCount("WEIGHTS", weights.vertex_count, soup));
  if (IsWeightsHeader(arguments.weights)) return absl::OkStatus();
  CAPFIT_ASSIGN_OR_RETURN(const std::string text, ReadFileBytes(arguments.weights));
  CAPFIT_ASSIGN_OR_RETURN(const ResultSet result, ParseResultSet(text));
  CAPFIT_RETURN_IF_ERROR(CheckBelongs(result, soup));
  if (result.spheres.size() == weights.sphere_count) return absl::OkStatus();
  return InvalidField(ErrorReason::kContradictsBody, "WEIGHTS",
                      absl::StrCat("are for ", weights.sphere_count, " spheres, RESULT has ",
                                   result.spheres.size(), "; fit again with --skinning dense"));
}

// Whether a whole frame was read; an error for a part of one.
absl::StatusOr<bool> ReadFrame(std::istream& in, std::size_t frame, std::vector<float>& numbers) {
  const auto bytes = static_cast<std::streamsize>(numbers.size() * sizeof(float));
  in.read(reinterpret_cast<char*>(numbers.data()), bytes);
  if (in.gcount() == bytes) return true;
  if (in.gcount() == 0 && in.eof()) return false;
  return InvalidField(ErrorReason::kMalformedFile, absl::StrCat("frames[", frame, "]"),
                      absl::StrCat("has ", in.gcount(), " bytes, must have ", bytes));
}

absl::StatusOr<std::vector<Centers>> MoveCenters(const AnimateArguments& arguments,
                                                 const skinning::DenseWeights& weights) {
  std::ifstream file;
  if (arguments.frames != "-") file.open(arguments.frames, std::ios::binary);
  if (!file) return absl::NotFoundError(absl::StrCat("cannot read ", arguments.frames));
  std::istream& in = arguments.frames == "-" ? std::cin : file;
  const ThreadPool pool(arguments.threads);
  std::vector<float> numbers(3 * weights.vertex_count);
  Centers vertices(weights.vertex_count);
  std::vector<Centers> frames;
  for (;;) {
    CAPFIT_ASSIGN_OR_RETURN(const bool is_whole, ReadFrame(in, frames.size(), numbers));
    if (!is_whole) break;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      vertices[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
      if (!vertices[i].allFinite()) {
        return InvalidField(ErrorReason::kMalformedFile,
                            absl::StrCat("frames[", frames.size(), "][", i, "]"), "must be finite");
      }
    }
    frames.push_back(skinning::Apply(weights, vertices, pool));
  }
  if (frames.empty()) return InvalidField(ErrorReason::kMalformedFile, "frames", "is empty");
  return frames;
}

absl::Status RunAnimate(const AnimateArguments& arguments) {
  CAPFIT_RETURN_IF_ERROR(CheckWritable(arguments.output));
  CAPFIT_ASSIGN_OR_RETURN(const skinning::DenseWeights weights, ReadWeights(arguments.weights));
  CAPFIT_RETURN_IF_ERROR(CheckWeights(arguments, weights));
  CAPFIT_ASSIGN_OR_RETURN(const std::vector<Centers> frames, MoveCenters(arguments, weights));
  CAPFIT_RETURN_IF_ERROR(WriteFileBytes(arguments.output, FormatCenters(frames, arguments.output)));
  std::fprintf(arguments.output == "-" ? stderr : stdout, "%zu frames of %zu sphere centres\n",
               frames.size(), weights.sphere_count);
  return absl::OkStatus();
}

}  // namespace

void AddAnimateCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<AnimateArguments>();
  CLI::App* const command = app.add_subcommand(
      "animate", "Carry the sphere centres along with the body's moved vertices");
  command->add_option("BODY", arguments->body, "Mesh file that was fitted")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("WEIGHTS", arguments->weights,
                   "RESULT.json that was written with --skinning dense, or its .weights.json")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--frames", arguments->frames,
                   "Moved vertices: little-endian float32, frames x vertices x 3")
      ->required()
      ->type_name("FILE");
  command
      ->add_option(
          "-o,--output", arguments->output,
          "Centres, for `render --centers`: little-endian float32, frames x spheres x 3, or "
          "{\"frames\": [[[x, y, z], ...], ...]} in a file that ends in .json")
      ->required()
      ->type_name("FILE");
  command->add_option("--threads", arguments->threads, "Threads; 0: one per core")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  command->callback([arguments, &exit_code] { exit_code = Report(RunAnimate(*arguments)); });
}

}  // namespace capfit::client
