#include "proto/wire/result_conversion.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/enum_index.h"
#include "core/base/plain_text.h"
#include "core/base/status.h"
#include "proto/wire/enum_conversion.h"
#include "proto/wire/layout_conversion.h"
#include "proto/wire/options_conversion.h"
#include "proto/wire/skinning_conversion.h"

namespace capfit::wire {
namespace {

void SetVector(const Eigen::Vector3d& vector, v1::Vector3& wire) {
  wire.set_x(vector.x());
  wire.set_y(vector.y());
  wire.set_z(vector.z());
}

Eigen::Vector3d VectorOf(const v1::Vector3& wire) { return {wire.x(), wire.y(), wire.z()}; }

absl::Status UnknownPart(const std::string& field, v1::BodyPart part) {
  return UnknownEnum(field, part);
}

// What the metrics of the whole and those of a part have in common.
template <typename AnyMetrics, typename AnyWire>
void CommonToWire(const AnyMetrics& metrics, AnyWire& wire) {
  wire.set_sphere_count(metrics.spheres);
  wire.set_capsule_count(metrics.capsules);
  wire.set_volume_error(metrics.E_r);
  wire.set_outside(metrics.outside);
  wire.set_uncovered(metrics.uncovered);
  wire.set_mean_distance_percent(metrics.E_M);
  wire.set_volume_ratio(metrics.volume_ratio);
  wire.mutable_gap()->set_mean_m(metrics.gap.mean_m);
  wire.mutable_gap()->set_p95_m(metrics.gap.p95_m);
  wire.mutable_gap()->set_max_m(metrics.gap.max_m);
  wire.set_surface_out(metrics.surface_out);
  wire.set_vertices_out(metrics.vertices_out);
  wire.set_max_out_m(metrics.max_out_m);
}

template <typename AnyMetrics, typename AnyWire>
void CommonFromWire(const AnyWire& wire, AnyMetrics& metrics) {
  metrics.spheres = wire.sphere_count();
  metrics.capsules = wire.capsule_count();
  metrics.E_r = wire.volume_error();
  metrics.outside = wire.outside();
  metrics.uncovered = wire.uncovered();
  metrics.E_M = wire.mean_distance_percent();
  metrics.volume_ratio = wire.volume_ratio();
  metrics.gap = {wire.gap().mean_m(), wire.gap().p95_m(), wire.gap().max_m()};
  metrics.surface_out = wire.surface_out();
  metrics.vertices_out = wire.vertices_out();
  metrics.max_out_m = wire.max_out_m();
}

v1::Metrics MetricsToWire(const metrics::Metrics& metrics) {
  v1::Metrics wire;
  wire.set_primitive_count(metrics.n_p);
  CommonToWire(metrics, wire);
  wire.set_max_distance_percent(metrics.hausdorff);
  wire.set_max_gap_m(metrics.max_gap_m);
  wire.set_mirror_error(metrics.mirror_error);
  wire.set_intersection_over_union(metrics.iou);
  for (std::size_t p = 0; p < metrics.parts.size(); ++p) {
    if (!metrics.parts[p]) continue;
    v1::PartMetrics& part = *wire.add_parts();
    part.set_part(ToWire(static_cast<body::Part>(p)));
    part.set_volume_m3(metrics.parts[p]->volume_m3);
    CommonToWire(*metrics.parts[p], part);
  }
  return wire;
}

// Parts that this version does not know are left out.
metrics::Metrics MetricsFromWire(const v1::Metrics& wire) {
  metrics::Metrics metrics;
  metrics.n_p = wire.primitive_count();
  CommonFromWire(wire, metrics);
  metrics.hausdorff = wire.max_distance_percent();
  metrics.max_gap_m = wire.max_gap_m();
  metrics.mirror_error = wire.mirror_error();
  metrics.iou = wire.intersection_over_union();
  for (const v1::PartMetrics& one : wire.parts()) {
    const std::optional<body::Part> known = FromWire(one.part());
    if (!known) continue;
    metrics::PartMetrics& part = metrics.parts[Index(*known)].emplace();
    part.volume_m3 = one.volume_m3();
    CommonFromWire(one, part);
  }
  return metrics;
}

void SimilarityToWire(const geometry::Similarity& similarity, v1::Similarity& wire) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      wire.add_rotation(similarity.rotation(row, column));
    }
  }
  wire.set_scale(similarity.scale);
  SetVector(similarity.translation, *wire.mutable_translation());
}

