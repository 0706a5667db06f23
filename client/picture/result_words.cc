#include "client/picture/result_words.h"

#include <algorithm>
#include <cstdio>

#include "absl/strings/str_cat.h"
#include "client/picture/result_body.h"
#include "core/base/enum_index.h"

namespace capfit::client {
namespace {

body::Part PartAt(std::size_t p) { return static_cast<body::Part>(p); }

// "left_hand" and "right_hand" go by this together.
std::string PairWord(body::Part part) {
  const std::string name(body::PartName(part));
  const std::string word = name.substr(name.find('_') + 1);
  return word == "foot" ? "feet" : word + "s";
}

std::string PartList(const PartFlags& parts) {
  std::string list;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (!parts[p]) continue;
    const auto mirror = static_cast<std::size_t>(body::MirrorPart(PartAt(p)));
    const bool is_pair = mirror != p && parts[mirror];
    if (is_pair && mirror < p) continue;
    absl::StrAppend(&list, list.empty() ? "" : ", ",
                    is_pair ? PairWord(PartAt(p)) : Spaced(std::string(body::PartName(PartAt(p)))));
  }
  return list;
}

// Entries for those of the parts that `words` names, in the order of body::Part.
std::vector<LegendEntry> Entries(const std::vector<std::string>& words) {
  std::vector<LegendEntry> entries;
  for (int p = 0; p < body::kPartCount; ++p) {
    const std::string name(body::PartName(static_cast<body::Part>(p)));
    if (std::find(words.begin(), words.end(), name) == words.end()) continue;
    entries.push_back({Spaced(name), PartColor(name, 0.5)});
  }
  return entries;
}

}  // namespace

PartFlags FittedParts(const ResultSet& result) {
  const std::vector<std::string>& words =
      result.fitted_parts.empty() ? result.sphere_parts : result.fitted_parts;
  PartFlags fitted{};
  for (std::size_t p = 0; p < fitted.size(); ++p) {
    const std::string name(body::PartName(PartAt(p)));
    fitted[p] = std::find(words.begin(), words.end(), name) != words.end();
  }
  const bool says_nothing = std::find(fitted.begin(), fitted.end(), true) == fitted.end();
  if (says_nothing) fitted.fill(true);
  return fitted;
}

PartFlags PartsOnBody(const body::Body& body) {
  PartFlags there{};
  for (const body::Segment segment : body.vertex_segments) {
    there[Index(body::PartOf(segment))] = true;
  }
  return there;
}

std::string Caption(const ResultSet& result) {
  std::string text;
  const auto add = [&](const std::string& words) {
    absl::StrAppend(&text, text.empty() ? "" : "     ", words);
  };
  const auto metric = [&](const char* name, const char* format) {
    const auto found = result.metrics.find(name);
    if (found == result.metrics.end()) return;
    char value[64];
    std::snprintf(value, sizeof(value), format, found->second);
    add(value);
  };
  metric("primitive_count", "n_p %.0f");
  add(absl::StrCat(result.spheres.size(), " spheres + ", result.capsules.size(), " capsules"));
  metric("volume_error", "E_r %.3f");
  metric("mean_distance_percent", "E_M %.2f %%");
  if (!result.quality.empty()) add("quality " + result.quality);
  if (!result.engine.empty()) add("engine " + result.engine);
  return text;
}

std::string MissingParts(const ResultSet& result, const PartFlags& on_body) {
  const PartFlags fitted = FittedParts(result);
  PartFlags not_fitted{};
  PartFlags not_there{};
  for (std::size_t p = 0; p < fitted.size(); ++p) {
    not_fitted[p] = !fitted[p] && on_body[p];
    not_there[p] = !fitted[p] && !on_body[p] && PartsOfResult(result).Includes(PartAt(p));
  }
  std::string text;
  if (const std::string list = PartList(not_fitted); !list.empty()) text = "not fitted: " + list;
  if (const std::string list = PartList(not_there); !list.empty()) {
    absl::StrAppend(&text, text.empty() ? "" : "     ", "not on the body: ", list);
  }
  return text;
}

std::vector<LegendEntry> PartLegend(const ResultSet& result) {
  return Entries(result.sphere_parts);
}

std::vector<LegendEntry> PolygonLegend(const ResultSet& result) {
  std::vector<std::string> words;
  for (const ResultPolygon& polygon : result.polygons) words.push_back(polygon.part);
  std::vector<LegendEntry> entries = Entries(words);
  entries.insert(entries.begin(),
                 {{"feature polygon", kInk, LegendMark::kLine},
                  {"circles, in their part's colour", kInk, LegendMark::kDashedLine}});
  return entries;
}

}  // namespace capfit::client
