#include "client/picture/result_set.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

using nlohmann::json;

constexpr int kReadFormatVersion = 1;

// `value` as `count` finite numbers.
absl::StatusOr<std::vector<double>> Numbers(const json& value, std::size_t count,
                                            const std::string& field) {
  if (!value.is_array() || value.size() != count) {
    return InvalidField(ErrorReason::kMalformedFile, field,
                        absl::StrCat("must be an array of ", count, " numbers"));
  }
  std::vector<double> numbers;
  for (const json& number : value) {
    if (!number.is_number() || !std::isfinite(number.get<double>())) {
      return InvalidField(ErrorReason::kMalformedFile, field, "must hold finite numbers only");
    }
    numbers.push_back(number.get<double>());
  }
  return numbers;
}

absl::Status Wrong(const std::string& field, const std::string& problem) {
  return InvalidField(ErrorReason::kMalformedFile, field, problem);
}

absl::StatusOr<Eigen::Vector3d> Point(const json& value, const std::string& field) {
  CAPFIT_ASSIGN_OR_RETURN(const std::vector<double> n, Numbers(value, 3, field));
  return Eigen::Vector3d(n[0], n[1], n[2]);
}

// Balls, or circles: [x, y, z, r].
absl::StatusOr<std::vector<geometry::Sphere>> Balls(const json& root, const std::string& name,
                                                    const std::string& path) {
  if (!root.contains(name) || !root[name].is_array()) {
    return Wrong(path, "is missing, must be an array of [x, y, z, r]");
  }
  std::vector<geometry::Sphere> balls;
  for (const json& entry : root[name]) {
    const std::string field = absl::StrCat(path, "[", balls.size(), "]");
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<double> n, Numbers(entry, 4, field));
    if (n[3] < 0.0) return Wrong(field, "has a negative radius");
    balls.push_back({{n[0], n[1], n[2]}, n[3]});
  }
  return balls;
}

absl::Status ReadCapsules(const json& root, ResultSet& set) {
  if (!root.contains("capsules")) return absl::OkStatus();
  if (!root["capsules"].is_array())
    return InvalidField(ErrorReason::kMalformedFile, "capsules", "must be an array of [i, j]");
  for (const json& entry : root["capsules"]) {
    const std::string field = absl::StrCat("capsules[", set.capsules.size(), "]");
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<double> ends, Numbers(entry, 2, field));
    for (std::size_t k = 0; k < 2; ++k) {
      const double limit = static_cast<double>(set.spheres.size());
      if (ends[k] >= 0.0 && ends[k] < limit && ends[k] == std::floor(ends[k])) continue;
      return InvalidField(ErrorReason::kMalformedFile, absl::StrCat(field, "[", k, "]"),
                          absl::StrCat("is ", ends[k], ", must be a whole number below ", limit));
    }
    set.capsules.push_back({static_cast<int>(ends[0]), static_cast<int>(ends[1])});
  }
  return absl::OkStatus();
}

// A word for each sphere; "" for all where the list is not there.
absl::StatusOr<std::vector<std::string>> SphereWords(const json& root, const std::string& name,
                                                     std::size_t sphere_count) {
  std::vector<std::string> words(sphere_count);
  if (!root.contains(name)) return words;
  const json& list = root[name];
  if (!list.is_array() || list.size() != sphere_count) {
    return Wrong(name, absl::StrCat("must be an array of ", sphere_count, " words"));
  }
  for (std::size_t i = 0; i < sphere_count; ++i) {
    if (list[i].is_string()) words[i] = list[i].get<std::string>();
  }
  return words;
}

// The list of that name, one entry for each sphere; nothing where it is not there.
absl::StatusOr<const json*> SphereList(const json& root, const std::string& name,
                                       std::size_t sphere_count) {
  const auto list = root.find(name);
  if (list == root.end()) return nullptr;
  if (list->is_array() && list->size() == sphere_count) return &*list;
  return Wrong(name, absl::StrCat("must be an array of ", sphere_count, " entries"));
}

absl::Status ReadMirrors(const json& root, ResultSet& set) {
  set.sphere_mirrors.assign(set.spheres.size(), -1);
  CAPFIT_ASSIGN_OR_RETURN(const json* const list,
                          SphereList(root, "sphere_mirrors", set.spheres.size()));
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const json& mirror = (*list)[i];
    if (mirror.is_null()) continue;
    if (!mirror.is_number_unsigned() || mirror.get<std::uint64_t>() >= set.spheres.size()) {
      return Wrong(absl::StrCat("sphere_mirrors[", i, "]"),
                   absl::StrCat("must be null or an index below ", set.spheres.size()));
    }
    set.sphere_mirrors[i] = mirror.get<int>();
  }
  return absl::OkStatus();
}

