#include "client/animate_command.h"

#include <bit>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/exit_code.h"
#include "client/picture/file_bytes.h"
#include "client/weights_output.h"
#include "core/base/status.h"
#include "core/mesh/read_mesh.h"

namespace capfit::client {
namespace {

static_assert(std::endian::native == std::endian::little, "frames are little-endian float32");

struct AnimateArguments {
  std::string body;
  std::string weights;
  std::string frames;
  std::string output;
  int threads = 0;
};

using Centers = std::vector<Eigen::Vector3d>;

absl::Status CheckVertexCount(const AnimateArguments& arguments,
                              const skinning::DenseWeights& weights) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string file, ReadFileBytes(arguments.body));
  CAPFIT_ASSIGN_OR_RETURN(
      const mesh::PolygonSoup soup,
      mesh::ReadMesh(std::as_bytes(std::span(file)), mesh::FormatFromFileName(arguments.body)));
  if (soup.positions.size() == weights.vertex_count) return absl::OkStatus();
  return InvalidField(ErrorReason::kMalformedFile, "weights",
                      absl::StrCat("are for ", weights.vertex_count, " vertices, but the body has ",
                                   soup.positions.size()));
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
  std::ifstream in(arguments.frames, std::ios::binary);
  if (!in) return absl::NotFoundError(absl::StrCat("cannot read ", arguments.frames));
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

std::string AsBinary(const std::vector<Centers>& frames) {
  std::string bytes;
  for (const Centers& centers : frames) {
    for (const Eigen::Vector3d& center : centers) {
      const Eigen::Vector3f single = center.cast<float>();
      bytes.append(reinterpret_cast<const char*>(single.data()), 3 * sizeof(float));
    }
  }
  return bytes;
}

std::string AsJson(const std::vector<Centers>& frames) {
  std::string text;
  for (const Centers& centers : frames) {
    nlohmann::json row = nlohmann::json::array();
    for (const Eigen::Vector3d& c : centers) row.push_back({c.x(), c.y(), c.z()});
    text += (text.empty() ? "{\"frames\": [\n  " : ",\n  ") + row.dump();
  }
  return text + "\n]}\n";
}

absl::Status RunAnimate(const AnimateArguments& arguments) {
  CAPFIT_ASSIGN_OR_RETURN(const skinning::DenseWeights weights, ReadWeights(arguments.weights));
  CAPFIT_RETURN_IF_ERROR(CheckVertexCount(arguments, weights));
  CAPFIT_ASSIGN_OR_RETURN(const std::vector<Centers> frames, MoveCenters(arguments, weights));
  const std::string bytes =
      FileEnding(arguments.output) == ".json" ? AsJson(frames) : AsBinary(frames);
  CAPFIT_RETURN_IF_ERROR(FileProblem(WriteFileBytes(arguments.output, bytes)));
  std::printf("%zu frames of %zu sphere centres\n", frames.size(), weights.sphere_count);
  return absl::OkStatus();
}

}  // namespace

void AddAnimateCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<AnimateArguments>();
  CLI::App* const command = app.add_subcommand(
      "animate", "Carry the sphere centres along with the body's moved vertices");
  command->add_option("BODY", arguments->body, "Mesh file that was fitted")->required();
  command
      ->add_option("WEIGHTS", arguments->weights,
                   "RESULT.json that was written with --skinning dense, or its .weights.json")
      ->required();
  command
      ->add_option("--frames", arguments->frames,
                   "Moved vertices: little-endian float32, frames x vertices x 3")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Centres: .json, or little-endian float32, frames x spheres x 3")
      ->required();
  command->add_option("--threads", arguments->threads, "Threads; 0: one per core")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  command->callback([arguments, &exit_code] { exit_code = Report(RunAnimate(*arguments)); });
}

}  // namespace capfit::client
