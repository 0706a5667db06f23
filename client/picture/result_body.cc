#include "client/picture/result_body.h"

#include <algorithm>
#include <span>
#include <string>

#include "client/picture/file_bytes.h"
#include "core/base/status.h"
#include "core/formats/read_mesh.h"

namespace capfit::client {
namespace {

// Which part a word of "sphere_parts" means; the torso for words that are not known.
body::Part PartFromWord(const std::string& word) {
  return body::PartFromName(word).value_or(body::Part::kTorso);
}

}  // namespace

absl::StatusOr<formats::PolygonSoup> ReadBodyFile(const std::string& path) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string bytes, ReadFileBytes(path));
  return formats::ReadMesh(std::as_bytes(std::span(bytes)), formats::FormatFromFileName(path));
}

absl::StatusOr<pipeline::TakenBody> UnderstandBody(const formats::PolygonSoup& soup,
                                                   const character::CharacterOptions& character,
                                                   body::Unit unit, body::UpAxis up,
                                                   const ThreadPool& pool) {
  pipeline::FitOptions options;
  options.character = character;
  options.unit = unit;
  options.up = up;
  NullObserver observer;
  std::vector<Warning> unheard;
  return pipeline::TakeBody(soup, options, pool, observer, unheard);
}

capsule::PrimitiveSet InBodyFrame(const ResultSet& result,
                                  const geometry::Similarity& body_from_caller) {
  capsule::PrimitiveSet set;
  for (std::size_t i = 0; i < result.spheres.size(); ++i) {
    const geometry::Sphere& sphere = result.spheres[i];
    set.spheres.push_back(
        {body_from_caller.Apply(sphere.center_m), body_from_caller.scale * sphere.radius_m});
    set.origins.push_back({PartFromWord(result.sphere_parts[i]), -1, -1});
  }
  for (const std::array<int, 2>& ends : result.capsules) {
    if (ends[0] == ends[1]) continue;
    set.capsules.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
  }
  return set;
}

body::PartSelection PartsOfResult(const ResultSet& result) {
  if (result.parts) return *result.parts;
  body::PartSelection parts{.torso = false, .arms = false, .legs = false};
  bool is_told = false;
  for (const std::string& word : result.sphere_parts) {
    if (word.empty()) continue;
    is_told = true;
    parts.torso |= word == "torso";
    parts.arms |= word == "left_arm" || word == "right_arm";
    parts.legs |= word == "left_leg" || word == "right_leg";
    parts.head |= word == "head";
    parts.hands |= word == "left_hand" || word == "right_hand";
    parts.feet |= word == "left_foot" || word == "right_foot";
  }
  return is_told ? parts : body::PartSelection();
}

}  // namespace capfit::client
