// Fits a body and writes it as the export formats do, with what a reader must find in the files.
//
//   export_samples BODY FORMAT OUTDIR [MAX_PRIMITIVES]
//
// FORMAT: names of Formats() with commas between, or "all" that take the body. BODY "-" is no file
// but the made-up set of edge_set.h. Writes OUTDIR/expected.json (see sample_set.h), the files of
// each format, and OUTDIR/warnings.json: {FORMAT: [{code, message}]}. Exit code 2: bad use or
// unreadable body.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "core/export/gltf_colliders.h"
#include "core/export/mesh_hulls.h"
#include "core/export/mujoco.h"
#include "core/export/nvcloth.h"
#include "core/export/physics_json.h"
#include "core/export/table.h"
#include "core/export/unity.h"
#include "core/export/unreal.h"
#include "core/export/urdf.h"
#include "core/export/usd_colliders.h"
#include "core/export/vrm_colliders.h"
#include "tests/readers/edge_set.h"
#include "tests/readers/sample_set.h"

namespace {

using capfit::exports::ColliderSet;
using capfit::exports::Exported;
using nlohmann::json;

// `original`: the bytes of the body's own file.
using Write = std::function<absl::StatusOr<Exported>(const ColliderSet&, const std::string&)>;

struct SampleFormat {
  std::string name;
  Write write;
};

std::span<const std::byte> BytesOf(const std::string& text) {
  return std::as_bytes(std::span(text));
}

absl::StatusOr<Exported> WriteGltfSample(const ColliderSet& set, const std::string& original) {
  return capfit::exports::WriteGltf(set, BytesOf(original));
}

absl::StatusOr<Exported> WriteGltfPreview(const ColliderSet& set, const std::string& original) {
  auto exported = capfit::exports::WriteGltf(set, BytesOf(original), {.has_preview = true});
  if (exported.ok()) exported->files[0].name = "preview.glb";
  return exported;
}

absl::StatusOr<Exported> WriteVrmSample(const ColliderSet& set, const std::string& original) {
  return capfit::exports::WriteVrm(set, BytesOf(original));
}

absl::StatusOr<Exported> WriteHullsSample(const ColliderSet& set, const std::string&) {
  return capfit::exports::WriteHulls(set);
}

absl::StatusOr<Exported> WriteUnionSample(const ColliderSet& set, const std::string&) {
  return capfit::exports::WriteUnion(set);
}

// Of a format that needs nothing but the set, and cannot fail.
template <Exported (*kWrite)(const ColliderSet&)>
absl::StatusOr<Exported> WriteAlone(const ColliderSet& set, const std::string&) {
  return kWrite(set);
}

absl::StatusOr<Exported> WriteMujocoSample(const ColliderSet& set, const std::string&) {
  return capfit::exports::WriteMujoco(set);
}

absl::StatusOr<Exported> WriteMujocoMeshes(const ColliderSet& set, const std::string&) {
  auto exported = capfit::exports::WriteMujoco(set, {.as_meshes = true});
  if (exported.ok()) exported->files[0].name = "mujoco_meshes.xml";
  return exported;
}

absl::StatusOr<Exported> WriteUrdfSample(const ColliderSet& set, const std::string&) {
  return capfit::exports::WriteUrdf(set);
}

absl::StatusOr<Exported> WriteUsdSample(const ColliderSet& set, const std::string&) {
  return capfit::exports::WriteUsd(set);
}

absl::StatusOr<Exported> WriteUniformUsd(const ColliderSet& set, const std::string&) {
  auto exported = capfit::exports::WriteUsd(set, {.is_tapered = false});
  if (exported.ok()) exported->files[0].name = "uniform.usda";
  return exported;
}

const std::vector<SampleFormat>& Formats() {
  static const auto& formats = *new std::vector<SampleFormat>{
      {"gltf", WriteGltfSample},
      {"gltf_preview", WriteGltfPreview},
      {"vrm", WriteVrmSample},
      {"usd", WriteUsdSample},
      {"hulls", WriteHullsSample},
      {"usd_uniform", WriteUniformUsd},
      {"union", WriteUnionSample},
      {"unity", WriteAlone<capfit::exports::WriteUnity>},
      {"unreal", WriteAlone<capfit::exports::WriteUnreal>},
      {"nvcloth", WriteAlone<capfit::exports::WriteNvCloth>},
      {"jolt", WriteAlone<capfit::exports::WriteJolt>},
      {"bullet", WriteAlone<capfit::exports::WriteBullet>},
      {"rapier", WriteAlone<capfit::exports::WriteRapier>},
      {"mujoco", WriteMujocoSample},
      {"mujoco_meshes", WriteMujocoMeshes},
      {"urdf", WriteUrdfSample},
      {"tables", WriteAlone<capfit::exports::WriteTables>},
  };
  return formats;
}

[[noreturn]] void Fail(const std::string& message) {
  std::fprintf(stderr, "export_samples: %s\n", message.c_str());
  std::exit(2);
}

std::string Read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) Fail("cannot read " + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void WriteFile(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << bytes)) Fail("cannot write " + path.string());
}

json Words(const std::vector<capfit::Warning>& warnings) {
  json words = json::array();
  for (const capfit::Warning& warning : warnings) {
    words.push_back({{"code", warning.code}, {"message", warning.message}});
  }
  return words;
}

std::set<std::string> Words(const std::string& list) {
  std::set<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) words.insert(word);
  return words;
}

void WriteSamples(const ColliderSet& set, const std::string& original, const std::string& wanted,
                  const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  WriteFile(folder / "expected.json", capfit::readers::Expected(set).dump(1));
  json warnings = json::object();
  const std::set<std::string> words = Words(wanted);
  for (const SampleFormat& format : Formats()) {
    if (wanted != "all" && !words.contains(format.name)) continue;
    const absl::StatusOr<Exported> exported = format.write(set, original);
    if (wanted == "all" && !exported.ok()) continue;  // a format that wants another kind of body
    if (!exported.ok()) Fail(format.name + ": " + std::string(exported.status().message()));
    for (const auto& file : exported->files) WriteFile(folder / file.name, file.bytes);
    warnings[format.name] = Words(exported->warnings);
  }
  WriteFile(folder / "warnings.json", warnings.dump(1));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4 || argc > 5) Fail("use: export_samples BODY FORMAT OUTDIR [MAX_PRIMITIVES]");
  const std::string path = argv[1];
  if (path == "-") {
    WriteSamples(capfit::readers::EdgeSet(), "", argv[2], argv[3]);
    return 0;
  }
  const std::string bytes = Read(path);
  capfit::pipeline::FitOptions options;
  options.parts = {true, true, true, true, true, true};
  if (argc == 5) options.max_primitives = std::atoi(argv[4]);
  const auto set =
      capfit::readers::SampleSet(bytes, std::filesystem::path(path).stem().string(), options);
  if (!set.ok()) Fail(path + ": " + std::string(set.status().message()));
  WriteSamples(*set, bytes, argv[2], argv[3]);
}
