#include "tests/bench/landmark_samples.h"

#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "core/formats/read_mesh.h"
#include "tests/core/body/body_files.h"
#include "tests/support/bodies.h"

namespace capfit::body {
namespace {

constexpr int kFrameStep = 6;

std::string ReadText(const std::string& file) {
  return test_support::ReadFile(test_support::BodiesFolder() / file);
}

formats::PolygonSoup ReadSoup(const std::string& file) {
  const std::string bytes = ReadText(file);
  return *formats::ReadMesh(std::as_bytes(std::span(bytes)), formats::FormatFromFileName(file));
}

void AddDensities(const PosedBody& rest, const std::function<void(const Sample&)>& measure) {
  for (const char* const name : {"tri_05k", "tri_10k", "tri_25k", "quad_050k", "tri_064k",
                                 "tri_099k", "tri_200k", "remeshed"}) {
    const std::string file = std::string("scale/female_average_") + name;
    measure({"density",
             name,
             "",
             {ReadSoup(file + ".ply"), rest.points, ReadText(file + ".labels.bin")}});
  }
}

void AddFrames(const std::function<void(const Sample&)>& measure) {
  const nlohmann::json about =
      nlohmann::json::parse(ReadText("animation/female_average_walk_then_raise_arms.json"));
  const std::string bytes = ReadText("animation/" + about["file"].get<std::string>());
  const std::size_t vertices = about["shape"][1];
  Sample sample = {"animation", "", "", {}};
  sample.truth.soup = ReadSoup("animation/female_average_rest.obj");
  sample.truth.labels = ReadText("animation/" + about["labels"].get<std::string>());
  const auto& joints = about["joint_positions_per_frame"];
  for (std::size_t frame = 0; frame < joints.size(); frame += kFrameStep) {
    sample.name = "frame_" + std::to_string(frame);
    for (std::size_t v = 0; v < vertices; ++v) {
      float p[3];
      std::memcpy(p, bytes.data() + (frame * vertices + v) * sizeof p, sizeof p);
      sample.truth.soup.positions[v] = Eigen::Vector3d(p[0], p[1], p[2]);
    }
    for (const auto& [name, p] : joints[frame].items()) {
      sample.truth.joints[name] = Eigen::Vector3d(p[0], p[1], p[2]);
    }
    measure(sample);
  }
}

}  // namespace

void ForEachSample(const std::function<void(const Sample&)>& measure) {
  const std::string labels = ReadText("labels.bin");
  std::vector<Sample> at_rest;
  for (const PosedBody& posed : PosedBodies()) {
    const std::string name = posed.file.substr(0, posed.file.size() - std::strlen(".obj"));
    const Sample sample = {"posed", name, "", {ReadSoup(posed.file), posed.points, labels}};
    measure(sample);
    if (name.ends_with("_rest")) at_rest.push_back(sample);
    if (name == "female_average_rest") AddDensities(posed, measure);
  }
  AddFrames(measure);  // the crotch is not among their joints
  for (const Pose& pose : UnseenPoses()) {
    for (const Sample& rest : at_rest) {
      measure({"unseen", rest.name, pose.name, InPose(rest.truth, pose)});
    }
  }
}

}  // namespace capfit::body
