#include "client/result_json.h"

#include <nlohmann/json.hpp>

namespace capfit::client {
namespace {

using nlohmann::ordered_json;

ordered_json VectorJson(const Eigen::Vector3d& v) {
  return ordered_json::array({v.x(), v.y(), v.z()});
}

ordered_json SphereJson(const geometry::Sphere& sphere) {
  ordered_json json = VectorJson(sphere.center_m);
  json.push_back(sphere.radius_m);
  return json;
}

ordered_json SpheresJson(const std::vector<geometry::Sphere>& spheres) {
  ordered_json json = ordered_json::array();
  for (const geometry::Sphere& sphere : spheres) json.push_back(SphereJson(sphere));
  return json;
}

ordered_json PartsJson(const capsule::PrimitiveSet& set) {
  ordered_json json = ordered_json::array();
  for (const capsule::SphereOrigin& origin : set.origins) {
    json.push_back(std::string(body::PartName(origin.part)));
  }
  return json;
}

ordered_json LandmarksJson(const pipeline::FitResult& result) {
  ordered_json json = ordered_json::object();
  for (const pipeline::LandmarkResult& landmark : result.landmarks) {
    json[landmark.name] = VectorJson(landmark.position);
  }
  return json;
}

ordered_json WarningsJson(const std::vector<Warning>& warnings) {
  ordered_json json = ordered_json::array();
  for (const Warning& warning : warnings) {
    json.push_back(
        {{"code", warning.code}, {"message", warning.message}, {"count", warning.count}});
  }
  return json;
}

ordered_json GapJson(const metrics::GapStatistics& gap, double metres_per_unit) {
  return {{"mean", gap.mean_m / metres_per_unit},
          {"p95", gap.p95_m / metres_per_unit},
          {"max", gap.max_m / metres_per_unit}};
}

ordered_json PartJson(const metrics::PartMetrics& part, double metres_per_unit) {
  return {{"spheres", part.spheres},
          {"capsules", part.capsules},
          {"volume", part.volume_m3 / (metres_per_unit * metres_per_unit * metres_per_unit)},
          {"E_r", part.E_r},
          {"outside", part.outside},
          {"uncovered", part.uncovered},
          {"E_M", part.E_M},
          {"volume_ratio", part.volume_ratio},
          {"gap", GapJson(part.gap, metres_per_unit)},
          {"surface_out", part.surface_out},
          {"vertices_out", part.vertices_out},
          {"max_out", part.max_out_m / metres_per_unit}};
}

// All but the parts.
ordered_json WholeJson(const metrics::Metrics& metrics, double metres_per_unit) {
  return {{"n_p", metrics.n_p},
          {"spheres", metrics.spheres},
          {"capsules", metrics.capsules},
          {"E_r", metrics.E_r},
          {"outside", metrics.outside},
          {"uncovered", metrics.uncovered},
          {"E_M", metrics.E_M},
          {"max_gap", metrics.max_gap_m / metres_per_unit},
          {"hausdorff", metrics.hausdorff},
          {"volume_ratio", metrics.volume_ratio},
          {"iou", metrics.iou},
          {"mirror_error", metrics.mirror_error},
          {"gap", GapJson(metrics.gap, metres_per_unit)},
          {"surface_out", metrics.surface_out},
          {"vertices_out", metrics.vertices_out},
          {"max_out", metrics.max_out_m / metres_per_unit}};
}

ordered_json StagesJson(const pipeline::FitResult& result) {
  ordered_json json = ordered_json::object();
  for (std::size_t i = 0; i < result.stage_seconds.size(); ++i) {
    if (result.stage_seconds[i] <= 0.0) continue;
    json[std::string(StageName(static_cast<Stage>(i)))] = result.stage_seconds[i];
  }
  return json;
}

ordered_json PolygonsJson(const std::vector<pipeline::PolygonResult>& polygons) {
  ordered_json json = ordered_json::array();
  for (const pipeline::PolygonResult& polygon : polygons) {
    ordered_json outline = ordered_json::array();
    for (const Eigen::Vector3d& point : polygon.outline) outline.push_back(VectorJson(point));
    json.push_back({{"name", polygon.name},
                    {"part", std::string(body::PartName(polygon.part))},
                    {"outline", outline},
                    {"circles", SpheresJson(polygon.circles)},
                    {"outside_area_ratio", polygon.outside_area_ratio}});
  }
  return json;
}

// One line for each element of a list, so that people and diff can read it. Names from a file may
// be any bytes: those that are not UTF-8 are replaced.
std::string Dump(const ordered_json& json) {
  const auto text = [](const ordered_json& one) {
    return one.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  };
  if (!json.is_array() || json.empty() || !json[0].is_structured()) return text(json);
  std::string lines = "[";
  for (std::size_t i = 0; i < json.size(); ++i) {
    lines += (i == 0 ? "\n    " : ",\n    ") + text(json[i]);
  }
  return lines + "]";
}

}  // namespace

std::string FormatMetrics(const metrics::Metrics& metrics, double metres_per_unit) {
  std::string text = WholeJson(metrics, metres_per_unit).dump();
  text.pop_back();
  text += ",\n    \"parts\": {";
  bool is_first = true;
  for (std::size_t p = 0; p < metrics.parts.size(); ++p) {
    if (!metrics.parts[p]) continue;
    text += (is_first ? "\n      \"" : ",\n      \"") +
            std::string(body::PartName(static_cast<body::Part>(p))) +
            "\": " + PartJson(*metrics.parts[p], metres_per_unit).dump();
    is_first = false;
  }
  return text + "}}";
}

std::string FormatResult(const pipeline::FitResult& result) {
  ordered_json root;
  root["spheres"] = SpheresJson(result.primitives.spheres);
  root["capsules"] = ordered_json(result.primitives.capsules);
  root["sphere_parts"] = PartsJson(result.primitives);
  root["landmarks"] = LandmarksJson(result);
  root["warnings"] = WarningsJson(result.warnings);
  root["metrics"] = nullptr;  // keeps the place
  root["stages"] = StagesJson(result);
  root["seconds"] = result.seconds;
  if (!result.polygons.empty()) root["polygons"] = PolygonsJson(result.polygons);
  std::string text;
  for (const auto& [name, value] : root.items()) {
    text += (text.empty() ? "{\n  \"" : ",\n  \"") + name + "\": " +
            (name == "metrics" ? FormatMetrics(result.metrics, result.body_from_caller.scale)
                               : Dump(value));
  }
  return text + "\n}\n";
}

}  // namespace capfit::client
