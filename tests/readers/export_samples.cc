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
#include <iterator>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "core/export/export.h"
#include "tests/readers/edge_set.h"
#include "tests/readers/sample_set.h"

namespace {

using capfit::exports::ColliderSet;
using capfit::exports::Exported;
using nlohmann::json;

// A format, or one with an option, whose first file then has a name of its own.
struct SampleFormat {
  std::string name;
  std::string format;
  capfit::exports::ExportOptions options;
  std::string file;  // empty: as it is
};

std::vector<SampleFormat> Formats() {
  std::vector<SampleFormat> formats;
  for (const capfit::exports::ExportFormat& format : capfit::exports::ExportFormats()) {
    formats.push_back({std::string(format.name), std::string(format.name), {}, ""});
  }
  formats.push_back({"gltf_preview", "gltf", {.has_preview = true}, "preview.glb"});
  formats.push_back({"usd_uniform", "usd", {.is_plain = true}, "uniform.usda"});
  formats.push_back({"mujoco_meshes", "mujoco", {.is_plain = true}, "mujoco_meshes.xml"});
  return formats;
}

absl::StatusOr<Exported> WriteSample(const SampleFormat& format, const ColliderSet& set,
                                     const std::string& original) {
  absl::StatusOr<Exported> exported = capfit::exports::Export(
      set, format.format, std::as_bytes(std::span(original)), format.options);
  if (exported.ok() && !format.file.empty()) exported->files[0].name = format.file;
  return exported;
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

void CheckWords(const std::set<std::string>& words) {
  std::set<std::string> known = {"all"};
  for (const SampleFormat& format : Formats()) known.insert(format.name);
  for (const std::string& word : words) {
    if (!known.contains(word)) Fail(word + " is no format");
  }
}

void WriteSamples(const ColliderSet& set, const std::string& original, const std::string& wanted,
                  const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  WriteFile(folder / "expected.json", capfit::readers::Expected(set).dump(1));
  json warnings = json::object();
  const std::set<std::string> words = Words(wanted);
  CheckWords(words);
  for (const SampleFormat& format : Formats()) {
    if (wanted != "all" && !words.contains(format.name)) continue;
    const absl::StatusOr<Exported> exported = WriteSample(format, set, original);
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