absl::StatusOr<refine::BodyPlace> Place(const json& entry, const std::string& field) {
  const json bone = entry.is_object() ? entry.value("bone", json()) : json();
  const std::optional<refine::BoneId> known =
      refine::BoneByName(bone.is_string() ? bone.get<std::string>() : std::string());
  if (!known) return Wrong(field + ".bone", "must be the name of a bone");
  CAPFIT_ASSIGN_OR_RETURN(const std::vector<double> n,
                          Numbers({entry.value("along", json()), entry.value("aside", json()),
                                   entry.value("ahead", json()), entry.value("radius", json())},
                                  4, field));
  const bool is_right = entry.value("is_right", json()) == true;
  return refine::BodyPlace{
      *known, is_right ? refine::Side::kRight : refine::Side::kLeft, {n[0], n[1], n[2]}, n[3]};
}

absl::Status ReadPlaces(const json& root, ResultSet& set) {
  set.sphere_places.assign(set.spheres.size(), std::nullopt);
  CAPFIT_ASSIGN_OR_RETURN(const json* const list,
                          SphereList(root, "sphere_places", set.spheres.size()));
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    if ((*list)[i].is_null()) continue;
    CAPFIT_ASSIGN_OR_RETURN(set.sphere_places[i],
                            Place((*list)[i], absl::StrCat("sphere_places[", i, "]")));
  }
  return absl::OkStatus();
}

absl::Status ReadLandmarks(const json& root, ResultSet& set) {
  if (!root.contains("landmarks") || !root["landmarks"].is_object()) return absl::OkStatus();
  for (const auto& [name, value] : root["landmarks"].items()) {
    const bool is_whole = value.is_object() && value.contains("position");
    CAPFIT_ASSIGN_OR_RETURN(set.landmarks[name], Point(is_whole ? value["position"] : value,
                                                       absl::StrCat("landmarks.", name)));
  }
  return absl::OkStatus();
}

void ReadMetrics(const json& root, ResultSet& set) {
  if (!root.contains("metrics") || !root["metrics"].is_object()) return;
  for (const auto& [name, value] : root["metrics"].items()) {
    if (value.is_number()) set.metrics[name] = value.get<double>();
    if (name != "parts" || !value.is_object()) continue;
    for (const auto& [part, unused] : value.items()) set.fitted_parts.push_back(part);
  }
}

absl::StatusOr<ResultPolygon> ReadPolygon(const json& entry, const std::string& field) {
  if (!entry.is_object() || !entry.contains("outline") || !entry["outline"].is_array()) {
    return Wrong(field, "must be an object with an outline");
  }
  ResultPolygon polygon;
  polygon.name = entry.value("name", json()).is_string() ? entry["name"] : json("");
  polygon.part = entry.value("part", json()).is_string() ? entry["part"] : json("");
  for (const json& point : entry["outline"]) {
    const std::string path = absl::StrCat(field, ".outline[", polygon.outline.size(), "]");
    CAPFIT_ASSIGN_OR_RETURN(const Eigen::Vector3d corner, Point(point, path));
    polygon.outline.push_back(corner);
  }
  CAPFIT_ASSIGN_OR_RETURN(polygon.circles, Balls(entry, "circles", field + ".circles"));
  const json ratio = entry.value("outside_area_ratio", json(0.0));
  if (ratio.is_number()) polygon.outside_area_ratio = ratio.get<double>();
  return polygon;
}

absl::Status ReadPolygons(const json& root, ResultSet& set) {
  if (!root.contains("feature_polygons")) return absl::OkStatus();
  if (!root["feature_polygons"].is_array()) return Wrong("feature_polygons", "must be an array");
  for (const json& entry : root["feature_polygons"]) {
    const std::string field = absl::StrCat("feature_polygons[", set.polygons.size(), "]");
    CAPFIT_ASSIGN_OR_RETURN(ResultPolygon polygon, ReadPolygon(entry, field));
    set.polygons.push_back(std::move(polygon));
  }
  return absl::OkStatus();
}

absl::Status ReadBody(const json& root, ResultSet& set) {
  if (!root.contains("body") || !root["body"].is_object()) return Wrong("body", "is missing");
  const json& body = root["body"];
  ResultBodyFacts facts;
  const json count = body.value("vertex_count", json());
  if (!count.is_number_integer()) return Wrong("body.vertex_count", "must be a whole number");
  facts.vertex_count = count.get<std::int64_t>();
  CAPFIT_ASSIGN_OR_RETURN(facts.box_min, Point(body.value("box_min", json()), "body.box_min"));
  CAPFIT_ASSIGN_OR_RETURN(facts.box_max, Point(body.value("box_max", json()), "body.box_max"));
  set.body = facts;
  return absl::OkStatus();
}

