#include "client/result_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "client/message_json.h"
#include "client/skinning_json.h"
#include "proto/wire/enum_conversion.h"
#include "proto/wire/layout_conversion.h"
#include "proto/wire/result_conversion.h"

namespace capfit::client {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kLineColumns = 100;

ordered_json VectorJson(const Eigen::Vector3d& v) {
  return ordered_json::array({v.x(), v.y(), v.z()});
}

ordered_json SpheresJson(const std::vector<geometry::Sphere>& spheres) {
  ordered_json json = ordered_json::array();
  for (const geometry::Sphere& sphere : spheres) {
    json.push_back(VectorJson(sphere.center_m));
    json.back().push_back(sphere.radius_m);
  }
  return json;
}

ordered_json PartJson(body::Part part) { return std::string(body::PartName(part)); }

// Where they were asked for there is a list of them, though it may be empty.
bool HasPolygons(const pipeline::FitResult& result) {
  return result.effective_options.want_polygons || !result.polygons.empty();
}

// null for -1.
ordered_json IndexJson(int index) {
  return index < 0 ? ordered_json(nullptr) : ordered_json(index);
}

// What is known of each sphere and capsule, in lists beside them.
void AddPrimitives(const pipeline::FitResult& result, ordered_json& root) {
  const capsule::PrimitiveSet& set = result.primitives;
  root["spheres"] = SpheresJson(set.spheres);
  root["capsules"] = set.capsules;
  root["sphere_names"] = result.sphere_names;
  ordered_json& parts = root["sphere_parts"] = ordered_json::array();
  ordered_json mirrors = ordered_json::array();
  ordered_json polygons = ordered_json::array();
  for (const capsule::SphereOrigin& origin : set.origins) {
    parts.push_back(PartJson(origin.part));
    mirrors.push_back(IndexJson(origin.mirror));
    polygons.push_back(IndexJson(origin.polygon));
  }
  root["sphere_mirrors"] = mirrors;
  ordered_json& places = root["sphere_places"] = ordered_json::array();
  for (const std::optional<refine::BodyPlace>& place : result.sphere_places) {
    places.push_back(place ? MessageJson(wire::PlaceToWire(*place)) : ordered_json());
  }
  if (HasPolygons(result)) root["sphere_polygons"] = polygons;
  ordered_json& capsule_parts = root["capsule_parts"] = ordered_json::array();
  for (const capsule::CapsuleEnds& ends : set.capsules) {
    const auto part = [&](int end) { return set.origins[end].part; };
    capsule_parts.push_back(PartJson(std::max(part(ends[0]), part(ends[1]))));
  }
}

ordered_json LandmarksJson(const pipeline::FitResult& result) {
  ordered_json json = ordered_json::object();
  const v1::Landmarks landmarks = wire::LandmarksToWire(result);
  for (const v1::Landmark& landmark : landmarks.landmarks()) {
    ordered_json& one = json[landmark.name()] = MessageJson(landmark);
    one.erase("name");
  }
  return json;
}

ordered_json WarningsJson(const std::vector<Warning>& warnings) {
  ordered_json json = ordered_json::array();
  for (const Warning& warning : warnings) {
    json.push_back(MessageJson(wire::WarningToWire(warning)));
  }
  return json;
}

// As on the wire, but the parts under their names.
ordered_json MetricsJson(const v1::Metrics& metrics) {
  ordered_json json = MessageJson(metrics);
  ordered_json parts = ordered_json::object();
  for (ordered_json& part : json["parts"]) {
    const auto name = part["part"].get<std::string>();
    part.erase("part");
    parts[name] = std::move(part);
  }
  json["parts"] = std::move(parts);
  return json;
}

ordered_json StagesJson(const v1::Summary& summary) {
  ordered_json json = ordered_json::object();
  for (const v1::StageTime& time : summary.stages()) {
    const ordered_json stage = MessageJson(time);
    json[stage["stage"].get<std::string>()] = time.seconds();
  }
  return json;
}

ordered_json PolygonsJson(const std::vector<pipeline::PolygonResult>& polygons) {
  ordered_json json = ordered_json::array();
  for (const pipeline::PolygonResult& polygon : polygons) {
    ordered_json outline = ordered_json::array();
    for (const Eigen::Vector3d& point : polygon.outline) outline.push_back(VectorJson(point));
    json.push_back({{"name", polygon.name},
                    {"part", PartJson(polygon.part)},
                    {"outline", std::move(outline)},
                    {"circles", SpheresJson(polygon.circles)},
                    {"outside_area_ratio", polygon.outside_area_ratio}});
  }
  return json;
}

// What the file is, and how its numbers are to be read.
ordered_json HeadJson(const v1::Summary& summary) {
  const ordered_json options = MessageJson(summary.options());
  ordered_json root = {{"format", "capfit-result"},
                       {"format_version", kResultFormatVersion},
                       {"version", summary.version()},
                       {"unit", options["unit"]},
                       {"metres_per_unit", summary.body_from_caller().scale()},
                       {"up_axis", options["up_axis"]}};
  if (!summary.request_id().empty()) root["request_id"] = summary.request_id();
  root["body_from_caller"] = MessageJson(summary.body_from_caller());
  root["body"] = MessageJson(summary.body());
  root["options"] = options;
  return root;
}

bool HasStructure(const ordered_json& json) {
  return std::any_of(json.begin(), json.end(),
                     [](const ordered_json& one) { return one.is_structured(); });
}

// Broken where it does not fit into a line, so that people and diff can read it; lists of plain
// values never are. Names from a file may be any bytes: those that are not UTF-8 are replaced.
std::string Pretty(const ordered_json& json, std::size_t indent, std::size_t used) {
  const auto text = [](const ordered_json& one) {
    return one.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  };
  std::string line = text(json);
  const bool is_broken = json.is_object() || (json.is_array() && HasStructure(json));
  if (!is_broken || json.empty() || used + line.size() < kLineColumns) return line;
  const std::string margin = "\n" + std::string(indent + 2, ' ');
  std::string lines;
  for (const auto& [name, value] : json.items()) {
    const std::string label = json.is_object() ? text(name) + ": " : "";
    lines += (lines.empty() ? "" : ",") + margin + label +
             Pretty(value, indent + 2, indent + 2 + label.size());
  }
  const char* const ends = json.is_object() ? "{}" : "[]";
  return ends[0] + lines + margin.substr(0, margin.size() - 2) + ends[1];
}

}  // namespace

std::string FormatMetrics(const metrics::Metrics& metrics) {
  pipeline::FitResult result;
  result.metrics = metrics;
  return Pretty(MetricsJson(wire::SummaryToWire(result, "").metrics()), 0, 0);
}

std::string FormatResult(const pipeline::FitResult& result, const std::string& request_id) {
  const v1::Summary summary = wire::SummaryToWire(result, request_id);
  ordered_json root = HeadJson(summary);
  AddPrimitives(result, root);
  AddSkinning(result, root);
  root["landmarks"] = LandmarksJson(result);
  root["warnings"] = WarningsJson(result.warnings);
  root["metrics"] = MetricsJson(summary.metrics());
  root["stages"] = StagesJson(summary);
  root["seconds"] = summary.seconds();
  if (HasPolygons(result)) root["feature_polygons"] = PolygonsJson(result.polygons);
  return Pretty(root, 0, kLineColumns) + "\n";
}

}  // namespace capfit::client
