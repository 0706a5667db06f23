#include "client/animate_command.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/carried_frames.h"
#include "client/exit_code.h"
#include "client/picture/belongs.h"
#include "client/picture/centers_file.h"
#include "client/picture/file_bytes.h"
#include "client/picture/result_body.h"
#include "client/skinning_json.h"
#include "client/weights_output.h"
#include "core/base/number_in.h"
#include "core/base/status.h"
#include "core/skinning/one_joint.h"

namespace capfit::client {
namespace {

struct AnimateArguments {
  std::string body;
  std::string weights;
  std::string frames;
  std::string joints;
  std::string clip;
  double fps = 30.0;
  bool stretches_radii = false;
  bool is_one_joint = false;
  std::string output;
  std::string radii_output;
  std::string capsule_ends_output;
  int threads = 0;
};

absl::Status WrongSource(const std::string& form, const std::string& flags) {
  return InvalidField(ErrorReason::kConflict, "WEIGHTS",
                      absl::StrCat("are ", form, ", which move with ", flags));
}

// Of bones the joints must move, of others the vertices.
absl::Status CheckSource(const AnimateArguments& arguments, const AnyWeights& weights) {
  const bool is_bones = std::holds_alternative<skinning::BoneWeights>(weights);
  if (is_bones && !arguments.frames.empty()) {
    return WrongSource("for bones", "--clip or --joints; fit again with --skinning sparse");
  }
  if (!is_bones && arguments.frames.empty()) {
    return WrongSource("for vertices", "--frames; fit again with --skinning bones");
  }
  return absl::OkStatus();
}

std::size_t SphereCountOf(const AnyWeights& weights) {
  if (const auto* dense = std::get_if<skinning::DenseWeights>(&weights)) return dense->sphere_count;
  if (const auto* sparse = std::get_if<skinning::SparseWeights>(&weights)) {
    return sparse->sphere_count();
  }
  return std::get<skinning::BoneWeights>(weights).sphere_count();
}

absl::Status CheckVertices(const AnyWeights& weights, const formats::PolygonSoup& soup) {
  if (const auto* dense = std::get_if<skinning::DenseWeights>(&weights)) {
    return CheckVertexCount("WEIGHTS", dense->vertex_count, soup);
  }
  const auto* const sparse = std::get_if<skinning::SparseWeights>(&weights);
  return sparse == nullptr ? absl::OkStatus()
                           : CheckVertexCount("WEIGHTS", sparse->vertex_count, soup);
}

// Each sphere on its one joint; after the spheres both centres of each capsule on the capsule's.
absl::StatusOr<AnyWeights> OneJointWeights(const ResultSkinning& skinning,
                                           const ResultSet& result) {
  if (result.spheres.empty() || skinning.sphere_joints.size() != result.spheres.size() ||
      skinning.capsule_joints.size() != result.capsules.size()) {
    return InvalidField(ErrorReason::kConflict, "--one-joint",
                        "needs a result that says which joint carries what: one of a body that "
                        "came with a skeleton");
  }
  std::vector<Eigen::Vector3d> centers;
  for (const geometry::Sphere& sphere : result.spheres) centers.push_back(sphere.center_m);
  std::vector<std::int32_t> joints = skinning.sphere_joints;
  for (std::size_t k = 0; k < result.capsules.size(); ++k) {
    for (const int end : result.capsules[k]) {
      centers.push_back(result.spheres[end].center_m);
      joints.push_back(skinning.capsule_joints[k]);
    }
  }
  return skinning::OnOneJoint(centers, joints, skinning.joints);
}

// The weights in the result, else those beside it.
absl::StatusOr<AnyWeights> WeightsOf(const AnimateArguments& arguments, ResultSkinning& skinning,
                                     const ResultSet& result) {
  if (arguments.is_one_joint) return OneJointWeights(skinning, result);
  if (skinning.bones) return *std::move(skinning.bones);
  if (skinning.sparse) return *std::move(skinning.sparse);
  absl::StatusOr<skinning::DenseWeights> dense = ReadWeights(arguments.weights);
  if (dense.ok()) return *std::move(dense);
  return absl::Status(
      dense.status().code(),
      absl::StrCat(arguments.weights, " has no weights, and those beside it: ",
                   dense.status().message(), "; fit again with --skinning sparse, dense or bones"));
}

// That the weights are the body's and the result's.
absl::StatusOr<CarriedSet> ReadCarried(const AnimateArguments& arguments) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string text, ReadFileBytes(arguments.weights));
  CAPFIT_ASSIGN_OR_RETURN(ResultSkinning skinning, ParseSkinning(text));
  CAPFIT_ASSIGN_OR_RETURN(const ResultSet result, ParseResultSet(text));
  CarriedSet set;
  CAPFIT_ASSIGN_OR_RETURN(set.weights, WeightsOf(arguments, skinning, result));
  CAPFIT_RETURN_IF_ERROR(CheckSource(arguments, set.weights));
  CAPFIT_ASSIGN_OR_RETURN(formats::PolygonSoup soup, ReadBodyFile(arguments.body));
  CAPFIT_RETURN_IF_ERROR(CheckVertices(set.weights, soup));
  CAPFIT_RETURN_IF_ERROR(CheckBelongs(result, soup));
  if (!arguments.is_one_joint && result.spheres.size() != SphereCountOf(set.weights)) {
    return InvalidField(
        ErrorReason::kContradictsBody, "WEIGHTS",
        absl::StrCat("are for ", SphereCountOf(set.weights), " spheres, RESULT has ",
                     result.spheres.size(), "; fit again with --skinning"));
  }
  for (const geometry::Sphere& sphere : result.spheres) set.radii.push_back(sphere.radius_m);
  if (arguments.is_one_joint) {
    for (const std::array<int, 2>& ends : result.capsules) {
      for (const int end : ends) set.radii.push_back(set.radii[end]);
    }
  }
  set.sphere_count = result.spheres.size();
  set.vertices = std::move(soup.positions);
  set.joints = std::move(skinning.joints);
  set.stretches_radii = arguments.stretches_radii;
  return set;
}

