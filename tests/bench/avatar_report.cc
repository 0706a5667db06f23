// What becomes of rigged avatars of many parts, held against their ground truth: parts, joints,
// cover, E_r and time at 32 spheres and 32 capsules, tight.
//
//   avatar_report FOLDER [--no-rig] [--no-names]      FOLDER: *.glb and truth.json
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "CLI/CLI.hpp"
#include "core/body/skeleton_names.h"
#include "core/character/find_character.h"
#include "core/geometry/tapered_capsule.h"
#include "core/pipeline/fit.h"
#include "tests/bench/read_body.h"

namespace {

using capfit::character::Character;
using capfit::formats::PolygonSoup;
using capfit::pipeline::FitResult;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

double MsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Where the truth's part begins among the soup's faces: by its node's name, or its faces where it
// is a range of them.
std::size_t FirstFace(const json& part, const PolygonSoup& soup) {
  const std::size_t within = part.value("first_face", std::size_t{0});
  for (const capfit::formats::SoupPart& own : soup.parts) {
    if (own.name == part["node"].get<std::string>()) return own.first_face + within;
  }
  return within;
}

void PrintParts(const json& truth, const PolygonSoup& soup, const Character& character) {
  int wrong = 0;
  for (const json& part : truth["parts"]) {
    const std::size_t faces = part["faces"];
    const std::size_t first = FirstFace(part, soup);
    std::size_t taken = 0;
    for (std::size_t f = first; f < first + faces; ++f) taken += character.is_left_out[f] == 0;
    const std::string cover = part["cover"];
    const bool is_right = cover == "yes" ? taken == faces : taken == 0;
    wrong += is_right ? 0 : 1;
    if (!is_right) {
      std::printf("   WRONG %-24s %-10s cover %-8s taken %zu of %zu\n",
                  part["name"].get<std::string>().c_str(), part["kind"].get<std::string>().c_str(),
                  cover.c_str(), taken, faces);
    }
  }
  std::printf("   %d of %zu parts wrong\n", wrong, truth["parts"].size());
  for (const auto& part : character.parts) {
    std::printf("     %-26s %-10s %-3s %4zu shells %6zu faces %5.2f %% %s\n", part.name.c_str(),
                std::string(capfit::character::PartKindName(part.kind)).c_str(),
                part.is_included ? "yes" : "no", part.shell_count, part.face_count,
                100.0 * part.area_share, part.reason.c_str());
  }
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Landmarks against the truth's joints, in millimetres.
void PrintJoints(const json& truth, const FitResult& result) {
  const double metres = truth["metres_per_file_unit"];
  std::vector<double> errors;
  std::string worst;
  for (const auto& landmark : result.landmarks) {
    const auto joint = truth["joints"].find(landmark.name);
    if (joint == truth["joints"].end()) continue;
    const Eigen::Vector3d at((*joint)[0], (*joint)[1], (*joint)[2]);
    errors.push_back(1e3 * (metres * landmark.position - at).norm());
    if (errors.back() == *std::max_element(errors.begin(), errors.end())) worst = landmark.name;
  }
  std::printf("   %zu joints: median %.0f mm, worst %.0f mm (%s)\n", errors.size(), Median(errors),
              errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end()),
              worst.c_str());
}

// Vertices that the truth says to cover, posed by the glTF rules, outside of the set.
void PrintCover(const json& truth, const PolygonSoup& soup, const FitResult& result) {
  const std::vector<capfit::geometry::TaperedCapsule> solids =
      capfit::capsule::Solids(result.primitives);
  const double metres = truth["metres_per_file_unit"];
  std::size_t out = 0;
  std::size_t all = 0;
  double worst_mm = 0.0;
  for (const json& part : truth["parts"]) {
    if (part["cover"] != "yes") continue;
    const std::size_t first = FirstFace(part, soup);
    for (std::size_t c = 3 * first; c < 3 * (first + part["faces"].get<std::size_t>()); ++c) {
      double least = 1e300;
      for (const auto& solid : solids) {
        least = std::min(least, solid.SignedDistance(soup.positions[soup.face_vertices[c]]));
      }
      const double mm = 1e3 * metres * least;
      ++all;
      out += mm > 0.1 ? 1 : 0;
      worst_mm = std::max(worst_mm, mm);
    }
  }
  std::printf("   %zu of %zu corners to cover outside (worst %.2f mm)\n", out, all, worst_mm);
}

// The parts as the last look of a fit sees them: with the joints of the rig, else the landmarks.
void ReportParts(const json& truth, const PolygonSoup& soup, const PolygonSoup& asked,
                 const FitResult& result) {
  std::map<capfit::body::LandmarkId, Eigen::Vector3d> joints =
      capfit::body::ReadRig(asked.joints).landmarks;
  for (const auto& landmark : result.landmarks) {
    if (asked.joints.empty()) {
      joints[*capfit::body::LandmarkFromName(landmark.name)] = landmark.position;
    }
  }
  const auto start = Clock::now();
  const auto character = capfit::character::FindCharacter(asked, {}, joints, capfit::ThreadPool(2));
  std::printf("   parts told in %.1f ms\n", MsSince(start));
  if (character.ok()) PrintParts(truth, soup, *character);
}

void ReportFit(const json& truth, const PolygonSoup& soup, const PolygonSoup& asked) {
  capfit::pipeline::FitOptions options;
  options.parts = {true, true, true, true, true, true};
  options.max_spheres = 32;
  options.max_capsules = 32;
  options.quality = capfit::pipeline::Quality::kTight;
  capfit::NullObserver observer;
  std::vector<double> ms;
  for (int run = 0; run < 3; ++run) {
    const auto start = Clock::now();
    const auto result = capfit::pipeline::Fit(asked, options, capfit::ThreadPool(2), observer);
    ms.push_back(MsSince(start));
    if (!result.ok()) {
      std::printf("   FIT FAILED: %s\n", result.status().ToString().c_str());
      return;
    }
    if (run < 2) continue;
    std::printf("   E_r %.3f, %.0f ms (mesh %.0f, body %.0f), height %.3f m\n", result->metrics.E_r,
                Median(ms), 1e3 * result->stage_seconds[0], 1e3 * result->stage_seconds[1],
                result->body.height_m);
    ReportParts(truth, soup, asked, *result);
    PrintJoints(truth, *result);
    PrintCover(truth, soup, *result);
    for (const auto& warning : result->warnings) {
      std::printf("     %s %s\n", warning.code.c_str(), warning.message.c_str());
    }
  }
}

void Report(const std::filesystem::path& folder, const std::string& name, const json& truth,
            bool has_rig, bool has_names) {
  const auto start = Clock::now();
  auto soup = capfit::bench::ReadBody(folder / (name + ".glb"));
  if (!soup.ok()) {
    std::printf("%s\n", soup.status().ToString().c_str());
    return;
  }
  const double read_ms = MsSince(start);
  if (!has_rig) {
    soup->joints.clear();
    soup->influences.clear();
  }
  const std::vector<capfit::formats::SoupPart> parts = soup->parts;
  if (!has_names) {
    for (auto& part : soup->parts) part.name = part.material = "";
  }
  const PolygonSoup asked = *soup;
  soup->parts = parts;
  std::printf("%s: read %.1f ms\n", name.c_str(), read_ms);
  ReportFit(truth, *soup, asked);
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path folder;
  bool no_rig = false;
  CLI::App app("Avatars against their ground truth");
  app.add_option("folder", folder, "*.glb and truth.json")->required();
  std::string only;
  app.add_option("--only", only, "files whose names hold this");
  app.add_flag("--no-rig", no_rig, "as if the files had no skeletons");
  bool no_names = false;
  app.add_flag("--no-names", no_names, "as if parts and materials had no names");
  CLI11_PARSE(app, argc, argv);
  const json truth = json::parse(std::ifstream(folder / "truth.json"));
  for (const auto& [name, entry] : truth.items()) {
    if (name.find(only) != std::string::npos) Report(folder, name, entry, !no_rig, !no_names);
  }
  return 0;
}