absl::Status SimilarityFromWire(const v1::Similarity& wire, geometry::Similarity& similarity) {
  if (wire.rotation_size() != 9) {
    return InvalidField(ErrorReason::kOutOfRange, "summary.body_from_caller.rotation",
                        absl::StrCat("has ", wire.rotation_size(), " numbers, must have 9"));
  }
  for (int i = 0; i < 9; ++i) similarity.rotation(i / 3, i % 3) = wire.rotation(i);
  similarity.scale = wire.scale();
  similarity.translation = VectorOf(wire.translation());
  return absl::OkStatus();
}

void FactsToWire(const pipeline::BodyFacts& facts, v1::BodyFacts& wire) {
  wire.set_vertex_count(facts.vertex_count);
  wire.set_face_count(facts.face_count);
  SetVector(facts.box_min, *wire.mutable_box_min());
  SetVector(facts.box_max, *wire.mutable_box_max());
  wire.set_height_m(facts.height_m);
  wire.set_is_symmetric(facts.is_symmetric);
  for (const character::CharacterPart& part : facts.parts) {
    v1::MeshPart& one = *wire.add_parts();
    one.set_name(PlainText(part.name));
    one.set_material(PlainText(part.material));
    one.set_kind(ToWire(part.kind));
    one.set_is_included(part.is_included);
    one.set_reason(PlainText(part.reason));
    one.set_shell_count(static_cast<std::int64_t>(part.shell_count));
    one.set_face_count(static_cast<std::int64_t>(part.face_count));
    one.set_area_share(part.area_share);
  }
}

pipeline::BodyFacts FactsFromWire(const v1::BodyFacts& wire) {
  pipeline::BodyFacts facts = {wire.vertex_count(),
                               wire.face_count(),
                               VectorOf(wire.box_min()),
                               VectorOf(wire.box_max()),
                               wire.height_m(),
                               wire.is_symmetric(),
                               {}};
  for (const v1::MeshPart& part : wire.parts()) {
    facts.parts.push_back({part.name(), part.material(),
                           FromWire(part.kind()).value_or(character::PartKind::kFragment),
                           part.is_included(), part.reason(),
                           static_cast<std::size_t>(std::max<std::int64_t>(0, part.shell_count())),
                           static_cast<std::size_t>(std::max<std::int64_t>(0, part.face_count())),
                           part.area_share()});
  }
  return facts;
}

// Whether the capsule's ends are two spheres in order.
bool EndsAreValid(const v1::Capsule& capsule, int sphere_count) {
  return capsule.first_sphere() >= 0 && capsule.first_sphere() < capsule.second_sphere() &&
         capsule.second_sphere() < sphere_count;
}

}  // namespace

v1::Warning WarningToWire(const Warning& warning) {
  v1::Warning wire;
  wire.set_code(PlainText(warning.code));
  wire.set_message(PlainText(warning.message));
  wire.set_count(warning.count);
  return wire;
}

v1::Landmarks LandmarksToWire(const pipeline::FitResult& result) {
  v1::Landmarks wire;
  for (const pipeline::LandmarkResult& landmark : result.landmarks) {
    v1::Landmark& one = *wire.add_landmarks();
    one.set_name(PlainText(landmark.name));
    SetVector(landmark.position, *one.mutable_position());
    one.set_method(ToWire(landmark.method));
    one.set_confidence(landmark.confidence);
  }
  return wire;
}