// The turn alone: the unit is told by metres_per_unit.
absl::Status ReadTurn(const json& root, ResultSet& set) {
  if (!root.contains("body_from_caller")) return absl::OkStatus();
  const json frame = root["body_from_caller"];
  CAPFIT_ASSIGN_OR_RETURN(const std::vector<double> n,
                          Numbers(frame.is_object() ? frame.value("rotation", json()) : json(), 9,
                                  "body_from_caller.rotation"));
  const Eigen::Matrix3d turn =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(n.data());
  if (!turn.isUnitary(1e-6) || turn.determinant() < 0.0) {
    return Wrong("body_from_caller.rotation", "must be a rotation");
  }
  set.body_from_caller = turn;
  return absl::OkStatus();
}

std::string Word(const json& object, const char* name) {
  const json word = object.value(name, json());
  return word.is_string() ? word.get<std::string>() : "";
}

// The words of a list; others in it are left out.
std::vector<std::string> Words(const json& object, const char* name) {
  std::vector<std::string> words;
  const json list = object.value(name, json());
  for (const json& word : list.is_array() ? list : json::array()) {
    if (word.is_string()) words.push_back(word.get<std::string>());
  }
  return words;
}

// options.parts: what the result is meant to cover, though the body may not have all of it.
void ReadOptions(const json& root, ResultSet& set) {
  const json options = root.value("options", json());
  if (!options.is_object()) return;
  set.quality = Word(options, "quality");
  set.engine = Word(options, "engine");
  set.capsule_profile = Word(options, "capsule_profile");
  set.character.include = Words(options, "include_parts");
  set.character.exclude = Words(options, "exclude_parts");
  set.character.hair = options.value("include_hair", json()) == true;
  set.character.skirt = options.value("include_skirt", json()) == true;
  if (!options.contains("parts") || !options["parts"].is_array()) return;
  const auto has = [&](const char* word) {
    return std::find(options["parts"].begin(), options["parts"].end(), word) !=
           options["parts"].end();
  };
  set.parts = {has("torso"), has("arms"), has("legs"), has("head"), has("hands"), has("feet")};
}

// What only capfit's own results have.
absl::Status ReadOwn(const json& root, ResultSet& set) {
  const json format = root.value("format", json());
  if (format != "capfit-result") return absl::OkStatus();
  const json version = root.value("format_version", json());
  if (version != kReadFormatVersion) {
    return Wrong("format_version",
                 absl::StrCat("is ", version.dump(), ", this capfit reads ", kReadFormatVersion));
  }
  const json unit = root.value("unit", json());
  if (unit.is_string()) set.unit = unit.get<std::string>();
  const json scale = root.value("metres_per_unit", json());
  if (!scale.is_number() || !(scale.get<double>() > 0.0)) {
    return Wrong("metres_per_unit", "must be a number > 0");
  }
  set.metres_per_unit = scale.get<double>();
  set.version = Word(root, "version");
  ReadOptions(root, set);
  CAPFIT_RETURN_IF_ERROR(ReadTurn(root, set));
  return ReadBody(root, set);
}

}  // namespace

absl::StatusOr<refine::KeptLayout> LayoutOf(const ResultSet& result) {
  refine::KeptLayout layout;
  layout.capsules = result.capsules;
  for (std::size_t i = 0; i < result.spheres.size(); ++i) {
    const std::optional<body::Part> part = body::PartFromName(result.sphere_parts[i]);
    if (!part) {
      return Wrong(absl::StrCat("sphere_parts[", i, "]"),
                   "must name a part: a layout is a RESULT.json of capfit");
    }
    layout.spheres.push_back(
        {result.sphere_names[i], *part, result.sphere_mirrors[i], result.sphere_places[i]});
  }
  return layout;
}

absl::StatusOr<ResultSet> ParseResultSet(const std::string& json_text) {
  const json root = json::parse(json_text, nullptr, /*allow_exceptions=*/false);
  if (!root.is_object()) return Wrong("result", "is not a JSON object");
  ResultSet set;
  CAPFIT_RETURN_IF_ERROR(ReadOwn(root, set));
  CAPFIT_ASSIGN_OR_RETURN(set.spheres, Balls(root, "spheres", "spheres"));
  CAPFIT_RETURN_IF_ERROR(ReadCapsules(root, set));
  CAPFIT_ASSIGN_OR_RETURN(set.sphere_parts, SphereWords(root, "sphere_parts", set.spheres.size()));
  CAPFIT_ASSIGN_OR_RETURN(set.sphere_names, SphereWords(root, "sphere_names", set.spheres.size()));
  CAPFIT_RETURN_IF_ERROR(ReadMirrors(root, set));
  CAPFIT_RETURN_IF_ERROR(ReadPlaces(root, set));
  CAPFIT_RETURN_IF_ERROR(ReadLandmarks(root, set));
  CAPFIT_RETURN_IF_ERROR(ReadPolygons(root, set));
  ReadMetrics(root, set);
  return set;
}

}  // namespace capfit::client