// Of dense weights alone, without the result: centres, but no radii.
absl::StatusOr<CarriedSet> ReadHeaderAlone(const AnimateArguments& arguments) {
  if (arguments.stretches_radii || !arguments.radii_output.empty() || arguments.is_one_joint) {
    return InvalidField(
        ErrorReason::kConflict, "WEIGHTS",
        "has no radii and no joints; name RESULT.json instead of its .weights.json");
  }
  CarriedSet set;
  CAPFIT_ASSIGN_OR_RETURN(set.weights, ReadWeights(arguments.weights));
  CAPFIT_RETURN_IF_ERROR(CheckSource(arguments, set.weights));
  CAPFIT_ASSIGN_OR_RETURN(formats::PolygonSoup soup, ReadBodyFile(arguments.body));
  CAPFIT_RETURN_IF_ERROR(CheckVertices(set.weights, soup));
  set.vertices = std::move(soup.positions);
  set.sphere_count = SphereCountOf(set.weights);
  return set;
}

absl::StatusOr<CarriedFrames> PlayClip(const AnimateArguments& arguments, const CarriedSet& set) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string bytes, ReadFileBytes(arguments.body));
  CAPFIT_ASSIGN_OR_RETURN(const formats::GltfClips clips,
                          formats::GltfClips::Read(std::as_bytes(std::span(bytes))));
  const absl::StatusOr<std::size_t> clip = clips.Find(arguments.clip);
  if (!clip.ok()) return WithField(clip.status(), "--clip");
  return CarryAlong(set, clips, *clip, arguments.fps);
}

absl::StatusOr<CarriedFrames> Play(const AnimateArguments& arguments, const CarriedSet& set) {
  if (!arguments.clip.empty()) return PlayClip(arguments, set);
  const std::string& path = arguments.frames.empty() ? arguments.joints : arguments.frames;
  std::ifstream file;
  if (path != "-") file.open(path, std::ios::binary);
  if (!file) return absl::NotFoundError(absl::StrCat("cannot read ", path));
  return CarryAlong(set, path == "-" ? std::cin : file, ThreadPool(arguments.threads));
}

// What comes after the spheres in each frame is taken out of it.
std::vector<std::vector<Eigen::Vector3d>> TakeCapsuleEnds(std::size_t sphere_count,
                                                          CarriedFrames& frames) {
  std::vector<std::vector<Eigen::Vector3d>> ends;
  for (std::vector<Eigen::Vector3d>& centers : frames.centers) {
    ends.emplace_back(centers.begin() + static_cast<std::ptrdiff_t>(sphere_count), centers.end());
    centers.resize(sphere_count);
  }
  for (std::vector<double>& radii : frames.radii)
    radii.resize(std::min(radii.size(), sphere_count));
  return ends;
}