v1::FeaturePolygon PolygonToWire(const pipeline::PolygonResult& polygon) {
  v1::FeaturePolygon wire;
  wire.set_name(PlainText(polygon.name));
  wire.set_part(ToWire(polygon.part));
  for (const Eigen::Vector3d& point : polygon.outline) SetVector(point, *wire.add_outline());
  for (const geometry::Sphere& circle : polygon.circles) {
    v1::Circle& one = *wire.add_circles();
    SetVector(circle.center_m, *one.mutable_center());
    one.set_radius(circle.radius_m);
  }
  wire.set_outside_area_ratio(polygon.outside_area_ratio);
  return wire;
}

v1::PrimitiveSet PrimitivesToWire(const pipeline::FitResult& result) {
  const capsule::PrimitiveSet& set = result.primitives;
  v1::PrimitiveSet wire;
  for (std::size_t i = 0; i < set.spheres.size(); ++i) {
    v1::Sphere& sphere = *wire.add_spheres();
    SetVector(set.spheres[i].center_m, *sphere.mutable_center());
    sphere.set_radius(set.spheres[i].radius_m);
    const capsule::SphereOrigin& origin = set.origins[i];
    sphere.set_part(ToWire(origin.part));
    if (origin.polygon >= 0) sphere.set_polygon(origin.polygon);
    if (origin.mirror >= 0) sphere.set_mirror(origin.mirror);
    if (i < result.sphere_names.size()) sphere.set_name(PlainText(result.sphere_names[i]));
    if (i < result.sphere_places.size() && result.sphere_places[i]) {
      *sphere.mutable_place() = PlaceToWire(*result.sphere_places[i]);
    }
  }
  for (std::size_t i = 0; i < set.capsules.size(); ++i) {
    v1::Capsule& capsule = *wire.add_capsules();
    capsule.set_first_sphere(set.capsules[i][0]);
    capsule.set_second_sphere(set.capsules[i][1]);
    capsule.set_part(ToWire(capsule::PartOfCapsule(set, i)));
  }
  JointsToWire(result, wire);
  return wire;
}

v1::Summary SummaryToWire(const pipeline::FitResult& result, const std::string& request_id) {
  v1::Summary wire;
  wire.set_request_id(PlainText(request_id));
  *wire.mutable_metrics() = MetricsToWire(result.metrics);
  for (std::size_t i = 0; i < result.stage_seconds.size(); ++i) {
    if (result.stage_seconds[i] <= 0.0) continue;
    v1::StageTime& stage = *wire.add_stages();
    stage.set_stage(ToWire(static_cast<Stage>(i)));
    stage.set_seconds(result.stage_seconds[i]);
  }
  wire.set_seconds(result.seconds);
  SimilarityToWire(result.body_from_caller, *wire.mutable_body_from_caller());
  *wire.mutable_options() = EffectiveOptionsToWire(result.effective_options);
  FactsToWire(result.body, *wire.mutable_body());
  wire.set_version(PlainText(result.version));
  return wire;
}

v1::ApproximateBodyUnaryResponse ResultToWire(const pipeline::FitResult& result,
                                              const std::string& request_id) {
  v1::ApproximateBodyUnaryResponse wire;
  *wire.mutable_primitives() = PrimitivesToWire(result);
  *wire.mutable_summary() = SummaryToWire(result, request_id);
  for (const Warning& warning : result.warnings) *wire.add_warnings() = WarningToWire(warning);
  *wire.mutable_landmarks() = LandmarksToWire(result);
  for (const pipeline::PolygonResult& polygon : result.polygons) {
    *wire.add_feature_polygons() = PolygonToWire(polygon);
  }
  wire.mutable_vertex_gaps()->Add(result.vertex_gaps.begin(), result.vertex_gaps.end());
  for (const pipeline::ExportedFile& known : result.exports) {
    v1::ExportFile& file = *wire.add_exports();
    file.set_format(known.format);
    file.set_name(known.file.name);
    file.set_data(known.file.bytes);
  }
  if (std::optional<v1::SkinningChunk> weights = FewWeightsToWire(result)) {
    *wire.mutable_skinning() = *std::move(weights);
  }
  return wire;
}

