#include "core/pipeline/to_caller_frame.h"

#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace capfit::pipeline {
namespace {

PolygonResult ToResult(const section::FeaturePolygon& polygon,
                       const circle::PolygonApproximation& approximation,
                       const geometry::Similarity& caller_from_body) {
  PolygonResult result;
  result.name = polygon.name;
  result.part = polygon.chain;
  result.outside_area_ratio = approximation.outside_area_m2 / polygon.outline.area_m2();
  for (const Eigen::Vector2d& point : polygon.outline.vertices()) {
    result.outline.push_back(caller_from_body.Apply(polygon.frame.ToSpace(point)));
  }
  for (const circle::Circle& circle : approximation.circles) {
    result.circles.push_back({caller_from_body.Apply(polygon.frame.ToSpace(circle.center_m)),
                              caller_from_body.scale * circle.radius_m});
  }
  return result;
}

}  // namespace

capsule::PrimitiveSet ToCallerFrame(capsule::PrimitiveSet set,
                                    const geometry::Similarity& caller_from_body) {
  for (geometry::Sphere& sphere : set.spheres) {
    sphere.center_m = caller_from_body.Apply(sphere.center_m);
    sphere.radius_m *= caller_from_body.scale;
  }
  return set;
}

std::vector<LandmarkResult> LandmarkResults(const body::Body& body,
                                            const geometry::Similarity& caller_from_body) {
  std::vector<LandmarkResult> results;
  for (int i = 0; i < body::kLandmarkCount; ++i) {
    const auto id = static_cast<body::LandmarkId>(i);
    const std::optional<body::Landmark>& landmark = body.landmark(id);
    if (!landmark.has_value()) continue;
    results.push_back({std::string(body::LandmarkName(id)),
                       caller_from_body.Apply(landmark->position_m), landmark->method,
                       landmark->confidence});
  }
  return results;
}

std::vector<PolygonResult> PolygonResults(
    std::span<const section::FeaturePolygon> polygons,
    std::span<const circle::PolygonApproximation> approximations,
    const geometry::Similarity& caller_from_body) {
  std::vector<PolygonResult> results;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    results.push_back(ToResult(polygons[i], approximations[i], caller_from_body));
  }
  return results;
}

std::vector<float> VertexGaps(std::span<const std::int32_t> vertex_of_source,
                              std::span<const double> gaps_m,
                              const geometry::Similarity& caller_from_body) {
  std::vector<float> gaps;
  gaps.reserve(vertex_of_source.size());
  for (const std::int32_t vertex : vertex_of_source) {
    gaps.push_back(vertex < 0 ? std::numeric_limits<float>::quiet_NaN()
                              : static_cast<float>(caller_from_body.scale * gaps_m[vertex]));
  }
  return gaps;
}

}  // namespace capfit::pipeline
