#include "client/picture/result_set.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

using nlohmann::json;

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

absl::Status ReadSpheres(const json& root, ResultSet& set) {
  if (!root.contains("spheres") || !root["spheres"].is_array()) {
    return InvalidField(ErrorReason::kMalformedFile, "spheres",
                        "is missing, must be an array of [x, y, z, r]");
  }
  for (const json& entry : root["spheres"]) {
    const std::string field = absl::StrCat("spheres[", set.spheres.size(), "]");
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<double> n, Numbers(entry, 4, field));
    if (n[3] < 0.0)
      return InvalidField(ErrorReason::kMalformedFile, field, "has a negative radius");
    set.spheres.push_back({{n[0], n[1], n[2]}, n[3]});
  }
  return absl::OkStatus();
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

absl::Status ReadParts(const json& root, ResultSet& set) {
  set.sphere_parts.assign(set.spheres.size(), "");
  if (!root.contains("sphere_parts")) return absl::OkStatus();
  const json& parts = root["sphere_parts"];
  if (!parts.is_array() || parts.size() != set.spheres.size()) {
    return InvalidField(ErrorReason::kMalformedFile, "sphere_parts",
                        absl::StrCat("must be an array of ", set.spheres.size(), " words"));
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].is_string()) set.sphere_parts[i] = parts[i].get<std::string>();
  }
  return absl::OkStatus();
}

absl::Status ReadLandmarks(const json& root, ResultSet& set) {
  if (!root.contains("landmarks") || !root["landmarks"].is_object()) return absl::OkStatus();
  for (const auto& [name, value] : root["landmarks"].items()) {
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<double> n,
                            Numbers(value, 3, absl::StrCat("landmarks.", name)));
    set.landmarks[name] = {n[0], n[1], n[2]};
  }
  return absl::OkStatus();
}

void ReadMetrics(const json& root, ResultSet& set) {
  if (!root.contains("metrics") || !root["metrics"].is_object()) return;
  for (const auto& [name, value] : root["metrics"].items()) {
    if (value.is_number()) set.metrics[name] = value.get<double>();
  }
}

}  // namespace

absl::StatusOr<ResultSet> ParseResultSet(const std::string& json_text) {
  const json root = json::parse(json_text, nullptr, /*allow_exceptions=*/false);
  if (!root.is_object())
    return InvalidField(ErrorReason::kMalformedFile, "result", "is not a JSON object");
  ResultSet set;
  CAPFIT_RETURN_IF_ERROR(ReadSpheres(root, set));
  CAPFIT_RETURN_IF_ERROR(ReadCapsules(root, set));
  CAPFIT_RETURN_IF_ERROR(ReadParts(root, set));
  CAPFIT_RETURN_IF_ERROR(ReadLandmarks(root, set));
  ReadMetrics(root, set);
  return set;
}

}  // namespace capfit::client