Warning WarningFromWire(const v1::Warning& wire) {
  return {wire.code(), wire.message(), wire.count()};
}

void LandmarksFromWire(const v1::Landmarks& wire, pipeline::FitResult& result) {
  for (const v1::Landmark& landmark : wire.landmarks()) {
    result.landmarks.push_back(
        {landmark.name(), VectorOf(landmark.position()),
         FromWire(landmark.method()).value_or(body::LandmarkMethod::kMeasured),
         landmark.confidence()});
  }
}

absl::StatusOr<pipeline::PolygonResult> PolygonFromWire(const v1::FeaturePolygon& wire) {
  const std::optional<body::Part> part = FromWire(wire.part());
  if (!part) return UnknownPart("feature_polygon.part", wire.part());
  pipeline::PolygonResult polygon;
  polygon.name = wire.name();
  polygon.part = *part;
  for (const v1::Vector3& point : wire.outline()) polygon.outline.push_back(VectorOf(point));
  for (const v1::Circle& circle : wire.circles()) {
    polygon.circles.push_back({VectorOf(circle.center()), circle.radius()});
  }
  polygon.outside_area_ratio = wire.outside_area_ratio();
  return polygon;
}

absl::Status PrimitivesFromWire(const v1::PrimitiveSet& wire, pipeline::FitResult& result) {
  capsule::PrimitiveSet& set = result.primitives;
  for (int i = 0; i < wire.spheres_size(); ++i) {
    const v1::Sphere& sphere = wire.spheres(i);
    const std::optional<body::Part> part = FromWire(sphere.part());
    if (!part) return UnknownPart(absl::StrCat("primitives.spheres[", i, "].part"), sphere.part());
    set.spheres.push_back({VectorOf(sphere.center()), sphere.radius()});
    set.origins.push_back({*part, sphere.has_polygon() ? sphere.polygon() : -1,
                           sphere.has_mirror() ? sphere.mirror() : -1});
    result.sphere_names.push_back(sphere.name());
    std::optional<refine::BodyPlace>& place = result.sphere_places.emplace_back();
    if (!sphere.has_place()) continue;
    CAPFIT_ASSIGN_OR_RETURN(
        place, PlaceFromWire(sphere.place(), absl::StrCat("primitives.spheres[", i, "].place")));
  }
  for (int i = 0; i < wire.capsules_size(); ++i) {
    const v1::Capsule& capsule = wire.capsules(i);
    if (!EndsAreValid(capsule, wire.spheres_size())) {
      return InvalidField(
          ErrorReason::kOutOfRange, absl::StrCat("primitives.capsules[", i, "]"),
          absl::StrCat("joins ", capsule.first_sphere(), " and ", capsule.second_sphere(),
                       ", must be in order and below ", wire.spheres_size()));
    }
    set.capsules.push_back({capsule.first_sphere(), capsule.second_sphere()});
  }
  return JointsFromWire(wire, result);
}

absl::Status SummaryFromWire(const v1::Summary& wire, pipeline::FitResult& result) {
  result.metrics = MetricsFromWire(wire.metrics());
  for (const v1::StageTime& stage : wire.stages()) {
    const std::optional<Stage> known = FromWire(stage.stage());
    if (known) result.stage_seconds[Index(*known)] = stage.seconds();
  }
  result.seconds = wire.seconds();
  CAPFIT_ASSIGN_OR_RETURN(result.effective_options, EffectiveOptionsFromWire(wire.options()));
  result.body = FactsFromWire(wire.body());
  result.version = wire.version();
  return SimilarityFromWire(wire.body_from_caller(), result.body_from_caller);
}

}  // namespace capfit::wire