// To each output file that was asked for.
absl::Status WriteFrames(const AnimateArguments& arguments, std::size_t sphere_count,
                         CarriedFrames frames) {
  const std::vector<std::vector<Eigen::Vector3d>> ends = TakeCapsuleEnds(sphere_count, frames);
  CAPFIT_RETURN_IF_ERROR(
      WriteFileBytes(arguments.output, FormatCenters(frames.centers, arguments.output)));
  if (!arguments.capsule_ends_output.empty()) {
    CAPFIT_RETURN_IF_ERROR(WriteFileBytes(arguments.capsule_ends_output,
                                          FormatCenters(ends, arguments.capsule_ends_output)));
  }
  if (arguments.radii_output.empty()) return absl::OkStatus();
  return WriteFileBytes(arguments.radii_output, FormatRadii(frames.radii, arguments.radii_output));
}

absl::Status RunAnimate(const AnimateArguments& arguments) {
  for (const std::string& path :
       {arguments.output, arguments.radii_output, arguments.capsule_ends_output}) {
    if (!path.empty()) CAPFIT_RETURN_IF_ERROR(CheckWritable(path));
  }
  CAPFIT_ASSIGN_OR_RETURN(const CarriedSet set, IsWeightsHeader(arguments.weights)
                                                    ? ReadHeaderAlone(arguments)
                                                    : ReadCarried(arguments));
  CAPFIT_ASSIGN_OR_RETURN(CarriedFrames frames, Play(arguments, set));
  const std::size_t frame_count = frames.centers.size();
  CAPFIT_RETURN_IF_ERROR(WriteFrames(arguments, set.sphere_count, std::move(frames)));
  std::fprintf(arguments.output == "-" ? stderr : stdout, "%zu frames of %zu sphere centres\n",
               frame_count, set.sphere_count);
  return absl::OkStatus();
}

void AddSourceFlags(CLI::App& command, AnimateArguments& arguments) {
  CLI::Option* const frames =
      command
          .add_option("--frames", arguments.frames,
                      "Moved vertices, for dense and sparse weights: little-endian float32, frames "
                      "x vertices x 3")
          ->type_name("FILE");
  CLI::Option* const clip =
      command
          .add_option("--clip", arguments.clip,
                      "Animation of BODY (GLB, VRM) by name or index, for bone weights")
          ->type_name("NAME");
  CLI::Option* const joints =
      command
          .add_option("--joints", arguments.joints,
                      "Moved joints, for bone weights: little-endian float32, frames x joints x 12 "
                      "(3 rows of 4 from the joint's frame to the mesh's)")
          ->type_name("FILE");
  command.add_option("--fps", arguments.fps, "With --clip: frames a second")
      ->check(NumberIn(0.01, 10'000.0))
      ->capture_default_str()
      ->needs(clip);
  CLI::Option* const one_joint = command.add_flag(
      "--one-joint", arguments.is_one_joint,
      "Each sphere on the one joint that carries it best, as engines have them that hang each "
      "collider on one bone");
  command
      .add_option("--capsule-ends", arguments.capsule_ends_output,
                  "With --one-joint: both centres of each capsule on the capsule's one joint, "
                  "frames x (2 * capsules) x 3, in the form of --output")
      ->type_name("FILE")
      ->needs(one_joint);
  frames->excludes(clip)->excludes(joints)->excludes(one_joint);
  clip->excludes(joints);
}

}  // namespace

void AddAnimateCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<AnimateArguments>();
  CLI::App* const command = app.add_subcommand(
      "animate", "Carry the sphere centres along with the body's moved vertices or joints");
  command->add_option("BODY", arguments->body, "Mesh file that was fitted")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("WEIGHTS", arguments->weights,
                   "RESULT.json that was written with --skinning dense, sparse or bones, or the "
                   ".weights.json beside it")
      ->required()
      ->type_name("FILE");
  AddSourceFlags(*command, *arguments);
  command
      ->add_option(
          "-o,--output", arguments->output,
          "Centres, for `render --centers`: little-endian float32, frames x spheres x 3, or "
          "{\"frames\": [[[x, y, z], ...], ...]} in a file that ends in .json")
      ->required()
      ->type_name("FILE");
  command->add_flag("--stretch-radii", arguments->stretches_radii,
                    "Radii follow the body's stretch, within 0.8 and 1.25 of what they are");
  command
      ->add_option("--radii", arguments->radii_output,
                   "Radii of each frame: little-endian float32, frames x spheres, or {\"frames\": "
                   "[[r, ...], ...]} in a file that ends in .json")
      ->type_name("FILE");
  command
      ->add_option("--threads", arguments->threads,
                   "Threads; 0: one per core, within a container's quota")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  command->callback([arguments, &exit_code] {
    if (arguments->frames.empty() && arguments->clip.empty() && arguments->joints.empty()) {
      throw CLI::RequiredError("--frames, --clip or --joints");
    }
    exit_code = Report(RunAnimate(*arguments));
  });
}

}  // namespace capfit::client
